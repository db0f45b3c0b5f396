#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "io/volume_file.h"
#include "lattice/field.h"
#include "program.h"

namespace quincunx::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsSupersetOf;

/// A folder with a sphere of radius 0.8 in the cube [-1,1]^3, 10^3 samples a coset (sphere.nrrd, isovalue 0).
class Render : public testing::Test {
 protected:
  void SetUp() override { write_volume(sample_field(*make_field("sphere"), LatticeKind::bcc, {10, 10, 10}), volume); }

  /// `render` of the sphere with more arguments.
  Outcome render(const Arguments& more) const {
    Arguments arguments{"render", volume, "--iso", "0", "--size", "40", "30"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  Image picture(const Arguments& more) const {
    Arguments arguments{"-o", folder / "picture.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = render(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read_image(folder / "picture.exr");
  }

  const TemporaryFolder folder;
  const std::string volume = folder / "sphere.nrrd";
};

/// The channel `name` of pixel (x, y).
float at(const Image& image, const std::string& name, int x, int y) {
  const auto channel = std::find(image.channels.begin(), image.channels.end(), name);
  if (channel == image.channels.end()) throw std::runtime_error("no channel " + name);
  const std::size_t pixel = std::size_t(y) * std::size_t(image.width) + std::size_t(x);
  return image.pixels[pixel * image.channels.size() + std::size_t(channel - image.channels.begin())];
}

void expect_identical(const Image& a, const Image& b) {
  ASSERT_EQ(a.channels, b.channels);
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)), 0);
}

void expect_sphere(const Image& image) {
  ASSERT_EQ(image.width, 40);
  ASSERT_EQ(image.height, 30);
  ASSERT_THAT(image.channels, IsSupersetOf({"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z"}));
  // The eye is 5 from the centre in the middle of the picture, the sphere's nearest point 0.8 before the centre.
  EXPECT_NEAR(at(image, "Z", 20, 15), 4.2, 0.02);
  EXPECT_NEAR(at(image, "N.Y", 20, 15), -1.0, 0.02);
  EXPECT_EQ(at(image, "A", 20, 15), 1.0f);
  EXPECT_GT(at(image, "R", 20, 15), 0.3f);
  EXPECT_TRUE(std::isinf(at(image, "Z", 0, 0)));
  EXPECT_EQ(at(image, "A", 0, 0), 0.0f);
}

const Arguments from_the_front{"--eye", "0", "-5", "0", "--fov", "30"};

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST_F(Render, ShowsTheSphereOnTheCpu) { expect_sphere(picture(from_the_front + Arguments{"--device", "cpu"})); }

TEST_F(Render, ShowsTheSphereOnTheDevice) { expect_sphere(picture(from_the_front + Arguments{"--validate"})); }

TEST_F(Render, MakesTheSamePixelsWithAndWithoutSkipping) {
  const Image plain = picture({"--skip", "none"});
  expect_identical(plain, picture({"--skip", "grid", "--block", "4"}));
  expect_identical(plain, picture({"--skip", "grid", "--block", "16", "--cell-test", "off"}));
  EXPECT_TRUE(
      std::any_of(plain.pixels.begin(), plain.pixels.end(), [](float x) { return x > 0.0f && std::isfinite(x); }));
}

TEST_F(Render, WritesSeveralPicturesOfOneFrame) {
  const Outcome outcome =
      render({"-o", folder / "a.png", "-o", folder / "b.exr", "-o", folder / "c.png", "--device", "cpu"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.png", "b.exr", "c.png", "sphere.nrrd"}));
  EXPECT_EQ(read_file(folder / "a.png"), read_file(folder / "c.png"));
  EXPECT_EQ(read_image(folder / "a.png").width, 40);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("a.png"), HasSubstr("b.exr"), HasSubstr("rays hit")));
}

TEST_F(Render, IsSilentWhenAskedToBe) {
  const Outcome outcome = render({"-o", folder / "a.png", "--device", "cpu", "--quiet"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(Render, WritesTheStatisticsThatTheReadmeNames) {
  for (const std::string device : {"", "cpu"}) {
    Arguments more{"--stats", folder / "s.json", "--repeat", "3", "--skip", "grid"};
    if (!device.empty()) more = more + Arguments{"--device", device};
    const Outcome outcome = render(more);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json stats = json::parse(read_file(folder / "s.json"));
    for (const char* key :
         {"volume", "device", "size", "isovalues", "intersect", "normal", "structure", "cell_test", "trace_ms", "stages_ms",
          "rays", "hits", "evaluations", "steps", "intervals", "blocks", "active_blocks", "active_cells", "leaves", "nodes",
          "one_child", "depth", "device_bytes", "camera"}) {
      EXPECT_TRUE(stats.contains(key)) << key;
    }
    EXPECT_EQ(stats.contains("block"), device != "cpu");  // the reference walks no structure
    for (const char* key : {"median", "p5", "p95", "frames"})
      EXPECT_GE(stats["trace_ms"][key].get<double>(), 0.0) << key;
    for (const char* key : {"read", "prefilter", "bounds", "classify", "cluster", "build", "upload", "compile"}) {
      ASSERT_TRUE(stats["stages_ms"].contains(key)) << key;
      EXPECT_GE(stats["stages_ms"][key].get<double>(), 0.0) << key;
    }
    EXPECT_EQ(stats["rays"], 40 * 30);
    EXPECT_GT(stats["hits"].get<int>(), 100);
    EXPECT_LT(stats["hits"].get<int>(), 40 * 30);
    for (const char* key : {"evaluations", "steps", "intervals"}) EXPECT_GT(stats[key].get<int>(), 0) << key;
    EXPECT_LE(stats["trace_ms"]["p5"].get<double>(), stats["trace_ms"]["p95"].get<double>());
  }
}

TEST_F(Render, CountsTheHitsThatThePictureShows) {
  const Outcome outcome = render({"-o", folder / "a.exr", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Image image = read_image(folder / "a.exr");
  int hits = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) hits += std::isfinite(at(image, "Z", x, y)) ? 1 : 0;
  }
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["hits"], hits);
  EXPECT_EQ(summary["images"], json({folder / "a.exr"}));
}

TEST_F(Render, ReadsTheCameraThatTheStatisticsHold) {
  const Image orbit = picture(
      {"--azimuth", "50", "--elevation", "-20", "--zoom", "1.5", "--stats", folder / "s.json", "--device", "cpu"});
  write_file(folder / "camera.json", json::parse(read_file(folder / "s.json"))["camera"].dump());
  expect_identical(orbit, picture({"--camera", folder / "camera.json", "--device", "cpu"}));
  const Image other = picture({"--azimuth", "10", "--device", "cpu"});
  EXPECT_NE(std::memcmp(orbit.pixels.data(), other.pixels.data(), orbit.pixels.size() * sizeof(float)), 0);
}

TEST_F(Render, AddsTheCostChannelsOnlyWhenAsked) {
  const Image plain = picture({}), costly = picture({"--cost"});
  EXPECT_THAT(plain.channels, testing::Not(testing::Contains("cost.steps")));
  EXPECT_THAT(costly.channels, IsSupersetOf({"cost.evaluations", "cost.steps", "cost.intervals"}));
  EXPECT_GT(at(costly, "cost.evaluations", 20, 15), 0.0f);
}

TEST_F(Render, PutsTheColourAndTheBackgroundWhereTheyBelong) {
  const Image image = picture(
      from_the_front + Arguments{"--color", "0,1,0", "--ambient", "1", "--background", "0,0,0.5", "--device", "cpu"});
  EXPECT_NEAR(at(image, "G", 20, 15), 1.0, 1e-6);
  EXPECT_NEAR(at(image, "R", 20, 15), 0.0, 1e-6);
  EXPECT_NEAR(at(image, "B", 0, 0), 0.5, 1e-6);
}

TEST_F(Render, HidesWhatIsBehindAPngOnlyWhereABackgroundWasAskedFor) {
  const Arguments cpu{"-o", folder / "a.png", "--device", "cpu"};
  ASSERT_EQ(render(cpu).status, 0);
  EXPECT_EQ(at(read_image(folder / "a.png"), "A", 0, 0), 0.0f);
  ASSERT_EQ(render(cpu + Arguments{"--background", "#00ff00"}).status, 0);
  const Image opaque = read_image(folder / "a.png");
  EXPECT_EQ(opaque.channels.size(), 3u);
  EXPECT_EQ(at(opaque, "G", 0, 0), 1.0f);
}

TEST_F(Render, LetsTheInnerSurfaceShowThroughTheOuterOne) {
  const Outcome outcome = run({"render", volume, "--iso", "0,0.5", "--opacity", "0.25,1", "--ambient", "1", "--color",
                               "#ff0000,#0000ff", "--size", "40", "30", "-o", folder / "a.exr", "--device", "cpu"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Image image = read_image(folder / "a.exr");
  EXPECT_NEAR(at(image, "R", 20, 15), 0.25, 1e-5);
  EXPECT_NEAR(at(image, "B", 20, 15), 0.75, 1e-5);
}

TEST_F(Render, ExplainsTheKernelWithoutAPicture) {
  const Outcome text = render({"--explain"});
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, testing::AllOf(HasSubstr("in  "), HasSubstr("out ")));
  const json lean = json::parse(render({"--explain", "--json", "--skip", "none"}).out)["explain"];
  const json full =
      json::parse(render({"--explain", "--json", "--skip", "grid", "--normal", "central"}).out)["explain"];
  ASSERT_EQ(lean.size(), full.size());
  const auto compiled = [](const json& features) {
    return std::count_if(features.begin(), features.end(), [](const json& f) { return f["compiled"].get<bool>(); });
  };
  EXPECT_LT(compiled(lean), compiled(full));
}

TEST_F(Render, StoresCoefficientsInFewerBitsWhereItIsAskedTo) {
  const Image whole = picture({});
  std::uint64_t of_floats = 0;
  for (const auto& [storage, bytes] : {std::pair{"float32", 4}, {"float16", 2}, {"unorm16", 2}, {"unorm8", 1}}) {
    const Outcome outcome = render({"--storage", storage, "--json", "-o", folder / "small.exr"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json told = json::parse(outcome.out);
    EXPECT_EQ(told["storage"], storage);
    const std::uint64_t found = told["device_bytes"]["coefficients"];
    of_floats = bytes == 4 ? found : of_floats;
    EXPECT_EQ(4 * found, std::uint64_t(bytes) * of_floats);
    const Image small = read_image(folder / "small.exr");
    EXPECT_EQ(small.pixels == whole.pixels, bytes == 4) << storage;
    const Outcome reference = render({"--storage", storage, "--json", "--device", "cpu", "-o", folder / "reference.exr"});
    EXPECT_EQ(json::parse(reference.out)["storage"], bytes == 4 ? "float64" : storage);
    const Image truth = read_image(folder / "reference.exr");
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x) {
        if (!std::isfinite(at(small, "Z", x, y)) || !std::isfinite(at(truth, "Z", x, y))) continue;
        ASSERT_NEAR(at(small, "N.X", x, y), at(truth, "N.X", x, y), 1e-4) << storage;
      }
  }
}

TEST_F(Render, TellsWhenNothingWasHit) {
  const Outcome outcome =
      run({"render", volume, "--iso", "7", "--size", "8", "8", "-o", folder / "a.png", "--device", "cpu"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("nothing was hit"), HasSubstr("-2.36 to 0.63")));
}

TEST_F(Render, LeavesOutOrFillsWhatIsNotFinite) {
  // The sphere without a half of its samples, those of x > 0.25: its other half is as it was.
  Volume holed = sample_field(*make_field("sphere"), LatticeKind::bcc, {10, 10, 10}), filled = holed;
  auto& samples = std::get<std::vector<float>>(holed.samples);
  for (std::size_t n = 0; n < samples.size(); ++n)
    if (n % 10 > 6) samples[n] = n % 2 ? std::nanf("") : -INFINITY, std::get<std::vector<float>>(filled.samples)[n] = 1.0f;
  write_volume(filled, volume);
  const Image expected = picture({"--azimuth", "0"});
  write_volume(holed, volume);
  EXPECT_EQ(render({"-o", folder / "refused.png"}).status, 2);
  expect_identical(picture({"--azimuth", "0", "--nan", "fill=1"}), expected);

  const Outcome outcome = render({"--nan", "empty", "--azimuth", "0", "--json", "-o", folder / "empty.exr"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(json::parse(outcome.out)["void_cells"], 0);
  EXPECT_GT(json::parse(outcome.out)["device_bytes"]["void cells"], 0);
  const Image empty = read_image(folder / "empty.exr"), reference = picture({"--azimuth", "0", "--nan", "empty", "--device", "cpu"});
  int seen = 0;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      seen += std::isfinite(at(empty, "Z", x, y));
      EXPECT_EQ(std::isfinite(at(empty, "Z", x, y)), std::isfinite(at(reference, "Z", x, y))) << x << ' ' << y;
    }
  EXPECT_GT(seen, 100);
  EXPECT_FALSE(std::isfinite(at(empty, "Z", 27, 15))) << "nothing where samples are missing";
  EXPECT_TRUE(std::isfinite(at(empty, "Z", 14, 15)));
}

}  // namespace
}  // namespace quincunx::test
