#include "accel/hybrid.h"

#include <gmock/gmock.h>

#include <cstring>
#include <limits>
#include <random>

#include "block_masks.h"
#include "coefficient_sets.h"

namespace quincunx {
namespace {

using glm::dvec3;
using glm::ivec3;

const StructureBuffer& named(const std::vector<StructureBuffer>& buffers, std::string_view name) {
  for (const StructureBuffer& buffer : buffers)
    if (buffer.name == name) return buffer;
  throw std::logic_error("no buffer of that name");
}

template <class T>
std::vector<T> elements(const StructureBuffer& buffer) {
  std::vector<T> all(buffer.bytes.size() / sizeof(T));
  std::memcpy(all.data(), buffer.bytes.data(), buffer.bytes.size());
  return all;
}

/// The leaves as kernels find them.
std::vector<BlockBox> leaves_of(const Hybrid& hybrid) {
  const auto nodes = elements<BoxTree::Node>(hybrid.buffers().at(0));
  std::vector<BlockBox> leaves;
  for (int n = 0; n < hybrid.parameters().x; ++n) {
    const auto half = [&](int i) { return int(nodes.at(std::size_t(n)).words[i / 2] >> (i % 2 * 16) & 0xffffu); };
    leaves.push_back({{half(0), half(1), half(2)}, {half(3), half(4), half(5)}});
  }
  return leaves;
}

/// Which blocks kernels take for active, inside leaves or not.
std::vector<bool> active_of(const Hybrid& hybrid, HybridGrid grid) {
  std::vector<bool> active;
  const auto buffers = hybrid.buffers();
  if (grid == HybridGrid::pc) {
    for (const std::uint8_t level : elements<std::uint8_t>(named(buffers, "hybridLevel"))) active.push_back(level == Classification::active);
    return active;
  }
  const auto windows = elements<KernelWindow>(named(buffers, "windows"));
  EXPECT_EQ(std::size_t(hybrid.parameters().z), windows.size());
  const auto bounds = elements<std::uint16_t>(named(buffers, "hybridBounds"));
  for (std::size_t n = 0; n < bounds.size(); n += 2) {
    const std::uint16_t min = bounds[n], max = bounds[n + 1];
    const auto touched = [&](const KernelWindow& w) { return min < w.above_min && max >= w.lowest_max; };
    active.push_back(min <= max && std::ranges::any_of(windows, touched));
  }
  return active;
}

Hybrid built(const Classification& c, Hybrid::Config config) {
  Hybrid hybrid(config);
  hybrid.build(c, Thresholds({}, {}));
  return hybrid;
}

TEST(Hybrid, LeavesHoldEveryActiveBlockOnceAndNoneIsSmallerThanAllowed) {
  for (const BlockMask& mask : block_masks())
    for (const double share : {0.003, 0.1, 1.0}) {
      SCOPED_TRACE(mask.name);
      const Classification& c = mask.blocks;
      const Hybrid hybrid = built(c, {.least_share = share});
      std::vector<int> owners(c.level.size(), 0);
      BlockBox hull{ivec3(std::numeric_limits<int>::max()), ivec3(0)};
      std::int64_t least = std::numeric_limits<std::int64_t>::max();
      for (const BlockBox& leaf : leaves_of(hybrid)) {
        hull = {glm::min(hull.low, leaf.low), glm::max(hull.high, leaf.high)};
        least = std::min(least, leaf.volume());
        for (int z = leaf.low.z; z < leaf.high.z; ++z)
          for (int y = leaf.low.y; y < leaf.high.y; ++y)
            for (int x = leaf.low.x; x < leaf.high.x; ++x) ++owners[std::size_t((z * c.blocks.y + y) * c.blocks.x + x)];
      }
      for (std::size_t b = 0; b < owners.size(); ++b) {
        ASSERT_LE(owners[b], 1);
        ASSERT_GE(owners[b], c.level[b] == Classification::active ? 1 : 0);
      }
      EXPECT_EQ(hybrid.report().leaves, c.active_blocks);
      if (c.active_blocks == 0) continue;
      EXPECT_GE(double(least), share * double(hull.volume()) * (1 - 1e-12));
      if (share == 1.0) {
        EXPECT_EQ(hybrid.parameters().x, 1);
      }
    }
}

/// Where the ray is inside, entry < exit if anywhere for more than a point.
std::pair<double, double> interval(const dvec3& eye, const dvec3& direction, const BlockBox& box) {
  double entry = 0.0, exit = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.low[axis] - eye[axis]) / direction[axis], b = (box.high[axis] - eye[axis]) / direction[axis];
    entry = std::max(entry, std::min(a, b)), exit = std::min(exit, std::max(a, b));
  }
  return {entry, exit};
}

TEST(Hybrid, RaysFromAnyEyeMeetTheLeavesFrontToBack) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit;
  int several = 0;
  for (const BlockMask& mask : block_masks()) {
    SCOPED_TRACE(mask.name);
    Hybrid hybrid = built(mask.blocks, {.least_share = 0.003});
    const dvec3 size(mask.blocks.blocks);
    for (int e = 0; e < 12; ++e) {
      const double distance = std::vector{0.3, 1.0, 100.0}[std::size_t(e % 3)];  // inside, about the surface, far
      dvec3 eye = 0.5 * size + distance * size * dvec3(normal(random), normal(random), normal(random));
      if (e % 5 == 0) eye = glm::floor(eye);  // on planes
      hybrid.arrange(eye);
      const std::vector<BlockBox> leaves = leaves_of(hybrid);
      for (int r = 0; r < 20; ++r) {
        const dvec3 target = size * dvec3(unit(random), unit(random), unit(random));
        double reached = 0.0;
        int met = 0;
        for (const BlockBox& leaf : leaves) {
          const auto [entry, exit] = interval(eye, target - eye, leaf);
          if (exit - entry <= 1e-9) continue;
          ASSERT_GE(entry, reached - 1e-9) << "eye " << e << " ray " << r;
          reached = exit;
          ++met;
        }
        several += met > 1;
      }
    }
  }
  EXPECT_GT(several, 500) << "rays of several leaves were looked at";
}

/// Bounds of a smooth volume in blocks, a few of them void, and what is seen of it.
struct HybridExample {
  HybridExample() {
    for (std::size_t n = 0; n < blocks.min.size(); n += 17) blocks.min[n] = 65535, blocks.max[n] = 0;
  }
  CellBounds cells = bounds_of(smooth_coefficients({9, 7, 5}));
  BlockBounds blocks = block_bounds(cells, 2);

  double value(double part) const { return cells.low + part * 65535.0 * cells.step; }
  Classification classified(std::span<const ValueRange> ranges) const { return classify(blocks, cells, ranges); }
  Thresholds thresholds(std::span<const ValueRange> ranges) const { return Thresholds(cells, ranges); }
};

TEST(Hybrid, MinimaAndMaximaTellOfEveryBlockWhatItsClassificationDoes) {
  const HybridExample e;
  Hybrid mm({.grid = HybridGrid::mm}), pc({.grid = HybridGrid::pc});
  for (Hybrid* hybrid : {&mm, &pc}) hybrid->prepare(e.blocks);
  int some = 0;
  const std::vector<std::vector<ValueRange>> looks{{{e.value(0.5), e.value(0.5)}},
                                                   {{e.value(0.2), e.value(0.2)}, {e.value(0.55), e.value(0.7)}, {e.value(0.9), e.value(3.0)}},
                                                   {{e.value(-1.0), e.value(2.0)}},
                                                   {{e.value(-2.0), e.value(-1.0)}},
                                                   {}};
  for (const std::vector<ValueRange>& ranges : looks) {
    const Classification c = e.classified(ranges);
    for (Hybrid* hybrid : {&mm, &pc}) hybrid->build(c, e.thresholds(ranges));
    EXPECT_EQ(active_of(mm, HybridGrid::mm), active_of(pc, HybridGrid::pc));
    EXPECT_EQ(leaves_of(mm), leaves_of(pc));
    EXPECT_EQ(mm.report().leaves, c.active_blocks);
    some += c.active_blocks > 0 && c.active_blocks < c.level.size();
  }
  EXPECT_GE(some, 3);
}

/// Which buffers have another version than before.
std::vector<std::string> changed(const Hybrid& hybrid, std::vector<StructureBuffer>& before) {
  std::vector<std::string> names;
  const auto now = hybrid.buffers();
  for (const StructureBuffer& buffer : now)
    if (before.empty() || named(before, buffer.name).version != buffer.version) names.push_back(buffer.name);
  before = now;
  return names;
}

TEST(Hybrid, ANewIsovalueLeavesMinimaAndMaximaAsTheyAre) {
  const HybridExample e;
  const std::vector<ValueRange> one{{e.value(0.5), e.value(0.5)}}, other{{e.value(0.4), e.value(0.4)}};
  for (const HybridGrid grid : {HybridGrid::mm, HybridGrid::pc}) {
    const bool mm = grid == HybridGrid::mm;
    Hybrid hybrid({.grid = grid, .least_share = 0.01});
    std::vector<StructureBuffer> before;
    hybrid.prepare(e.blocks);
    hybrid.build(e.classified(one), e.thresholds(one));
    changed(hybrid, before);
    hybrid.build(e.classified(other), e.thresholds(other));
    EXPECT_THAT(changed(hybrid, before), testing::ElementsAre("boxes", mm ? "windows" : "hybridLevel"));
    hybrid.compare(e.thresholds(one));
    EXPECT_EQ(changed(hybrid, before), mm ? std::vector<std::string>{"windows"} : std::vector<std::string>{});
    EXPECT_THAT(changed(hybrid, before), testing::IsEmpty());
    ASSERT_GE(hybrid.parameters().x, 2);
    hybrid.arrange({-50.0, -50.0, -50.0});
    changed(hybrid, before);
    hybrid.arrange({50.0, 50.0, 50.0});
    EXPECT_THAT(changed(hybrid, before), testing::ElementsAre("boxes"));
    hybrid.arrange({51.0, 50.0, 50.0});
    EXPECT_THAT(changed(hybrid, before), testing::IsEmpty());
  }
}

}  // namespace
}  // namespace quincunx
