// Bounds of a volume that need not be in memory, made box by box.
#pragma once

#include <optional>
#include <string_view>

#include "accel/bricks.h"
#include "lattice/sample_source.h"

namespace quincunx {

/// What a pass over all samples finds: their range, the scale of bounds that follows from it, and the bounds of blocks.
struct StreamedBounds {
  SampleRange samples;
  ValueUnit unit;  ///< that the bounds are in: float_unit of the samples
  BoundsScale scale;
  BlockBounds blocks;
};

/// Bounds of the spline over blocks of `block` cells, certain like block_bounds(cell_bounds(...)) of the whole volume. They are on a scale
/// that allows whatever the prefilter may make of such samples, and by up to four of its steps wider, as some margins suppose the largest
/// coefficient of the volume near every cell.
///
/// Two passes over the samples, for their range, where that is not `known`, and for the bounds. Beside the result each thread holds one box, of at most 512 x 64 x 64
/// cells, with what is made of it.
/// `bricks`, where given, are how coefficients will be stored: each brick in a unit of its own. The bounds are then of what kernels make of these, in the brick
/// that a cell belongs to or, at a brick's face, in the one beside it: wider by what rounding to the format may add there (value_error of BrickErrors). Blocks are
/// no larger than bricks.
/// Throws InputError, naming `what`, where samples are NaN or infinite (count and first place), and where they cannot be read.
StreamedBounds streamed_bounds(const SampleSource& source, const Spline& spline, Spline::Prefilter prefilter, int block,
                               std::string_view what, const Progress& progress = {}, const std::optional<SampleRange>& known = {},
                               const BrickLayout* bricks = nullptr);

}  // namespace quincunx
