// Normals of sample differences (--normal samples): what they are, and that kernels and the reference make the same of them.
#include <gtest/gtest.h>

#include "lattice/error.h"
#include "render/reference_renderer.h"
#include "render/shading.h"
#include "tests/render/device_fixture.h"
#include "tests/render/void_volumes.h"

namespace quincunx {
namespace {

/// Noise of 256ths, whose differences are exact floats.
Volume dyadic_noise(LatticeKind lattice) {
  std::mt19937 random(8);
  return field_volume(lattice, [&](const glm::dvec3&) { return double(random() % 256) / 256.0; });
}

/// The volume of central differences of the samples along an axis of a coset, per lattice coordinate; indices are clamped.
Volume sample_differences(const Volume& volume, int axis) {
  Volume differences = volume;
  auto& samples = std::get<std::vector<float>>(differences.samples);
  const Extents& n = volume.extents;
  std::size_t number = 0;
  for (int c = 0; c < coset_count(volume.lattice); ++c)
    for (std::int64_t k = 0; k < n.z; ++k)
      for (std::int64_t j = 0; j < n.y; ++j)
        for (std::int64_t i = 0; i < n.x; ++i) {
          glm::i64vec3 low(i, j, k), high(i, j, k);
          low[axis] = std::max<std::int64_t>(low[axis] - 1, 0), high[axis] = std::min(high[axis] + 1, n[axis] - 1);
          samples[number++] = float((volume.sample(c, high) - volume.sample(c, low)) / (2.0 * lattice_step(volume.lattice)));
        }
  return differences;
}

TEST(SampleNormals, AreTheSampleDifferencesInterpolatedByTheSpline) {
  Scene scene;
  scene.normal = Normal::samples;
  for (const std::string_view name : spline_names()) {
    const auto spline = make_spline(name);
    const Volume volume = dyadic_noise(spline->lattice());
    const double step = difference_step(scene, volume.lattice);
    EXPECT_EQ(step, lattice_step(volume.lattice));
    const Coefficients<double> c = spline->coefficients(volume, Spline::Prefilter::automatic);
    std::vector<Coefficients<double>> along;
    for (int a = 0; a < 3; ++a) along.push_back(spline->coefficients(sample_differences(volume, a), Spline::Prefilter::automatic));
    const glm::dvec3 far(domain_max(volume.lattice, volume.extents));
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    double size = 0.0;
    for (int n = 0; n < 400; ++n) {
      // Farther from the border than the differences, the prefilter and the spline reach together.
      const glm::dvec3 u = 8.0 + (far - 16.0) * glm::dvec3(uniform(random), uniform(random), uniform(random));
      const glm::dvec3 found = central_difference(*spline, c, u, step);
      for (int a = 0; a < 3; ++a) EXPECT_NEAR(found[a], spline->evaluate(along[std::size_t(a)], u).value, 1e-13) << name;
      size = std::max(size, glm::length(found));
    }
    EXPECT_GT(size, 0.1);
  }
}

TEST_F(DeviceTest, HasTheReferencesNormalsOfSampleDifferences) {
  for (const char* name : {"bcc7", "tricubic"}) {
    const Volume volume = field_volume(make_spline(name)->lattice(), [](const glm::dvec3& u) { return std::sin(0.5 * u.x) * std::cos(0.4 * u.y) + 0.5 * std::sin(0.3 * u.z); });
    Renderer::Config config;
    config.spline = name;
    DeviceRenderer device(test_kernels(), volume, config);
    ReferenceRenderer reference(volume, config);
    Renderer::Request request = request_for(volume, 0.3, 48);
    request.scene.normal = Normal::samples;
    RenderStats stats;
    const Frame frame = device.render(request, stats), truth = reference.render(request, stats);
    const Difference d = compare(frame, truth, cell_length(volume.world));
    EXPECT_GT(d.hits, 500u);
    EXPECT_LT(d.normal_rms, 0.01) << name;
    // They are not the spline's own gradients, which are sharper.
    request.scene.normal = Normal::analytic;
    EXPECT_GT(compare(reference.render(request, stats), truth, cell_length(volume.world)).normal_rms, 0.3) << name;
    request.scene.normal = Normal::samples;
    bool told = false;
    for (const Feature& feature : device.explain(request)) told = told || (feature.name == kDifferencesPart && feature.compiled && feature.why == "--normal samples");
    EXPECT_TRUE(told);
  }
}

}  // namespace
}  // namespace quincunx
