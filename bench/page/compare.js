// The chart of a page of `quincunx compare`: reads the report in the element #report.
'use strict';

(function () {
  const report = JSON.parse(document.getElementById('report').textContent);
  // M. Okabe, K. Ito: told apart by colour-blind eyes; and two more.
  const colors = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7f5a3c', '#808080', '#000000', '#9467bd'];
  const shapes = ['circle', 'triangle', 'rect', 'rectRot', 'star', 'crossRot'];

  const splines = [], methods = ['exact'];
  const place = (list, what) => (list.includes(what) ? 0 : list.push(what), list.indexOf(what));
  const groupOf = s => s.spline + (s.volume.endsWith('sparse') ? ' sparse' : '') + (s.prefilter === 'none' ? '' : ' ' + s.prefilter) + (s.storage === 'float32' ? '' : ' ' + s.storage);
  report.settings.forEach(s => { place(splines, groupOf(s)); place(methods, s.method); });

  // What a logarithmic axis shows of an error of 0.
  function floorOf(error) {
    const positive = report.settings.map(s => s.errors[error]).filter(e => e > 0);
    return positive.length > 0 ? Math.min(...positive) / 3 : 0.1;
  }

  function datasetsOf(error) {
    const floor = floorOf(error);
    const point = n => ({ x: report.settings[n].ms.median, y: Math.max(report.settings[n].errors[error], floor), setting: n });
    const sets = splines.map((spline, color) => {
      const numbers = report.settings.map((s, n) => n).filter(n => groupOf(report.settings[n]) === spline);
      return {
        label: spline,
        data: numbers.map(point),
        pointStyle: numbers.map(n => shapes[place(methods, report.settings[n].method) % shapes.length]),
        pointRadius: 6,
        pointHoverRadius: 8,
        borderColor: colors[color % colors.length],
        backgroundColor: colors[color % colors.length] + 'a0',
        showLine: false,
      };
    });
    sets.push({ label: 'Pareto front', data: report.front[error].map(point), borderColor: '#606060', borderDash: [6, 4], borderWidth: 2, pointRadius: 0, pointHitRadius: 0, showLine: true, order: 1 });
    return sets;
  }

  const digits = x => (x === 0 ? '0' : Number(x).toPrecision(3));
  function tooltipOf(item) {
    const s = report.settings[item.raw.setting];
    const lines = [`${digits(s.ms.median)} ms (${digits(s.ms.p5)} to ${digits(s.ms.p95)})`];
    report.errors.forEach(e => lines.push(`${e.title}: ${digits(s.errors[e.name])}`));
    return lines;
  }

  const titleOf = error => report.errors.find(e => e.name === error).title;
  const axis = text => ({ type: 'logarithmic', title: { display: true, text }, grid: { color: '#e4e4e4' } });

  const select = document.getElementById('error');
  report.errors.forEach(e => select.add(new Option(e.title, e.name)));
  select.value = report.error;

  const chart = new Chart(document.getElementById('chart'), {
    type: 'scatter',
    data: { datasets: datasetsOf(report.error) },
    options: {
      animation: false,
      maintainAspectRatio: false,
      scales: { x: axis('frame, ms (median)'), y: axis(titleOf(report.error)) },
      plugins: {
        legend: { position: 'right', labels: { usePointStyle: false, boxWidth: 12 } },
        tooltip: {
          filter: item => item.dataset.label !== 'Pareto front',
          callbacks: { title: items => (items.length > 0 ? report.settings[items[0].raw.setting].label : ''), label: tooltipOf },
        },
      },
    },
  });

  // Rows of the first table and pictures that are on the front.
  function mark(error) {
    const front = report.front[error];
    document.querySelectorAll('[data-row]').forEach(e => e.classList.remove('front'));
    const table = document.querySelector('table');
    front.forEach(n => {
      table.querySelector(`tr[data-row="${n}"]`).classList.add('front');
      document.querySelector(`figure[data-row="${n}"]`).classList.add('front');
    });
    document.body.dataset.points = String(chart.data.datasets.slice(0, -1).reduce((sum, set) => sum + set.data.length, 0));
    document.body.dataset.front = String(front.length);
    document.body.dataset.error = error;
  }

  function show(error) {
    chart.data.datasets = datasetsOf(error);
    chart.options.scales.y.title.text = titleOf(error);
    chart.update();
    mark(error);
  }
  select.addEventListener('change', () => show(select.value));
  // A link may choose: compare.html#normal.
  const asked = () => decodeURIComponent(location.hash.slice(1));
  const known = name => report.errors.some(e => e.name === name);
  const follow = () => { if (known(asked())) { select.value = asked(); } show(select.value); };
  window.addEventListener('hashchange', follow);
  follow();
})();
