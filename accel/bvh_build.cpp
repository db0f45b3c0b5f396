#include "accel/bvh_build.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <new>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>

namespace quincunx {
namespace {

using Device = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;
using Hierarchy = std::unique_ptr<RTCBVHTy, decltype(&rtcReleaseBVH)>;

/// What Embree said last; it says so in the thread that called it.
thread_local RTCError last_error = RTC_ERROR_NONE;
thread_local std::string last_text;

std::runtime_error embree_error() { return std::runtime_error(fmt::format("Embree: error {}: {}", int(last_error), last_text)); }

RTCDevice embree() {
  static const Device device = [] {
    Device made(rtcNewDevice(nullptr), rtcReleaseDevice);
    if (!made) throw std::runtime_error(fmt::format("Embree: no device: error {}", int(rtcGetDeviceError(nullptr))));
    const auto keep = [](void*, RTCError code, const char* text) { last_error = code, last_text = text ? text : ""; };
    rtcSetDeviceErrorFunction(made.get(), keep, nullptr);
    return made;
  }();
  return device.get();
}

/// A node as Embree's threads make it, in Embree's memory; `box` is the number of a leaf's.
struct RawNode {
  RawNode* child[2];
  std::uint32_t box;
};

void* new_node(RTCThreadLocalAllocator allocator, std::uint32_t box) {
  void* memory = rtcThreadLocalAlloc(allocator, sizeof(RawNode), alignof(RawNode));
  if (!memory) throw std::bad_alloc();
  return new (memory) RawNode{{nullptr, nullptr}, box};
}

RTCBuildArguments build_arguments(RTCBVH bvh, std::vector<RTCBuildPrimitive>& primitives, int max_depth) {
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = 2;
  arguments.maxDepth = unsigned(max_depth);
  arguments.minLeafSize = arguments.maxLeafSize = 1;
  arguments.bvh = bvh;
  arguments.primitives = primitives.data();
  arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = [](RTCThreadLocalAllocator allocator, unsigned, void*) { return new_node(allocator, 0); };
  arguments.setNodeChildren = [](void* node, void** children, unsigned count, void*) {
    for (unsigned n = 0; n < count; ++n) static_cast<RawNode*>(node)->child[n] = static_cast<RawNode*>(children[n]);
  };
  // Embree's boxes are not needed: they are floats.
  arguments.setNodeBounds = [](void*, const RTCBounds**, unsigned, void*) {};
  arguments.createLeaf = [](RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitive, std::size_t, void*) {
    return new_node(allocator, primitive->primID);
  };
  return arguments;
}

/// Gives inner nodes, which come before their children, the union of these.
void unite(std::vector<BoxNode>& nodes) {
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    if (node->child[0] < 0) continue;
    const BlockBox &a = nodes[std::size_t(node->child[0])].box, &b = nodes[std::size_t(node->child[1])].box;
    node->box = {glm::min(a.low, b.low), glm::max(a.high, b.high)};
  }
}

std::vector<BoxNode> converted(const RawNode* root, const std::vector<BlockBox>& boxes) {
  std::vector<BoxNode> nodes(1);
  nodes.reserve(2 * boxes.size() - 1);
  std::vector<const RawNode*> raw = {root};  // of each node
  raw.reserve(nodes.capacity());
  for (std::size_t n = 0; n < raw.size(); ++n) {
    if (!raw[n]->child[0]) {
      nodes[n].box = boxes[raw[n]->box];
      continue;
    }
    for (int c = 0; c < 2; ++c) {
      nodes[n].child[c] = std::int32_t(nodes.size());
      nodes.emplace_back();
      raw.push_back(raw[n]->child[c]);
    }
  }
  assert(nodes.size() == 2 * boxes.size() - 1);
  unite(nodes);
  return nodes;
}

/// Appends the tree over boxes[order...] and returns the number of its root.
std::int32_t halve(std::span<std::uint32_t> order, const std::vector<BlockBox>& boxes, std::vector<BoxNode>& nodes) {
  const std::int32_t root = std::int32_t(nodes.size());
  nodes.emplace_back();
  if (order.size() == 1) {
    nodes.back().box = boxes[order[0]];
    return root;
  }
  const auto middle = [&](std::uint32_t n) { return boxes[n].low + boxes[n].high; };  // twice that
  glm::ivec3 least = middle(order[0]), most = least;
  for (const std::uint32_t n : order) least = glm::min(least, middle(n)), most = glm::max(most, middle(n));
  const glm::ivec3 extent = most - least;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(middle(a)[axis], a) < std::pair(middle(b)[axis], b);
  };
  const std::size_t half = order.size() / 2;
  std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(half), order.end(), before);
  const std::int32_t first = halve(order.first(half), boxes, nodes), second = halve(order.subspan(half), boxes, nodes);
  nodes[std::size_t(root)].child[0] = first;
  nodes[std::size_t(root)].child[1] = second;
  return root;
}

}  // namespace

std::vector<BoxNode> sah_hierarchy(const std::vector<BlockBox>& boxes, int max_depth) {
  if (boxes.empty()) return {};
  const Hierarchy bvh(rtcNewBVH(embree()), rtcReleaseBVH);
  if (!bvh) throw embree_error();
  std::vector<RTCBuildPrimitive> primitives(boxes.size());
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    const glm::vec3 low(boxes[n].low), high(boxes[n].high);  // exact below 2^24
    primitives[n] = {low.x, low.y, low.z, 0, high.x, high.y, high.z, unsigned(n)};
  }
  const RTCBuildArguments arguments = build_arguments(bvh.get(), primitives, max_depth);
  if (const void* root = rtcBuildBVH(&arguments)) return converted(static_cast<const RawNode*>(root), boxes);
  // Embree has no code of its own for trees that become too deep.
  if (last_error != RTC_ERROR_UNKNOWN || last_text != "depth limit reached") throw embree_error();
  return median_hierarchy(boxes);
}

std::vector<BoxNode> median_hierarchy(const std::vector<BlockBox>& boxes) {
  std::vector<BoxNode> nodes;
  if (boxes.empty()) return nodes;
  nodes.reserve(2 * boxes.size() - 1);
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  halve(order, boxes, nodes);
  unite(nodes);
  return nodes;
}

}  // namespace quincunx
