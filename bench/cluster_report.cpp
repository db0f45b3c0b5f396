#include "bench/cluster_report.h"

#include <fmt/format.h>

#include "bench/timing.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

std::string median_text(const std::vector<double>& values) { return three_digits(spread(values).median); }

Json to_json(const ClusterLine& line, const ClusterCost& cost) {
  return {{"leaves", cost.leaves},
          {"leaves_per_active", line.part(cost)},
          {"cluster_ms", spread_json(spread(cost.cluster_ms))},
          {"build_ms", spread_json(spread(cost.build_ms))}};
}

}  // namespace

Table cluster_table(const ClusterReport& report) {
  Table table{.headings = {"mask", "blocks", "active", "active %", "cubes", "cubes %", "boxes", "boxes %", "cubes ms", "boxes ms",
                           "speed-up", "BVH of blocks", "of cubes", "of boxes"},
              .rows = {}};
  for (const ClusterLine& line : report.lines) {
    const std::int64_t blocks = line.blocks.x * line.blocks.y * line.blocks.z;
    std::vector<std::string> row{line.mask, fmt::format("{}", blocks), fmt::format("{}", line.active),
                                 fmt::format("{:.1f}", 100.0 * double(line.active) / double(blocks))};
    for (const ClusterCost* cost : {&line.cubes, &line.boxes}) {
      row.push_back(fmt::format("{}", cost->leaves));
      row.push_back(fmt::format("{:.1f}", 100.0 * line.part(*cost)));
    }
    for (const ClusterCost* cost : {&line.cubes, &line.boxes}) row.push_back(median_text(cost->cluster_ms));
    row.push_back(median_text(line.speedups()));
    for (const ClusterCost* cost : {&line.single, &line.cubes, &line.boxes}) row.push_back(median_text(cost->build_ms));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string cluster_caption(const ClusterReport& report) {
  return fmt::format(
      "Active blocks merged to cubes of at most {} blocks' edge (Ganter and Manzke 2019) and to boxes of any proportions: leaves, also in % "
      "of the active blocks; median times in ms of {} round{} in turns: merging, its speed-up by boxes, then the hierarchy over single "
      "blocks, cubes and boxes; {}. Published, on other hardware: 17.6 ms for 22,058 active of 262,144 blocks, 1,090 ms for 2,262,811 of "
      "16,777,216; leaves 38-53 % of the active blocks on strands, 5-35 % on solid parts.",
      report.max_cluster, report.rounds, report.rounds == 1 ? "" : "s", machine_text(report.machine));
}

Json cluster_json(const ClusterReport& report) {
  Json json{{"measurement", "cluster"},
            {"max_cluster", report.max_cluster},
            {"repeat", report.rounds},
            {"processor", report.machine.processor},
            {"cores", report.machine.cores}};
  for (const ClusterLine& line : report.lines)
    json["masks"].push_back({{"mask", line.mask},
                             {"blocks", {line.blocks.x, line.blocks.y, line.blocks.z}},
                             {"active", line.active},
                             {"single", to_json(line, line.single)},
                             {"cubes", to_json(line, line.cubes)},
                             {"boxes", to_json(line, line.boxes)},
                             {"speedup", spread_json(spread(line.speedups()))}});
  return json;
}

}  // namespace quincunx
