// Voxels in place of splines: `render --render bih` and `render --particles`, through the whole program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "io/volume_file.h"
#include "program.h"

namespace quincunx::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// A folder with a Cartesian volume of 10 x 9 x 8 samples, of which those of x >= 5 are 1 and the others 0 (v.nrrd), and a transfer function (tf.json).
class VoxelsOf : public ProgramInFolder {
 protected:
  void SetUp() override {
    write_volume(make_volume(LatticeKind::cartesian, {10, 9, 8}, {}, [](const glm::dvec3& x) { return x.x >= 5.0 ? 1.0 : 0.0; }), volume, Encoding::raw);
    write_file(tf, R"({"colors": [[0, "#3060c0"], [1, "#f0a030"]], "opacities": [[0.2, 0], [1, 0.3]]})");
  }
  Arguments render(const Arguments& more) const {
    Arguments arguments{"render", volume, "--render", "bih", "--tf", tf, "-o", out, "--size", "16", "16", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Arguments particles(const std::string& text, const Arguments& more) const {
    write_file(folder / "p.csv", text);
    Arguments arguments{"render", "--particles", folder / "p.csv", "--tf", tf, "-o", out, "--size", "16", "16", "--quiet", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  json told(Arguments arguments) const {
    if (std::find(arguments.begin(), arguments.end(), "--json") == arguments.end()) arguments.push_back("--json");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.status == 0 ? json::parse(outcome.out) : json();
  }

  const std::string volume = folder / "v.nrrd", tf = folder / "tf.json", out = folder / "out.exr";
};

TEST_F(VoxelsOf, AVolumeAreTheSamplesThatTheTransferFunctionShows) {
  const json stats = told(render({}));
  EXPECT_EQ(stats["render"], "bih");
  EXPECT_EQ(stats["shape"], "cuboid");
  EXPECT_EQ(stats["voxels"], 5 * 9 * 8);
  EXPECT_EQ(stats["samples"], 10 * 9 * 8);
  EXPECT_EQ(stats["bytes"]["data"], 8 * 360);
  EXPECT_EQ(stats["bytes"]["grid"], 4 * 720);
  EXPECT_EQ(stats["bytes"]["nodes"], 8 * int(stats["nodes"]));
  EXPECT_GT(stats["hits"], 20);
  EXPECT_GT(stats["intervals"], 0);
  EXPECT_EQ(told(render({"--bih-min", "0"}))["voxels"], 720);
  const json stored = told(render({"--bih-leaf", "8"}));
  EXPECT_LT(stored["nodes"], int(stats["nodes"]) / 3);
  EXPECT_EQ(stored["hits"], stats["hits"]);
  // x = 5..9 by y = 0..8 by z = 0..7: from x = 6 and below y = 8 cubes of 2^3 and more, the others by themselves.
  EXPECT_LT(told(render({"--bih-lod", "0"}))["voxels"], 360);
}

TEST_F(VoxelsOf, AVolumeOnTheDeviceLookLikeThoseOfTheReference) {
  told(render({}));
  const Image device = read_image(out);
  const json stats = told(render({"--device", "cpu"}));
  EXPECT_EQ(stats["nodes"], 0);
  const Image reference = read_image(out);
  ASSERT_EQ(device.pixels.size(), reference.pixels.size());
  std::size_t far = 0;
  for (std::size_t n = 0; n < device.pixels.size(); ++n)
    if (std::isfinite(reference.pixels[n])) far += std::abs(device.pixels[n] - reference.pixels[n]) > 1e-4;
  EXPECT_LE(far, device.pixels.size() / 100);
}

TEST_F(VoxelsOf, AFinerGridHideAsMuch) {
  const json coarse = told(render({}));
  const Image before = read_image(out);
  const json fine = told(render({"--supersample", "2", "--spline", "trilinear"}));
  EXPECT_EQ(fine["samples"], 19 * 17 * 15);
  const Image after = read_image(out);
  double largest = 0.0;
  for (std::size_t p = 0; p < before.pixels.size(); p += before.channels.size()) largest = std::max(largest, std::abs(double(before.pixels[p + 3]) - after.pixels[p + 3]));
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(largest, 0.15);
}

TEST_F(VoxelsOf, ParticlesAreSpheres) {
  const json stats = told(particles("0,0,0\n3,0,0\n0,4,0\n", {"--radius", "0.5", "--cost"}));
  EXPECT_EQ(stats["shape"], "sphere");
  EXPECT_EQ(stats["voxels"], 3);
  EXPECT_EQ(stats["bytes"]["places"], 3 * 16);
  EXPECT_GT(stats["hits"], 0);
  EXPECT_LT(stats["hits"], 100);
  EXPECT_EQ(told(particles("x,y,z,density,radius\n0,0,0,1,0.5\n3,0,0,0.5,1\n", {"--device", "cpu", "--explain"}))["voxels"], 2);
}

TEST_F(VoxelsOf, AreExplainedAndDrawnAsHeat) {
  const Outcome outcome = run(render({"--explain", "--heat", "evaluations", "-o", folder / "heat.png"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("in   bounding interval hierarchy"), HasSubstr("out  spheres")));
  expect_refused(render({"--heat", "depth", "-o", folder / "heat.png"}), {"--heat: found depth", "expected evaluations"});
}

TEST(VoxelFlags, RefuseWhatMeansNothingWithThem) {
  const auto refusal = [](const Arguments& more) {
    Arguments arguments{"v.nrrd", "--render", "bih", "--tf", "tf.json", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return render_refusal(arguments);
  };
  for (const Arguments& more : std::vector<Arguments>{{"--iso", "0.5"}, {"--skip", "grid"}, {"--pool", "1M"}, {"--spline", "tricubic"}, {"--storage", "unorm8"}, {"--step", "0.5"},
                                                      {"--classify", "post"}, {"--adaptive", "0.1"}, {"--jitter", "1"}, {"--precision", "double"}, {"--normal", "central"},
                                                      {"--intersect", "march"}, {"--stub-sampling"}, {"--tf-entries", "64"}, {"--block", "4"}, {"--opacity", "1"}})
    EXPECT_THAT(refusal(more), AllOf(HasSubstr(more.front() + ": found with --render bih"), HasSubstr("expected --render spline")));
  EXPECT_EQ(refusal({"--azimuth", "10", "--shade", "off", "--modulate", "0,1", "--termination", "0", "--ambient", "0.5", "--background", "1,1,1", "--size", "8", "8"}), "");
  EXPECT_EQ(refusal({"--supersample", "1.5", "--spline", "tricubic", "--prefilter", "none", "--bih-min", "-3", "--bih-lod", "2.5", "--bih-leaf", "4", "--nan", "empty"}), "");
  EXPECT_THAT(refusal({"--bih-lod", "-1"}), AllOf(HasSubstr("--bih-lod: found -1"), HasSubstr("at least 0")));
  EXPECT_THAT(refusal({"--bih-leaf", "0"}), HasSubstr("--bih-leaf"));
  EXPECT_THAT(refusal({"--supersample", "0.5"}), AllOf(HasSubstr("--supersample"), HasSubstr("0.5")));
  EXPECT_THAT(refusal({"--radius", "1"}), HasSubstr("--radius: found without --particles"));
}

TEST(VoxelFlags, NeedATransferFunctionAndSomethingToShow) {
  EXPECT_THAT(render_refusal({"v.nrrd", "--render", "bih", "--json"}), HasSubstr("--tf: found --render bih without it"));
  EXPECT_THAT(render_refusal({"--tf", "tf.json", "--json"}), AllOf(HasSubstr("VOLUME: found none"), HasSubstr("--particles")));
  EXPECT_THAT(render_refusal({"v.nrrd", "--tf", "tf.json", "--json", "--bih-lod", "1"}), HasSubstr("--bih-lod: found without --render bih"));
  EXPECT_THAT(render_refusal({"v.nrrd", "--tf", "tf.json", "--json", "--render", "octree"}), AllOf(HasSubstr("--render"), HasSubstr("spline, bih")));
  EXPECT_EQ(render_refusal({"--particles", "p.csv", "--radius", "1", "--tf", "tf.json", "--json"}), "");
  EXPECT_THAT(render_refusal({"--particles", "p.csv", "--tf", "tf.json", "--json", "--render", "spline"}), HasSubstr("--render: found spline with --particles"));
  EXPECT_THAT(render_refusal({"--particles", "p.csv", "--tf", "tf.json", "--json", "--bih-lod", "1"}), HasSubstr("--bih-lod: found with --particles"));
  EXPECT_THAT(render_refusal({"v.nrrd", "--particles", "p.csv", "--tf", "tf.json", "--json"}), HasSubstr("--particles: found with the volume v.nrrd"));
  EXPECT_THAT(render_refusal({"--particles", "p.csv", "--radius", "0", "--tf", "tf.json", "--json"}), AllOf(HasSubstr("--radius: found 0"), HasSubstr("above 0")));
}

TEST_F(VoxelsOf, RefuseParticlesThatAreNone) {
  const auto refused = [&](const std::string& text, const Arguments& more, const std::vector<std::string>& parts) {
    write_file(folder / "p.csv", text);
    expect_refused(particles(text, more), parts);
  };
  refused("0,0,0\n", {}, {"p.csv: found no column radius", "--radius R"});
  refused("x,y,z,radius\n0,0,0,1\n", {"--radius", "1"}, {"--radius: found with", "column radius"});
  refused("x,y,z,radius\n0,0,0\n", {}, {"p.csv:2: found '0,0,0'", "four numbers x,y,z,radius"});
  refused("x,y,z,mass\n0,0,0,1\n", {}, {"p.csv:1: found 'x,y,z,mass'"});
  refused("x,y,z\n", {"--radius", "1"}, {"p.csv: found no particle"});
}

TEST_F(VoxelsOf, LeaveOutOrFillSamplesThatAreNotFinite) {
  const std::string holed = folder / "holed.nrrd";
  write_volume(make_volume(LatticeKind::cartesian, {4, 4, 4}, {}, [](const glm::dvec3& x) { return x == glm::dvec3(1.0) ? NAN : 1.0; }), holed, Encoding::raw);
  const auto rendered = [&](const Arguments& more) {
    Arguments arguments{"render", holed, "--render", "bih", "--tf", tf, "-o", out, "--size", "8", "8", "--quiet", "--device", "cpu"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  EXPECT_EQ(told(rendered({"--nan", "empty"}))["voxels"], 63);
  EXPECT_EQ(told(rendered({"--nan", "fill=1"}))["voxels"], 64);
  expect_refused(rendered({}), {"holed.nrrd", "NaN"});
  expect_refused(rendered({"--nan", "empty", "--supersample", "2"}), {"--nan: found empty with --supersample"});
}

}  // namespace
}  // namespace quincunx::test
