// The renderer of `--device cpu`: the double-precision reference caster behind the renderer's interface.
#pragma once

#include <optional>

#include "render/reference.h"
#include "render/renderer.h"

namespace quincunx {

class ReferenceRenderer final : public Renderer {
 public:
  /// With a config.storage other than float32 coefficients are what kernels decode of it, else what the prefilter makes, in doubles.
  ReferenceRenderer(const Volume& volume, const Config& config);
  Frame render(const Request& request, RenderStats& stats, const Progress& progress = {}) override;
  std::vector<Feature> explain(const Request&) override { return {}; }

 private:
  void prepare_coefficients(const Progress& progress);

  Config config_;
  std::unique_ptr<Spline> spline_;
  Volume volume_;  ///< until the coefficients are made
  std::optional<Coefficients<double>> coefficients_;
  std::optional<CellBounds> cells_;
  VoidCells voids_;
};

}  // namespace quincunx
