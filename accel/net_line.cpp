#include "accel/net_line.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <limits>
#include <map>
#include <tuple>

namespace quincunx {
namespace {

constexpr int kLanes = 8;   // floats of one AVX2 register; two registers where there is no AVX2
constexpr int kBlock = 8;   // registers that a pass over the taps fills
constexpr int kGrain = 16;  // rows are padded to a multiple of this many floats

/// Unaligned loads and stores of kLanes floats, lane by lane as written.
typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float)), aligned(alignof(float)), may_alias));

/// One line's work, in plain pointers.
struct Line {
  const float* const* rows;  ///< the rows of samples, each from the first that the line takes
  const int* group_end;
  int groups;
  std::int64_t read;   ///< samples to read of each row
  std::int64_t pitch;  ///< floats of a row of the net, a multiple of kGrain
  std::int64_t sample_pitch;
  float* samples;  ///< groups * sample_pitch
  float* net;      ///< period * pitch, and one row more
};

/// Sums the rows of each group. What is past the end repeats the last sample: finite, and read by no cell.
[[gnu::always_inline]] inline void gather(const Line& line) {
  for (int g = 0; g < line.groups; ++g) {
    float* sum = line.samples + g * line.sample_pitch;
    const float* const* row = line.rows + line.group_end[g];
    const float* const* const end = line.rows + line.group_end[g + 1];
    const float* first = *row;
    for (std::int64_t i = 0; i < line.read; ++i) sum[i] = first[i];
    while (++row != end) {
      const float* next = *row;
      for (std::int64_t i = 0; i < line.read; ++i) sum[i] += next[i];
    }
    for (std::int64_t i = line.read; i < line.sample_pitch; ++i) sum[i] = sum[line.read - 1];
  }
}

/// net[i] = sum of weight * samples[offset + i] over the taps, for `Registers` * kLanes of i from `first`.
template <int Registers>
[[gnu::always_inline]] inline void convolve(const NetLines::Tap* tap, const NetLines::Tap* end, const float* samples,
                                            std::int64_t first, float* net) {
  Lanes sum[Registers] = {};
  for (; tap != end; ++tap) {
    const Lanes* from = reinterpret_cast<const Lanes*>(samples + tap->offset + first);
#pragma GCC unroll 8
    for (int r = 0; r < Registers; ++r) sum[r] += tap->weight * from[r];
  }
  Lanes* to = reinterpret_cast<Lanes*>(net + first);
#pragma GCC unroll 8
  for (int r = 0; r < Registers; ++r) to[r] = sum[r];
}

/// The rows of the net for all residues of x.
template <int Period>
[[gnu::always_inline]] inline void convolve_all(const Line& line, const NetLines::Tap* taps, const int* tap_end) {
  for (int a = 0; a < Period; ++a) {
    std::int64_t i = 0;
    for (; i + kBlock * kLanes <= line.pitch; i += kBlock * kLanes)
      convolve<kBlock>(taps + tap_end[a], taps + tap_end[a + 1], line.samples, i, line.net + a * line.pitch);
    for (; i < line.pitch; i += kGrain)
      convolve<kGrain / kLanes>(taps + tap_end[a], taps + tap_end[a + 1], line.samples, i, line.net + a * line.pitch);
  }
}

/// Widens [min[i], max[i]] by the range of Degree + 1 rows of the net, the last of them from `end` on.
template <int Degree>
[[gnu::always_inline]] inline void widen_cells(const float* net, std::int64_t pitch, const float* end, float* min,
                                               float* max) {
  for (std::int64_t i = 0; i < pitch; i += kLanes) {
    Lanes low = *reinterpret_cast<const Lanes*>(end + i), high = low;
#pragma GCC unroll 8
    for (int a = 0; a < Degree; ++a) {
      const Lanes v = *reinterpret_cast<const Lanes*>(net + a * pitch + i);
      low = v < low ? v : low;
      high = v > high ? v : high;
    }
    Lanes& least = *reinterpret_cast<Lanes*>(min + i);
    Lanes& most = *reinterpret_cast<Lanes*>(max + i);
    least = low < least ? low : least;
    most = high > most ? high : most;
  }
}

template <int Degree>
[[gnu::always_inline]] inline void widen_rows(const Line& line, const NetLines::Tap* taps, const int* tap_end,
                                              RowRange* const* rows, int count) {
  gather(line);
  convolve_all<2 * Degree>(line, taps, tap_end);
  // The last row once more, one to the left: the far end of the odd cells.
  float* shifted = line.net + 2 * Degree * line.pitch;
  for (std::int64_t i = 0; i + 1 < line.pitch; ++i) shifted[i] = line.net[i + 1];
  shifted[line.pitch - 1] = line.net[line.pitch - 1];
  for (int r = 0; r < count; ++r) {
    float* min = rows[r]->min.data();
    float* max = rows[r]->max.data();
    widen_cells<Degree>(line.net, line.pitch, line.net + Degree * line.pitch, min, max);
    widen_cells<Degree>(line.net + Degree * line.pitch, line.pitch, shifted, min + line.pitch, max + line.pitch);
  }
}

using WidenRows = void (*)(const Line&, const NetLines::Tap*, const int*, RowRange* const*, int);

template <int Degree>
void widen_rows_portable(const Line& line, const NetLines::Tap* taps, const int* tap_end, RowRange* const* rows,
                         int count) {
  widen_rows<Degree>(line, taps, tap_end, rows, count);
}

#if defined(__x86_64__)
// Not target_clones: its resolvers run before AddressSanitizer is ready.
template <int Degree>
[[gnu::target("avx2")]] void widen_rows_avx2(const Line& line, const NetLines::Tap* taps, const int* tap_end,
                                             RowRange* const* rows, int count) {
  widen_rows<Degree>(line, taps, tap_end, rows, count);
}
template <int Degree>
WidenRows best_widen_rows() {
  return __builtin_cpu_supports("avx2") ? widen_rows_avx2<Degree> : widen_rows_portable<Degree>;
}
#else
template <int Degree>
WidenRows best_widen_rows() {
  return widen_rows_portable<Degree>;
}
#endif

template <int Degree>
WidenRows widen_rows_with(NetLines::Instructions instructions) {
  static const WidenRows best = best_widen_rows<Degree>();
  return instructions == NetLines::Instructions::best ? best : widen_rows_portable<Degree>;
}

WidenRows widen_rows_of(int degree, NetLines::Instructions instructions) {
  assert(degree == 1 || degree == 4 || degree == 5);
  return degree == 1 ? widen_rows_with<1>(instructions) : degree == 4 ? widen_rows_with<4>(instructions) : widen_rows_with<5>(instructions);
}

}  // namespace

std::vector<int> NetLines::reaching(int coset, int r) const {
  std::vector<int> places;
  for (int d = -3; d <= 3; ++d)
    if (std::abs(r - net_.degree * coset - period_ * d) <= net_.reach) places.push_back(d);
  return places;
}

NetLines::NetLines(const Coefficients<float>& c, const NetView& net, Instructions instructions)
    : c_(c), net_(net), instructions_(instructions), period_(2 * net.degree) {
  pitch_ = (c.extents.x + kGrain - 1) / kGrain * kGrain;
  sample_pitch_ = pitch_ + kGrain;
  for (int coset = 0; coset < 2; ++coset)
    for (int r = 0; r < period_; ++r)
      for (const int d : reaching(coset, r)) before_ = std::max(before_, std::abs(d));
  assert(c.lattice == LatticeKind::bcc && c.apron >= before_);
  for (int z = 0; z < period_; ++z)
    for (int y = 0; y < period_; ++y) recipes_.push_back(make_recipe(y, z));
}

NetLines::Recipe NetLines::make_recipe(int y, int z) const {
  // Group the rows by what their weights depend on: the coset, and |dy| and |dz| in either order.
  std::map<std::tuple<int, int, int>, std::vector<std::int64_t>> groups;
  for (int coset = 0; coset < 2; ++coset)
    for (int k : reaching(coset, z))
      for (int j : reaching(coset, y)) {
        const int dy = std::abs(y - net_.degree * coset - period_ * j), dz = std::abs(z - net_.degree * coset - period_ * k);
        if (net_.at(0, dy, dz) == 0) continue;  // and so along the whole line
        groups[{coset, std::max(dy, dz), std::min(dy, dz)}].push_back(coset * c_.stride_coset() + k * c_.stride_z() +
                                                                      j * c_.stride_y());
      }
  Recipe recipe;
  for (const auto& [key, rows] : groups) {
    recipe.rows.insert(recipe.rows.end(), rows.begin(), rows.end());
    recipe.group_end.push_back(int(recipe.rows.size()));
  }
  for (int x = 0; x < period_; ++x) {
    int g = 0;
    for (const auto& [key, rows] : groups) {
      const auto [coset, d1, d2] = key;
      for (int i : reaching(coset, x))
        if (const int w = net_.at(x - net_.degree * coset - period_ * i, d1, d2); w != 0)
          recipe.taps.push_back({std::int32_t(g * sample_pitch_) + before_ + i, float(w) / float(net_.denominator)});
      ++g;
    }
    recipe.tap_end.push_back(int(recipe.taps.size()));
  }
  return recipe;
}

NetLines::Workspace NetLines::workspace() const {
  std::size_t groups = 0;
  for (const Recipe& r : recipes_) groups = std::max(groups, r.group_end.size() - 1);
  return {std::vector<float>(groups * std::size_t(sample_pitch_)),
          std::vector<float>(std::size_t(period_ + 1) * std::size_t(pitch_))};
}

RowRange NetLines::empty_range() const {
  const std::size_t n = 2 * std::size_t(pitch_);
  return {pitch_, std::vector<float>(n, std::numeric_limits<float>::max()),
          std::vector<float>(n, std::numeric_limits<float>::lowest())};
}

void NetLines::widen(std::int64_t y, std::int64_t z, Workspace& work, RowRange* const* ranges, int count) const {
  const Recipe& recipe = recipes_[std::size_t(z % period_ * period_ + y % period_)];
  const float* base = c_.data.data() + c_.number(0, {-before_, y / period_, z / period_});

  constexpr std::size_t kMostRows = 32;
  const float* rows[kMostRows];
  assert(recipe.rows.size() <= kMostRows);
  for (std::size_t r = 0; r < recipe.rows.size(); ++r) rows[r] = base + recipe.rows[r];
  const Line line{rows,
                  recipe.group_end.data(),
                  int(recipe.group_end.size()) - 1,
                  c_.extents.x + 2 * before_,
                  pitch_,
                  sample_pitch_,
                  work.samples.data(),
                  work.net.data()};
  widen_rows_of(net_.degree, instructions_)(line, recipe.taps.data(), recipe.tap_end.data(), ranges, count);
}

}  // namespace quincunx
