#include "accel/grid.h"

namespace quincunx {

void Grid::build(const Classification& classification) { level_ = classification.level; }

std::vector<StructureBuffer> Grid::buffers() const { return {{"gridLevel", std::as_bytes(std::span(level_))}}; }

}  // namespace quincunx
