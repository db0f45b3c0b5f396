// The combinations that `quincunx compare` measures.
#pragma once

#include <string>
#include <vector>

#include "bench/compare_subject.h"
#include "render/renderer.h"

namespace quincunx {

/// How normals are found: by the spline's gradient, by central differences of the spline, or by those of its coefficients a
/// lattice step apart.
struct NormalChoice {
  Normal normal = Normal::analytic;
  double delta = 0.5;  ///< of Normal::central, in cells

  bool operator==(const NormalChoice&) const = default;
  /// "analytic", "central 0.5", "samples".
  std::string label() const;
};

/// One combination.
struct CompareSetting {
  std::size_t volume = 0;  ///< of the subject
  std::string spline;
  Spline::Prefilter prefilter = Spline::Prefilter::none;  ///< one that the spline has
  Storage storage = Storage::float32;
  Intersect intersect = Intersect::exact;
  double step = 0.0;  ///< of Intersect::march, in cells; 0 for exact
  NormalChoice normal;
  SkipConfig skip;

  /// Whether both are of one spline of one volume, and so have a reference in common.
  bool same_spline(const CompareSetting& other) const;
  /// The same, and the same coefficients: whether a renderer is theirs in common.
  bool same_coefficients(const CompareSetting& other) const;
  /// The same, and the same gradients: alike but for the way to the hit.
  bool same_reconstruction(const CompareSetting& other) const;
  /// "exact" or "march 0.25".
  std::string method() const;
  /// "fir", "none", ...
  std::string prefilter_text() const;
  /// All that tells it from others: "bcc7 fir, exact, analytic".
  std::string label(const CompareSubject& subject) const;
  /// `request` made this setting's own.
  Renderer::Request applied(Renderer::Request request) const;
};

/// What is to be combined. Lists are not empty, their entries differ.
struct CompareChoices {
  std::vector<std::string> splines;  ///< those whose lattice a volume has are taken
  std::vector<Spline::Prefilter> prefilters{Spline::Prefilter::automatic};  ///< those that a spline has are taken, each once
  std::vector<Storage> storages{Storage::float32};
  std::vector<Intersect> intersects{Intersect::exact, Intersect::march};  ///< exact where the spline is polynomial
  std::vector<double> steps{0.5, 0.25, 0.125};  ///< of march, cells
  std::vector<NormalChoice> normals{NormalChoice{}};
  std::vector<SkipConfig> skips{SkipConfig{}};
};

/// Every combination that there is, volume by volume, spline by spline. Throws InputError where there is none.
std::vector<CompareSetting> compare_settings(const CompareSubject& subject, const CompareChoices& choices);

}  // namespace quincunx
