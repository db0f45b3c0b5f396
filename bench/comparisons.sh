#!/usr/bin/env bash
# comparisons.sh [FOLDER [DATA]]: makes the tables and the charts of docs/comparison.md again, in FOLDER (out/comparisons): the presets of
# `quincunx compare`, DATA/mri_head.nrrd (../shared/data) as the truth of what is left of it on coarser lattices, and orders of approximation.
# The tables of the page, which have fewer columns than compare.md, go to standard output. Minutes on two cores. ROUNDS=N changes the timed frames (15).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export PATH="$PWD/build/release:$PATH"

out=${1:-out/comparisons} data=${2:-../shared/data} rounds=${ROUNDS:-15}
mkdir -p "$out"

# table FOLDER COLUMNS: of compare.json, COLUMNS being pairs of a heading and a path in an entry of `settings`, as jq has it.
table() {
  jq -r --argjson columns "$2" '
    def shown: if type == "number" then (if . == 0 then "0" elif . >= 100 then (. | round | tostring)
      else (. as $x | ($x | log10 | floor) as $e | if $e < -3 then ($x * 1000000 | . * 10 | round / 10 | tostring) + "e-6"
        else ($x / pow(10; $e - 2) | round) * pow(10; $e - 2) | . * 100000 | round / 100000 | tostring end) end) else tostring end;
    (.front[.error]) as $front | "| " + ([$columns[][0]] | join(" | ")) + " | front |",
    "|" + ([$columns[] | if .[0] == "spline" or .[0] == "prefilter" or .[0] == "hit" or .[0] == "normals" then ":--" else "--:" end] | join("|")) + "|:-:|",
    (.settings | to_entries[] | .key as $n | .value as $s
      | "| " + ([$columns[][1] as $path | $s | getpath($path) | shown] | join(" | ")) + " | " + (if $front | index($n) then "*" else "" end) + " |")' "$out/$1/compare.json"
  echo
}
hits='["ms",["ms","median"]],["wrong beside ref, %",["reference","wrong_percent"]],["depth, RMS",["reference","depth_rms_cells"]],["max",["reference","depth_max_cells"]]'
true_hits='["wrong beside truth, %",["truth","wrong_percent"]],["depth, RMS",["truth","depth_rms_cells"]],["normals, RMS",["truth","normal_rms_degrees"]],["image",["image_rmse"]],["SSIM",["ssim"]]'
volume='["value, RMSE",["reconstruction","value_rmse"]],["gradient, RMS degrees",["reconstruction","angle_rms_degrees"]]'

for preset in marschner-lobb table3 table5; do
  quincunx compare --preset "$preset" --rounds "$rounds" -o "$out/$preset" --quiet
done
if [[ -e $data/mri_head.nrrd ]]; then
  quincunx compare "$data/mri_head.nrrd" --iso 130 --azimuth 55 --elevation 12 --intersect exact --rounds "$rounds" -o "$out/mri_head" --quiet
fi

printf '## marschner-lobb\n\n'
table marschner-lobb "[[\"spline\",[\"spline\"]],[\"hit\",[\"method\"]],$hits,$true_hits,$volume]"
printf '## table3\n\n'
table table3 "[[\"spline\",[\"spline\"]],[\"normals\",[\"normal\"]],[\"ms\",[\"ms\",\"median\"]],[\"normals beside ref\",[\"reference\",\"normal_rms_degrees\"]],[\"normals beside truth\",[\"truth\",\"normal_rms_degrees\"]],[\"gradient, RMS degrees\",[\"reconstruction\",\"angle_rms_degrees\"]]]"
printf '## table5\n\n'
table table5 "[[\"spline\",[\"spline\"]],[\"hit\",[\"method\"]],[\"normals\",[\"normal\"]],$hits]"
if [[ -e $out/mri_head/compare.json ]]; then
  printf '## mri_head\n\n'
  table mri_head "[[\"spline\",[\"spline\"]],[\"prefilter\",[\"prefilter\"]],[\"ms\",[\"ms\",\"median\"]],$true_hits]"
fi
printf '## orders\n\n'
quincunx-bench convergence --markdown --json "$out/convergence.json"
