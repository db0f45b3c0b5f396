// A volume of more samples than 32 bits with a sign can number: nearly all of it empty, made as it is asked for.
#pragma once

#include <memory>
#include <string>

#include "bench/stability_measure.h"
#include "lattice/sample_source.h"

namespace quincunx {

/// A ball of 8-bit samples in the far corner, whose sample numbers pass 2^31.
class HugeVolume final : public SampleSource {
 public:
  explicit HugeVolume(LatticeKind lattice);

  const Volume& header() const override { return header_; }
  Volume read_box(const glm::i64vec3& low, const glm::i64vec3& high) const override;

  /// The part that holds the ball with room about it, as a volume of its own in its place in the world.
  Volume corner() const;
  /// Looks at the ball from outside.
  Camera camera() const;
  static constexpr double kIsovalue = 128.0;

 private:
  Volume header_;
  glm::dvec3 middle_;  ///< of the ball, lattice coordinates
};

/// Renders it through a pool of bricks and judges the picture by the spline of the corner alone.
StabilityLine measure_huge(const std::string& spline, const std::shared_ptr<KernelCache>& kernels, const Progress& progress = {});

}  // namespace quincunx
