#include "bench/huge_volume.h"

#include <cmath>

#include "render/device_renderer.h"

namespace quincunx {
namespace {

constexpr std::int64_t kBccExtent = 1025, kCartesianExtent = 1292;  // 2.15e9 and 2.16e9 samples; 2^31 is 2.147e9
constexpr double kRadius = 20.0, kInset = 30.25;                    // of the ball, and of its middle from the domain's far corner, cells
constexpr double kSlope = 6.0;                                      // values a cell
constexpr double kReach = kRadius + HugeVolume::kIsovalue / kSlope; // where values are 0
constexpr std::int64_t kCornerCells = 64;
constexpr std::uint64_t kPool = std::uint64_t(32) << 20;
constexpr int kPixels = 64;

}  // namespace

HugeVolume::HugeVolume(LatticeKind lattice) {
  header_.lattice = lattice;
  header_.extents = Extents(lattice == LatticeKind::bcc ? kBccExtent : kCartesianExtent);
  header_.samples = std::vector<std::uint8_t>{};
  middle_ = glm::dvec3(domain_max(lattice, header_.extents)) - kInset;
}

Volume HugeVolume::read_box(const glm::i64vec3& low, const glm::i64vec3& high) const {
  Volume box = empty_box(header_, low, high);
  const double step = lattice_step(header_.lattice);
  if (glm::any(glm::lessThan(step * glm::dvec3(high) + 1.0, middle_ - kReach))) return box;
  auto sample = std::get<std::vector<std::uint8_t>>(box.samples).begin();
  for (int c = 0; c < coset_count(header_.lattice); ++c)
    for (std::int64_t k = low.z; k < high.z; ++k)
      for (std::int64_t j = low.y; j < high.y; ++j)
        for (std::int64_t i = low.x; i < high.x; ++i) {
          const double distance = glm::distance(step * glm::dvec3(i, j, k) + double(c), middle_);
          *sample++ = std::uint8_t(std::rint(glm::clamp(kIsovalue + kSlope * (kRadius - distance), 0.0, 255.0)));
        }
  return box;
}

Volume HugeVolume::corner() const {
  const std::int64_t n = kCornerCells / lattice_step(header_.lattice) + 1;
  return read_box(header_.extents - n, header_.extents);
}

Camera HugeVolume::camera() const {
  const glm::dvec3 middle = header_.world.to_world(middle_);
  return {middle + glm::dvec3(70.0, 90.0, 50.0), middle, {0.0, 0.0, 1.0}, 22.0};
}

StabilityLine measure_huge(const std::string& name, const std::shared_ptr<KernelCache>& kernels, const Progress& progress) {
  const std::unique_ptr<Spline> spline = make_spline(name);
  const auto source = std::make_shared<HugeVolume>(spline->lattice());
  Renderer::Config config;
  config.spline = name;
  config.pool_bytes = kPool;
  Renderer::Request request;
  request.scene.isosurfaces = {Isosurface{.isovalue = HugeVolume::kIsovalue}};
  request.scene.camera = source->camera();
  request.scene.width = request.scene.height = kPixels;
  request.skip.structure = "grid";
  request.skip.block = 32;
  DeviceRenderer renderer(kernels, source, "huge volume", config);
  RenderStats stats;
  const Frame frame = renderer.render(request, stats, progress);

  const Coefficients<double> coefficients = spline->coefficients(source->corner(), Spline::Prefilter::automatic);
  StabilityLine line;
  line.group = "index";
  line.name = "sample numbers beyond 2^31, through bricks";
  line.spline = name;
  line.isovalue = HugeVolume::kIsovalue;
  Judge::Config floats;
  floats.cells = cell_count(spline->lattice(), source->header().extents);
  line.exact = Judge(*spline, coefficients, request.scene, nullptr).judge(frame, floats);
  return line;
}

}  // namespace quincunx
