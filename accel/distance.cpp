#include "accel/distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdlib>

#include "lattice/stopwatch.h"

namespace quincunx {
namespace {

constexpr int kFarthest = 255;

/// Scratch memory of one thread: the paper's g, s and t.
struct Envelope {
  std::vector<int> g, s, t;
};

/// f(x, i): the distance at x if the nearest active block lies in the slice of i.
int reach(const Envelope& e, int x, int i) { return std::max(std::abs(x - i), e.g[std::size_t(i)]); }

/// Sep(i, u), i < u: up to here i is as near as u (table 1 of the paper, chessboard metric).
int separation(const Envelope& e, int i, int u) {
  const int g_i = e.g[std::size_t(i)], g_u = e.g[std::size_t(u)];
  return g_i <= g_u ? std::max(i + g_u, (i + u) / 2) : std::min(u - g_i, (i + u) / 2);
}

/// row[x] becomes the least f(x, i) over all i, for n entries `stride` apart: the second phase of the paper (algorithm 3).
void transform_row(std::uint8_t* row, std::size_t stride, int n, Envelope& e) {
  e.g.resize(std::size_t(n)), e.s.resize(std::size_t(n)), e.t.resize(std::size_t(n));
  for (int x = 0; x < n; ++x) e.g[std::size_t(x)] = row[std::size_t(x) * stride];
  std::size_t q = 1;  // segments; segment k begins at t[k] and is nearest to s[k]
  e.s[0] = e.t[0] = 0;
  for (int u = 1; u < n; ++u) {
    while (q > 0 && reach(e, e.t[q - 1], e.s[q - 1]) > reach(e, e.t[q - 1], u)) --q;
    const int begin = q == 0 ? 0 : 1 + separation(e, e.s[q - 1], u);
    if (begin >= n) continue;
    e.s[q] = u;
    e.t[q] = begin;
    ++q;
  }
  for (int x = n - 1; x >= 0; --x) {
    row[std::size_t(x) * stride] = std::uint8_t(std::min(reach(e, x, e.s[q - 1]), kFarthest));
    if (x == e.t[q - 1] && q > 1) --q;
  }
}

/// Transforms the rows along an axis of `stride`, n entries each; row r begins at first(r).
template <class First>
void transform_axis(std::uint8_t* map, std::size_t rows, std::size_t stride, int n, First first) {
  using Rows = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Rows(0, rows, 64), [&](const Rows& range) {
    Envelope envelope;
    for (std::size_t r = range.begin(); r != range.end(); ++r) transform_row(map + first(r), stride, n, envelope);
  });
}

}  // namespace

std::vector<std::uint8_t> chebyshev_distances(const Classification& blocks) {
  const std::size_t nx = std::size_t(blocks.blocks.x), ny = std::size_t(blocks.blocks.y), nz = std::size_t(blocks.blocks.z);
  std::vector<std::uint8_t> map(blocks.level.size());
  for (std::size_t n = 0; n < map.size(); ++n) map[n] = blocks.level[n] == Classification::active ? 0 : kFarthest;
  transform_axis(map.data(), ny * nz, 1, int(nx), [=](std::size_t r) { return r * nx; });
  transform_axis(map.data(), nx * nz, nx, int(ny), [=](std::size_t r) { return r / nx * nx * ny + r % nx; });
  transform_axis(map.data(), nx * ny, nx * ny, int(nz), [](std::size_t r) { return r; });
  return map;
}

void Distance::build(const Classification& blocks, const Thresholds&) {
  const Stopwatch watch;
  distance_ = chebyshev_distances(blocks);
  ++version_;
  report_ = {.leaves = blocks.active_blocks, .build_ms = watch.ms()};
}

std::vector<StructureBuffer> Distance::buffers() const {
  return {{"blockDistance", TexelFormat::r8, std::as_bytes(std::span(distance_)), version_}};
}

}  // namespace quincunx
