// Integrals of a transfer function along stretches on which the value is linear.
//
// K. Engel, M. Kraus, T. Ertl, High-quality pre-integrated volume rendering using hardware-accelerated pixel shading, 2001,
// DOI 10.1145/383507.383515. Their fast way neglects the attenuation within a stretch; here it counts. All stretches over m
// intervals of the table run through these at the same pace, so that their integrals are windows of m over one row of
// intervals, each integrated once: of n^2 cells none costs more for being long.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "render/transfer_table.h"

namespace quincunx {
namespace {

constexpr double kMostOpaque = 1.0 - 0x1p-24;  // tau ends here

/// Values s1 to s2 in a ray's order (s2 may be below), opacity and colour linear between them. 1 - opacity changes by a factor of 4
/// at most, which keeps tau = -ln(1 - opacity) as smooth as the quadrature wants it.
struct Piece {
  double width;  ///< |s2 - s1|, in intervals of the table
  double o1, o2;
  glm::dvec3 c1, c2;
};

/// The pieces of interval n of the table are those from begin[n] to begin[n + 1].
struct Pieces {
  std::vector<Piece> all;
  std::vector<std::size_t> begin;
};

/// Where, of [0,1], an opacity that goes linearly from o1 to o2 has to be cut to make pieces.
std::vector<double> cuts(double o1, double o2) {
  const double p1 = 1.0 - o1, p2 = 1.0 - o2, thickest = std::max(std::min(p1, p2), 1.0 - kMostOpaque);
  std::vector<double> parts;
  for (double p = std::max(p1, p2) / 4.0; p > thickest; p /= 4.0) parts.push_back((p - p1) / (p2 - p1));
  if (std::min(p1, p2) < thickest && thickest < std::max(p1, p2)) parts.push_back((thickest - p1) / (p2 - p1));
  std::ranges::sort(parts);
  return parts;
}

/// Appends the pieces of one stretch in which the function has no point.
void append_pieces(const TransferFunction& function, double s1, double s2, double interval, std::vector<Piece>& pieces) {
  const double o1 = function.opacity(s1), o2 = function.opacity(s2);
  const glm::dvec3 c1 = function.color(s1), c2 = function.color(s2);
  std::vector<double> ends = cuts(o1, o2);
  ends.push_back(1.0);
  double from = 0.0;
  for (const double to : ends) {
    const auto opacity = [&](double x) { return std::min((1.0 - x) * o1 + x * o2, kMostOpaque); };
    pieces.push_back({(to - from) * (s2 - s1) / interval, opacity(from), opacity(to), (1.0 - from) * c1 + from * c2, (1.0 - to) * c1 + to * c2});
    from = to;
  }
}

Pieces make_pieces(const TransferFunction& function, const PreIntegratedTable& table) {
  const double low = table.low, interval = (double(table.high) - low) / double(table.entries - 1);
  std::vector<double> points;
  for (const auto& point : function.colors) points.push_back(point.value);
  for (const auto& point : function.opacities) points.push_back(point.value);
  std::ranges::sort(points);

  Pieces pieces;
  auto next = points.begin();
  for (int n = 0; n + 1 < table.entries; ++n) {
    pieces.begin.push_back(pieces.all.size());
    double from = low + interval * n;
    const double end = n + 2 == table.entries ? double(table.high) : low + interval * (n + 1);
    for (; next != points.end() && *next < end; ++next) {
      if (*next <= from) continue;
      append_pieces(function, from, *next, interval, pieces.all);
      from = *next;
    }
    append_pieces(function, from, end, interval, pieces.all);
  }
  pieces.begin.push_back(pieces.all.size());
  return pieces;
}

/// The same, run through from the highest value to the lowest.
Pieces reversed(const Pieces& pieces) {
  Pieces back;
  for (auto piece = pieces.all.rbegin(); piece != pieces.all.rend(); ++piece)
    back.all.push_back({piece->width, piece->o2, piece->o1, piece->c2, piece->c1});
  for (auto begin = pieces.begin.rbegin(); begin != pieces.begin.rend(); ++begin) back.begin.push_back(pieces.all.size() - *begin);
  return back;
}

/// Optical depth from a piece's beginning, where the whole of it is `units` unit lengths long. With p from p1 to p = p1 (1 + r), the mean
/// of ln p between them is ln p1 + ((1 + r) ln(1 + r) - r) / r.
struct Depth {
  double units, o1, change, ln_p1;
  Depth(const Piece& piece, double length) : units(length), o1(piece.o1), change(piece.o2 - piece.o1), ln_p1(std::log1p(-piece.o1)) {}

  double operator()(double x) const {
    const double r = -change * x / (1.0 - o1);
    const double mean = std::abs(r) < 0.01 ? r * (1.0 / 2 - r * (1.0 / 6 - r * (1.0 / 12 - r * (1.0 / 20 - r * (1.0 / 30 - r / 42)))))
                                           : (1.0 + r) * std::log1p(r) / r - 1.0;
    return -units * x * (ln_p1 + mean);
  }
};

/// The integral of exp(-depth(x)) over [0,1], by Gauss's rule of 4 points in parts of depth 1 or so, until nothing more comes through.
double integrate_transmittance(const Depth& depth) {
  constexpr double kDark = 40.0;
  constexpr std::array<std::array<double, 2>, 4> kRule{{{0.06943184420297371, 0.17392742256872693},
                                                        {0.33000947820757187, 0.32607257743127307},
                                                        {0.66999052179242813, 0.32607257743127307},
                                                        {0.93056815579702629, 0.17392742256872693}}};
  double end = 1.0, whole = depth(1.0);
  if (whole > kDark) {
    double lit = 0.0;
    for (int n = 0; n < 60; ++n) (depth(0.5 * (lit + end)) > kDark ? end : lit) = 0.5 * (lit + end);
    whole = kDark;
  }
  const int parts = 1 + int(whole);
  double sum = 0.0;
  for (int n = 0; n < parts; ++n)
    for (const auto& [at, weight] : kRule) sum += weight * std::exp(-depth(end * (n + at) / parts));
  return sum * end / parts;
}

/// Premultiplied colour and alpha of a piece `units` unit lengths long. By parts, the colour c1 + (c2 - c1) x seen through
/// T(x) = exp(-depth(x)) is c1 (1 - T(1)) + (c2 - c1) (integral of T - T(1)).
glm::dvec4 integrate(const Piece& piece, double units) {
  if (piece.o1 == 0.0 && piece.o2 == 0.0) return glm::dvec4(0.0);
  const Depth depth(piece, units);
  const double alpha = -std::expm1(-depth(1.0));
  glm::dvec3 color = alpha * piece.c1;
  if (piece.c1 != piece.c2) color += (piece.c2 - piece.c1) * (integrate_transmittance(depth) - (1.0 - alpha));
  return {color, alpha};
}

glm::dvec4 over(const glm::dvec4& front, const glm::dvec4& back) { return front + (1.0 - front.a) * back; }

/// row[n], intervals n .. n + m - 1 composited, from row[n], interval n alone. In blocks of m intervals, a window is the end of one block
/// before the beginning of the next, as M. van Herk, *A fast algorithm for local minimum and maximum filters*, 1992, has it.
void composite_windows(std::vector<glm::dvec4>& row, std::size_t m) {
  std::vector<glm::dvec4> beginnings = row;
  for (std::size_t n = 1; n < row.size(); ++n)
    if (n % m != 0) beginnings[n] = over(beginnings[n - 1], row[n]);
  for (std::size_t n = row.size() - 1; n-- > 0;)
    if ((n + 1) % m != 0) row[n] = over(row[n], row[n + 1]);
  for (std::size_t n = 0; n + m <= row.size(); ++n)
    if (n % m != 0) row[n] = over(row[n], beginnings[n + m - 1]);
}

/// Every stretch over m intervals, `units` unit lengths long: row[n] of those from n on, in the pieces' order.
std::vector<glm::dvec4> integrate_windows(const Pieces& pieces, std::size_t m, double units) {
  std::vector<glm::dvec4> row(pieces.begin.size() - 1, glm::dvec4(0.0));
  for (std::size_t n = 0; n < row.size(); ++n)
    for (std::size_t k = pieces.begin[n]; k < pieces.begin[n + 1]; ++k)
      row[n] = over(row[n], integrate(pieces.all[k], units * pieces.all[k].width / double(m)));
  composite_windows(row, m);
  row.resize(row.size() + 1 - m);
  return row;
}

}  // namespace

PreIntegratedTable pre_integrate(const TransferFunction& function, int entries, double length, double unit) {
  assert(entries >= 2 && length > 0.0 && unit > 0.0);
  PreIntegratedTable table{.low = float_below(function.low()), .high = float_above(function.high()), .entries = entries, .cells = {}};
  const auto size = std::size_t(entries);
  table.cells.resize(size * size);
  const auto cell = [&](std::size_t front, std::size_t back) -> glm::vec4& { return table.cells[back * size + front]; };
  const auto stored = [](const glm::dvec4& c) { return glm::vec4(glm::clamp(c, 0.0, 1.0)); };
  const double units = length / (function.unit > 0.0 ? function.unit : unit);
  const Pieces up = make_pieces(function, table), down = reversed(up);

  // Where the value does not change, the first piece of the interval above, or the last below, has its opacity and colour.
  for (std::size_t n = 0; n < size; ++n) {
    const Piece& piece = n + 1 < size ? up.all[up.begin[n]] : down.all.front();
    cell(n, n) = stored(integrate({1.0, piece.o1, piece.o1, piece.c1, piece.c1}, units));
  }
  tbb::parallel_for(std::size_t(1), size, [&](std::size_t m) {
    const std::vector<glm::dvec4> rising = integrate_windows(up, m, units), falling = integrate_windows(down, m, units);
    for (std::size_t n = 0; n < rising.size(); ++n) {
      cell(n, n + m) = stored(rising[n]);
      cell(size - 1 - n, size - 1 - n - m) = stored(falling[n]);
    }
  });
  return table;
}

}  // namespace quincunx
