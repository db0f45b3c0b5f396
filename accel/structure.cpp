#include "accel/structure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "accel/bih.h"
#include "accel/bvh.h"
#include "accel/distance.h"
#include "accel/grid.h"
#include "accel/hybrid.h"
#include "accel/kdtree.h"
#include "accel/none.h"
#include "accel/octree.h"
#include "accel/segments.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

using Made = std::unique_ptr<SkippingStructure>;

/// A row of the one list.
struct Row {
  std::string_view name;
  Made (*make)(const SkipConfig&);
};
constexpr Row kStructures[] = {
    {"none", [](const SkipConfig&) -> Made { return std::make_unique<None>(); }},
    {"grid", [](const SkipConfig&) -> Made { return std::make_unique<Grid>(); }},
    {"octree", [](const SkipConfig&) -> Made { return std::make_unique<Octree>(); }},
    {"distance", [](const SkipConfig&) -> Made { return std::make_unique<Distance>(); }},
    {"bvh", [](const SkipConfig& c) -> Made { return std::make_unique<Bvh>(Bvh::Config{c.clustering, c.max_cluster}); }},
    {"bih", [](const SkipConfig&) -> Made { return std::make_unique<BihSkipping>(); }},
    {"kdtree", [](const SkipConfig& c) -> Made { return std::make_unique<KdTree>(KdTree::Config{.depth = c.kd, .least_share = c.least_leaf}); }},
    {"hybrid", [](const SkipConfig& c) -> Made { return std::make_unique<Hybrid>(Hybrid::Config{c.hybrid, c.least_leaf}); }},
    {"segments", [](const SkipConfig& c) -> Made { return std::make_unique<Segments>(Segments::Config{.capacity = c.max_segments}); }},
};

/// A choice that some structures have, as it stands behind their name in a label.
struct Choice {
  std::string_view label, structure;
  Clustering clustering;
  KdDepth kd;
  HybridGrid hybrid = HybridGrid::pc;
};
constexpr Choice kLabels[] = {
    {"none", "none", Clustering::none, KdDepth::deep},
    {"grid", "grid", Clustering::none, KdDepth::deep},
    {"octree", "octree", Clustering::none, KdDepth::deep},
    {"distance", "distance", Clustering::none, KdDepth::deep},
    {"bvh", "bvh", Clustering::none, KdDepth::deep},
    {"bvh:cubes", "bvh", Clustering::cubes, KdDepth::deep},
    {"bvh:boxes", "bvh", Clustering::boxes, KdDepth::deep},
    {"bih", "bih", Clustering::none, KdDepth::deep},
    {"kdtree:shallow", "kdtree", Clustering::none, KdDepth::shallow},
    {"kdtree:deep", "kdtree", Clustering::none, KdDepth::deep},
    {"hybrid:mm", "hybrid", Clustering::none, KdDepth::deep, HybridGrid::mm},
    {"hybrid:pc", "hybrid", Clustering::none, KdDepth::deep, HybridGrid::pc},
    {"segments", "segments", Clustering::none, KdDepth::deep},
};

}  // namespace

const std::vector<std::string_view>& structure_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const Row& row : kStructures) all.push_back(row.name);
    return all;
  }();
  return names;
}

std::unique_ptr<SkippingStructure> make_structure(const SkipConfig& config) {
  for (const Row& row : kStructures)
    if (row.name == config.structure) return row.make(config);
  throw InputError(
      fmt::format("--skip: found {}, expected one of {}", config.structure, fmt::join(structure_names(), ", ")));
}

const std::vector<std::string_view>& skip_labels() {
  static const std::vector<std::string_view> labels = [] {
    std::vector<std::string_view> all;
    for (const Choice& choice : kLabels) all.push_back(choice.label);
    return all;
  }();
  return labels;
}

SkipConfig labelled_skip(std::string_view label, SkipConfig base) {
  for (const Choice& choice : kLabels) {
    if (choice.label != label) continue;
    base.structure = choice.structure;
    base.clustering = choice.clustering;
    base.kd = choice.kd;
    base.hybrid = choice.hybrid;
    return base;
  }
  throw InputError(fmt::format("found {}, expected one of {}", label, fmt::join(skip_labels(), ", ")));
}

std::string skip_label(const SkipConfig& config) {
  for (const Choice& choice : kLabels) {
    const bool clustering = config.structure != "bvh" || choice.clustering == config.clustering;
    const bool kd = config.structure != "kdtree" || choice.kd == config.kd;
    const bool hybrid = config.structure != "hybrid" || choice.hybrid == config.hybrid;
    if (choice.structure == config.structure && clustering && kd && hybrid) return std::string(choice.label);
  }
  return config.structure;
}

}  // namespace quincunx
