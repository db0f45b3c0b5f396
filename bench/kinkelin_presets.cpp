// M. Kinkelin, "GPU Volume Raycasting using Bounding Interval Hierarchies", student project, TU Wien, 2009: its Table 3 on other data, for the bounding
// interval hierarchy (`bih`) where it is among the structures, and for the other trees.
#include <limits>

#include "accel/structure.h"
#include "bench/presets.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

struct Built {
  StructureReport report;
  std::uint64_t bytes = 0;  ///< of the buffers that go to the device
};

Built build(const std::string& label, const BlockBounds& bounds, const Classification& blocks, const Thresholds& thresholds) {
  const auto structure = make_structure(labelled_skip(label));
  structure->prepare(bounds);
  structure->build(structure->needs() == SkippingStructure::Needs::classification ? blocks : Classification{}, thresholds);
  Built built{.report = structure->report()};
  for (const StructureBuffer& buffer : structure->buffers()) built.bytes += buffer.bytes.size();
  return built;
}

/// Where structures count their nodes with one child.
Json one_child(const auto& report) {
  if constexpr (requires { report.one_child; }) {
    return report.nodes > 0 ? Json(report.one_child) : Json(nullptr);
  } else {
    return nullptr;
  }
}

}  // namespace

void kinkelin_table3(PresetRun& run) {
  PresetReport& report = run.report();
  report.columns = {"data_set", "structure", "block", "blocks", "active", "leaves", "nodes", "one_child", "depth", "bytes", "times_grid", "published"};
  report.left = 2;
  report.notes = {"Bytes of the structure on the device, and how many times those of the grid."};
  const auto labels = run.known({"bih", "bvh", "bvh:cubes", "bvh:boxes", "kdtree:deep", "octree", "grid"});
  for (const PresetSource& source : run.sources({"strands", "solid parts", "vessels"}, run.size().cluster_cells)) {
    const PresetVolume data = source.make(run.bar().stage(source.name));
    const CellBounds cells = run.bounds(data);
    const ValueRange seen{data.threshold, std::numeric_limits<double>::max()};
    const Thresholds thresholds(cells, {&seen, 1});
    const Progress progress = run.bar().stage(source.name + ", structures");
    for (const int block : run.size().cluster_blocks) {
      quincunx::report(progress, double(block) / double(2 * run.size().cluster_blocks.back()));
      const BlockBounds bounds = block_bounds(cells, block);
      const Classification blocks = classify(bounds, cells, {&seen, 1});
      const std::uint64_t grid = build("grid", bounds, blocks, thresholds).bytes;
      for (const std::string& label : labels) {
        const Built built = build(label, bounds, blocks, thresholds);
        const bool tree = built.report.nodes > 0;
        report.rows.push_back({source.name, label, block, blocks.level.size(), blocks.active_blocks,
                               built.report.leaves > 0 ? Json(built.report.leaves) : Json(nullptr), tree ? Json(built.report.nodes) : Json(nullptr), one_child(built.report),
                               tree ? Json(built.report.depth) : Json(nullptr), built.bytes, double(built.bytes) / double(grid), nullptr});
      }
    }
  }
}

}  // namespace quincunx
