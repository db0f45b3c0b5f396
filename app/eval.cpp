// quincunx eval: value and gradient of the spline at given points.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>

#include "accel/void_cells.h"
#include "app/command.h"
#include "app/evaluate_float.h"
#include "app/flags.h"
#include "app/nan_flag.h"
#include "app/points_file.h"
#include "app/spline_flags.h"
#include "app/volume_input.h"
#include "render/precision.h"
#include "spline/spline.h"

namespace quincunx {
namespace {

struct EvalFlags {
  std::string volume, points;
  std::string spline;  ///< empty: that of the volume's lattice
  Precision precision = Precision::float64;
  Spline::Prefilter prefilter = Spline::Prefilter::automatic;
  Storage storage = Storage::float32;
  NanPolicy nan;
  Verbosity verbosity = Verbosity::normal;
};

/// The spline of a volume, evaluated in the world.
class WorldSpline {
 public:
  /// Makes the volume's samples finite.
  WorldSpline(Volume& volume, const EvalFlags& flags, const Progress& progress)
      : spline_(make_spline(flags.spline, volume.lattice)),
        precision_(flags.precision),
        origin_(volume.world.origin),
        inverse_axes_(glm::inverse(volume.world.axes)),
        far_(domain_max(volume.lattice, volume.extents)),
        voids_(make_finite(volume, *spline_, flags.nan)) {
    const bool doubles = precision_ == Precision::float64, rounded = flags.storage != Storage::float32;
    if (doubles && !rounded) {
      coefficients_ = spline_->coefficients(volume, flags.prefilter, progress);
    } else {
      float_coefficients_ = stored_coefficients(*spline_, volume, flags.prefilter, flags.storage, progress);
    }
    if (doubles && rounded) coefficients_ = values_of(float_coefficients_);
  }

  /// Value and gradient per world unit at x (world); NaN outside the domain and in void cells. A point outside by no more than the
  /// rounding of its own coordinates counts as on the border.
  Jet operator()(const glm::dvec3& x) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const glm::dvec3 u = inverse_axes_ * (x - origin_);
    const glm::dvec3 inside = glm::clamp(u, glm::dvec3(0.0), far_);
    const double slack = 1e-12 * std::max({1.0, far_.x, far_.y, far_.z});
    if (!glm::all(glm::lessThanEqual(glm::abs(u - inside), glm::dvec3(slack)))) return {nan, glm::dvec3(nan)};
    if (voids_.at(cell_of(inside, glm::i64vec3(far_)))) return {nan, glm::dvec3(nan)};
    const Jet jet = precision_ == Precision::float64 ? spline_->evaluate(coefficients_, inside)
                                                     : evaluate_float(*spline_, float_coefficients_, inside);
    return {jet.value, glm::transpose(inverse_axes_) * jet.gradient};
  }

 private:
  std::unique_ptr<Spline> spline_;
  Precision precision_;
  Coefficients<double> coefficients_;
  Coefficients<float> float_coefficients_;
  glm::dvec3 origin_;
  glm::dmat3 inverse_axes_;
  glm::dvec3 far_;
  VoidCells voids_;
};

/// Reads all of the file, so that a bad line is found before anything is printed; the number of its points.
std::uint64_t count_points(const std::string& path) {
  std::uint64_t count = 0;
  for (PointsFile file(path); file.next();) ++count;
  return count;
}

void print_rows(const std::vector<glm::dvec3>& points, const std::vector<Jet>& jets) {
  fmt::memory_buffer text;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const glm::dvec3 &x = points[n], &g = jets[n].gradient;
    fmt::format_to(std::back_inserter(text), "{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", x.x, x.y, x.z,
                   jets[n].value, g.x, g.y, g.z);
  }
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) {
    throw std::runtime_error("standard output cannot be written");
  }
}

void eval(const EvalFlags& flags) {
  constexpr std::size_t chunk = 8192;
  ProgressBar bar(flags.verbosity);
  const std::uint64_t count = count_points(flags.points);
  Volume volume = read_finite_volume(flags.volume, bar.stage("reading"), flags.nan);
  const WorldSpline spline(volume, flags, bar.stage("prefilter"));

  const Progress progress = bar.stage("evaluating");
  PointsFile file(flags.points);
  std::vector<glm::dvec3> points;
  std::vector<Jet> jets;
  fmt::print("x,y,z,value,gx,gy,gz\n");
  for (std::uint64_t done = 0;; done += points.size()) {
    report(progress, count == 0 ? 1.0 : double(done) / double(count));
    points.clear();
    while (points.size() < chunk) {
      const auto point = file.next();
      if (!point) break;
      points.push_back(*point);
    }
    if (points.empty()) return;
    jets.resize(points.size());
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t n) { jets[n] = spline(points[n]); });
    print_rows(points, jets);
  }
}

}  // namespace

Command eval_command(CLI::App& program) {
  auto flags = std::make_shared<EvalFlags>();
  CLI::App* app = program.add_subcommand("eval", "Print value and gradient of the spline at given points");
  app->footer(
      "Prints CSV, 17 significant digits: x,y,z,value,gx,gy,gz; world coordinates, the gradient per world unit.\n"
      "A point outside the domain gets nan, and with --nan empty one in a cell where a sample that is not finite has a weight.\n"
      "--precision double: coefficients and evaluation in double, the reference that kernels are compared with.\n"
      "--precision float: coefficients and weights rounded to 32-bit floats, multiplied and added in floats; the\n"
      "  weights are found in double, so this is the least that single precision loses, not a kernel's own order.\n"
      "--storage other than float32: of the coefficients as a device decodes them, in either precision.");
  app->add_option("VOLUME", flags->volume, "NRRD file")->required();
  app->add_option("--points", flags->points, "CSV file of points x,y,z (world), with or without a header line")
      ->type_name("P.csv")
      ->required();
  add_choice(*app, "--precision", flags->precision,
             {{"double", Precision::float64}, {"float", Precision::float32}}, "Of coefficients and sums");
  add_spline(*app, flags->spline);
  add_prefilter(*app, flags->prefilter);
  add_storage(*app, flags->storage);
  add_nan(*app, flags->nan);
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { eval(*flags); }};
}

}  // namespace quincunx
