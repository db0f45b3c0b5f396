// Active blocks merged to larger boxes.
#pragma once

#include <vector>

#include "accel/block_box.h"
#include "accel/classification.h"

namespace quincunx {

/// The region clustering of D. Ganter and M. Manzke, "An analysis of region clustered BVH volume rendering on GPU", Computer
/// Graphics Forum 38(8), 2019, doi:10.1111/cgf.13756: cubes of edge max_cluster down to 1 are taken wherever all their blocks are active
/// (a summed-volume table says so) and none is taken. Unlike their printed loop, which ends before the last layer,
/// this one looks at every position.
/// Returns disjoint boxes that hold every active block and no other, the largest first.
std::vector<BlockBox> cluster_cubes(const Classification& blocks, int max_cluster);

/// Boxes of any proportions, grown greedily from the rows' runs of active blocks. The same guarantee as cluster_cubes, in a
/// fraction of the time. The order is a function of the blocks alone.
std::vector<BlockBox> cluster_boxes(const Classification& blocks);

/// Every active block by itself, x fastest.
std::vector<BlockBox> single_blocks(const Classification& blocks);

}  // namespace quincunx
