// Bad transfer functions and flags of volumes: status 2, one line, nothing written.
#include <gtest/gtest.h>

#include "io/volume_file.h"
#include "program.h"

namespace quincunx::test {
namespace {

/// A folder with a BCC volume (bcc.nrrd), a Cartesian one (cartesian.nrrd) and a good transfer function (tf.json).
class VolumeFlags : public ProgramInFolder {
 protected:
  void SetUp() override {
    const auto ramp = [](const glm::dvec3& x) { return x.x + x.y; };
    write_volume(make_volume(LatticeKind::bcc, {4, 4, 4}, {}, ramp), bcc, Encoding::raw);
    write_volume(make_volume(LatticeKind::cartesian, {4, 4, 4}, {}, ramp), cartesian, Encoding::raw);
    write_file(function, R"({"colors": [[0, "#ff8040"], [8, 1, 1, 1]], "opacities": [[0, 0], [8, 0.5]]})");
  }

  /// `render` of the BCC volume to out.png with more arguments.
  Arguments render(const Arguments& more) const {
    Arguments arguments{"render", bcc, "-o", out, "--size", "8", "8", "--device", "cpu"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Arguments shown(const Arguments& more) const {
    Arguments arguments = render({"--tf", function});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  const std::string bcc = folder / "bcc.nrrd", cartesian = folder / "cartesian.nrrd", function = folder / "tf.json";
  const std::string out = folder / "out.png";
};

TEST_F(VolumeFlags, ShowAVolume) {
  const Outcome outcome = run(shown({"--classify", "pre-integrated", "--tf-entries", "64", "--shade", "off", "--jitter", "4294967295"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(read_file(out).size(), 100u);
}

TEST_F(VolumeFlags, NameATransferFunctionThatIsNotThereOrIsNone) {
  expect_refused(render({"--tf", folder / "none.json"}), {"none.json"});
  expect_refused(render({"--tf", folder / "."}), {"folder"});
  const std::string bad = folder / "bad.json";
  for (const std::string text : {"", "{", "[]", "[1, 2]", "{\"colors\": 3}", R"({"colors": [[0, "#ffffff"]]})",
                                 R"({"colors": [[0, "#ffffff"]], "opacities": [[0, 0], [0, 1]]})",
                                 R"({"colors": [[0, "#ffffff"]], "opacities": [[0, 0], [1, 1.5]]})",
                                 R"({"colors": [[0, "white"]], "opacities": [[0, 0], [1, 1]]})",
                                 R"({"colors": [[0, "#ffffff"]], "opacities": [[0, 0], [1, 1]], "units": 3})"}) {
    write_file(bad, text);
    expect_refused(render({"--tf", bad}), {"bad.json"});
  }
  const std::string whole = read_file(function);
  for (std::size_t size = 0; size + 1 < whole.size(); size += 7) {
    write_file(bad, whole.substr(0, size));
    expect_refused(render({"--tf", bad}), {"bad.json"});
  }
}

TEST_F(VolumeFlags, OutOfRangeAreNamedWithWhatWasFoundAndExpected) {
  expect_refused(shown({"--tf-entries", "1"}), {"--tf-entries", "1", "2"});
  expect_refused(shown({"--tf-entries", "70000"}), {"--tf-entries", "70000", "65536"});
  expect_refused(shown({"--tf-entries", "many"}), {"--tf-entries", "many"});
  expect_refused(shown({"--tf-entries", "4096", "--classify", "pre-integrated"}), {"--tf-entries", "4096", "2048"});
  expect_refused(shown({"--classify", "both"}), {"--classify", "'both'", "post, pre-integrated"});
  expect_refused(shown({"--shade", "maybe"}), {"--shade", "'maybe'", "on, off"});
  expect_refused(shown({"--adaptive", "0"}), {"--adaptive"});
  expect_refused(shown({"--adaptive", "2"}), {"--adaptive", "2"});
  expect_refused(shown({"--adaptive", "0.01", "--classify", "pre-integrated"}), {"--adaptive", "--classify post"});
  expect_refused(shown({"--modulate", "3,1"}), {"--modulate", "3,1", "larger"});
  expect_refused(shown({"--modulate", "1,1"}), {"--modulate", "1,1", "larger"});
  expect_refused(shown({"--modulate", "-1,1"}), {"--modulate", "-1,1"});
  expect_refused(shown({"--modulate", "1"}), {"--modulate", "two numbers"});
  expect_refused(shown({"--modulate", "1,nan"}), {"--modulate", "nan"});
  expect_refused(shown({"--termination", "0.6"}), {"--termination", "0.6", "0.5"});
  expect_refused(shown({"--jitter", "-1"}), {"--jitter", "-1"});
  expect_refused(shown({"--jitter", "4294967296"}), {"--jitter", "4294967295"});
  expect_refused(shown({"--step", "0"}), {"--step", "0.001"});
}

TEST_F(VolumeFlags, NeedATransferFunction) {
  for (const Arguments& flag : std::vector<Arguments>{{"--classify", "pre-integrated"},
                                                      {"--tf-entries", "64"},
                                                      {"--adaptive", "0.01"},
                                                      {"--shade", "off"},
                                                      {"--modulate", "0,1"},
                                                      {"--termination", "0.1"},
                                                      {"--jitter", "3"}}) {
    Arguments arguments = render({"--iso", "3"});
    arguments.insert(arguments.end(), flag.begin(), flag.end());
    expect_refused(arguments, {flag[0], "--tf"});
  }
  expect_refused(render({}), {"--iso", "--tf"});
}

TEST_F(VolumeFlags, NameASplineOfTheOtherLattice) {
  expect_refused(shown({"--spline", "tricubic"}), {"--spline", "cartesian"});
  expect_refused({"render", cartesian, "-o", out, "--tf", function, "--spline", "bcc7"}, {"--spline", "bcc"});
  expect_refused(shown({"--spline", "bcc5"}), {"bcc5", "bcc7, "});
}

}  // namespace
}  // namespace quincunx::test
