#include "bench/presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lattice/error.h"

namespace quincunx {
namespace {

#define GANTER "D. Ganter, M. Manzke, An analysis of region clustered BVH volume rendering on GPU, 2019, doi:10.1111/cgf.13756"
#define ZELLMANN \
  "S. Zellmann, Comparing hierarchical data structures for sparse volume rendering with empty space skipping, 2019, doi:10.36227/techrxiv.11416422, and S. Zellmann, D. Meurer, " \
  "U. Lang, Hybrid grids for sparse volume rendering, 2019, doi:10.1109/VISUAL.2019.8933631"
#define NOT_AT_HAND "The published figures are not at hand."

}  // namespace

const std::vector<Preset>& presets() {
  static const std::vector<Preset> list{
      {"ganter-table1", GANTER ", Table 1", "active blocks, what they are clustered to, and the time of clustering and of the hierarchy",
       "17.6 ms to cluster 22,058 active of 262,144 blocks, 1,090 ms for 2,262,811 of 16,777,216, on other hardware; leaves 38-53 % of the active blocks on strands, 5-35 % on solid parts. "
       "The other figures are not at hand.",
       true, ganter_table1},
      {"ganter-figure6", GANTER ", Figure 6", "frames with and without clustering",
       "frames are 10-15 % faster with clustering (cubes). The figure's numbers are not at hand.", true, ganter_figure6},
      {"ganter-figure7", GANTER ", Figure 7", "the time of clustering and of the hierarchy against the active part of the blocks",
       "building takes so little that it does not matter. The figure's numbers are not at hand.", true, ganter_figure7},
      {"ganter-figure8", GANTER ", Figure 8", "structures walked to the end of all rays, nothing evaluated",
       "the hierarchy (of cubes) is 20-40 % faster than SparseLeap (segments), and its times are spread less. The figure's numbers are not at hand.", true, ganter_figure8},
      {"ganter-figure10", GANTER ", Figure 10", "two transfer functions of which the same blocks are active, one opaque and one clear", NOT_AT_HAND, true, ganter_figure10},
      {"zellmann-table1", ZELLMANN ", Table 1", "data sets, and the construction and frame rate of each structure", NOT_AT_HAND, true, zellmann_table1},
      {"zellmann-figure3", ZELLMANN ", Figure 3", "frame rates of each structure", NOT_AT_HAND, true, zellmann_figure3},
      {"zellmann-figure4", ZELLMANN ", Figure 4", "what structures cost where nothing is empty", NOT_AT_HAND, true, zellmann_figure4},
      {"zellmann-figure5", ZELLMANN ", Figure 5", "clusters that grow, and clusters that become more: construction and frames", NOT_AT_HAND, false, zellmann_figure5},
      {"kinkelin-table3", "M. Kinkelin, GPU volume raycasting using bounding interval hierarchies, TU Wien, 2009, Table 3", "nodes, depth and bytes of trees, against the bytes of the grid",
       NOT_AT_HAND, true, kinkelin_table3},
  };
  return list;
}

#undef GANTER
#undef ZELLMANN
#undef NOT_AT_HAND

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  return names;
}

const Preset& preset_of(std::string_view name) {
  for (const Preset& preset : presets())
    if (preset.name == name) return preset;
  throw InputError(fmt::format("--preset: found '{}', expected one of {}", name, fmt::join(preset_names(), ", ")));
}

}  // namespace quincunx
