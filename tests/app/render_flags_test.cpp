#include "app/render_flags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/volume_file.h"
#include "program.h"

namespace quincunx::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// What is wrong with an otherwise good command line; "" where nothing is.
std::string refusal_with(Arguments more) {
  more.insert(more.begin(), {"volume.nrrd", "--iso", "1,2,3", "--json"});
  return render_refusal(std::move(more));
}

TEST(RenderFlags, AreAllTakenTogether) {
  EXPECT_EQ(
      refusal_with({"--color",     "1,0,0",          "--color", "#00ff00",  "--color",  "0,0,1",       "--opacity",
                    "0.5,0.25,1",  "--skip",         "grid",    "--block",  "8",        "--cell-test", "off",
                    "--intersect", "march",          "--step",  "0.5",      "--normal", "central",     "--delta",
                    "0.25",        "--prefilter=none", "--size",  "64",       "32",       "--azimuth",   "-30",
                    "--elevation", "-10.5",          "--zoom",  "2",        "--device", "cpu",         "--ambient",
                    "0.5",         "--background",   "#ffffff", "--repeat", "5",        "--cost",      "--validate",
                    "--explain",   "--quiet"}),
      "");
  EXPECT_EQ(
      refusal_with({"--eye", "-1", "-2", "-3", "--target", "0", "0", "-1", "--up", "0", "-1", "0", "--fov", "20"}), "");
  EXPECT_EQ(refusal_with({"--color", "#ff0000,#00ff00,#0000ff"}), "");
  EXPECT_EQ(render_refusal({"volume.nrrd", "--iso", "-700", "--explain"}), "");
}

TEST(RenderFlags, WithBadNumbersAreNamed) {
  for (const std::string flag :
       {"--opacity", "--azimuth", "--elevation", "--zoom", "--step", "--delta", "--ambient", "--iso"}) {
    for (const std::string bad : {"nan", "inf", "abc", "1,", ""}) {
      const bool eaten_by_parser = bad.empty();  // an empty word may count as no word
      EXPECT_THAT(refusal_with({flag, bad}), AllOf(HasSubstr(flag), HasSubstr(eaten_by_parser ? "" : "found"))) << bad;
    }
  }
}

TEST(RenderFlags, OutOfRangeAreNamedWithWhatWasFoundAndExpected) {
  const std::vector<std::vector<std::string>> cases{{"--step", "0", "number"},
                                                    {"--delta", "-1", "number"},
                                                    {"--zoom", "0", "above 0"},
                                                    {"--ambient", "2", "at most 1"},
                                                    {"--elevation", "91", "at most 90"},
                                                    {"--color", "red", "#rrggbb"},
                                                    {"--background", "#12345", "#rrggbb"},
                                                    {"--skip", "quadtree", "auto, none, grid"},
                                                    {"--block", "12", "power of two"},
                                                    {"--block", "512", "256"},
                                                    {"--cell-test", "maybe", "on, off"},
                                                    {"--intersect", "guess", "exact, march"},
                                                    {"--normal", "flat", "analytic, central"},
                                                    {"--repeat", "0", "from 1"}};
  for (const auto& c : cases) {
    EXPECT_THAT(refusal_with({c[0], c[1]}), AllOf(HasSubstr(c[0]), HasSubstr(c[1]), HasSubstr(c[2])));
  }
  for (const char* bad : {"0", "-1", "1.5", "many", "20000"}) {
    EXPECT_THAT(refusal_with({"--size", "8", bad}), AllOf(HasSubstr("--size"), HasSubstr(bad)));
  }
}

TEST(RenderFlags, OfCentralDifferencesDoNotGoWithSampleDifferences) {
  EXPECT_EQ(refusal_with({"--normal", "samples"}), "");
  EXPECT_THAT(refusal_with({"--normal", "samples", "--delta", "0.5"}), AllOf(HasSubstr("--delta: found"), HasSubstr("--normal samples"), HasSubstr("--normal central")));
}

TEST(RenderFlags, MarchSplinesOfNoPolynomialsUnlessTheReferenceRendersThem) {
  const TemporaryFolder folder;
  write_volume(make_volume(LatticeKind::bcc, {4, 4, 4}, {}, [](const glm::dvec3& x) { return x.x + x.y; }), folder / "v.nrrd");
  const Arguments render{"render", folder / "v.nrrd", "--iso", "5", "--size", "8", "8", "--spline", "cwlb", "--json"};
  const auto with = [&](const Arguments& more) {
    Arguments all = render;
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  };
  Outcome outcome = with({});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("note: pieces of cwlb"), HasSubstr("--intersect march")));
  EXPECT_THAT(outcome.out, HasSubstr("\"intersect\": \"march\""));
  outcome = with({"--explain"});
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("pieces of cwlb are no polynomials"), HasSubstr("fixed-step march")));
  outcome = with({"--device", "cpu"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, testing::Not(HasSubstr("note: pieces")));
  EXPECT_THAT(outcome.out, HasSubstr("\"intersect\": \"exact\""));
  Arguments exact = render;
  exact.insert(exact.end(), {"--intersect", "exact"});
  expect_refused(exact, {"--intersect: found exact", "expected march", "cwlb"});
}

TEST(RenderFlags, OfUnequalCountAreRefused) {
  EXPECT_THAT(refusal_with({"--color", "1,0,0", "--color", "#00ff00"}),
              AllOf(HasSubstr("--color: found 2"), HasSubstr("3")));
  EXPECT_THAT(refusal_with({"--opacity", "0.5,1"}), AllOf(HasSubstr("--opacity: found 2"), HasSubstr("3")));
}

TEST(RenderFlags, GiveOneCameraAtMost) {
  EXPECT_THAT(refusal_with({"--camera", "c.json", "--azimuth", "10"}),
              AllOf(HasSubstr("--camera"), HasSubstr("--azimuth")));
  EXPECT_THAT(refusal_with({"--zoom", "2", "--eye", "1", "2", "3"}), AllOf(HasSubstr("--zoom"), HasSubstr("--eye")));
  EXPECT_THAT(refusal_with({"--camera", "c.json", "--fov", "20"}), AllOf(HasSubstr("--camera"), HasSubstr("--fov")));
  EXPECT_THAT(refusal_with({"--target", "1", "2", "3"}), AllOf(HasSubstr("--target"), HasSubstr("--eye")));
  EXPECT_THAT(refusal_with({"--eye", "1", "2"}), HasSubstr("--eye"));
}

TEST(RenderFlags, NameFilesThatCanBeWritten) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal_with({"-o", folder / "a.png", "-o", folder / "a.exr", "--stats", folder / "s.json"}), "");
  EXPECT_THAT(refusal_with({"-o", folder / "a.gif"}), HasSubstr("a.gif"));
  EXPECT_THAT(refusal_with({"-o", folder / "a.png", "-o", folder / "a.png"}), HasSubstr("twice"));
  EXPECT_THAT(refusal_with({"-o", folder / "a.png", "--stats", folder / "a.png"}), HasSubstr("--stats"));
  EXPECT_THAT(refusal_with({"--stats", folder / "none/s.json"}), HasSubstr("none/s.json"));
  EXPECT_TRUE(folder.names().empty());
}

TEST(RenderFlags, TakeSmallCoefficientsOfKernelsInFloatsAlone) {
  for (const char* storage : {"float32", "float16", "unorm16", "unorm8"}) EXPECT_EQ(refusal_with({"--storage", storage, "--explain"}), "");
  EXPECT_EQ(refusal_with({"--storage", "float32", "--precision", "double", "--explain"}), "");
  EXPECT_THAT(refusal_with({"--storage", "unorm8", "--precision", "double", "--explain"}),
              AllOf(HasSubstr("--storage: found unorm8"), HasSubstr("--precision double"), HasSubstr("float32")));
  EXPECT_THAT(refusal_with({"--storage", "half", "--explain"}), AllOf(HasSubstr("--storage"), HasSubstr("half"), HasSubstr("float32, float16, unorm16, unorm8")));
}

TEST(RenderFlags, NeedAnIsovalueAndSomethingToMake) {
  EXPECT_THAT(render_refusal({"volume.nrrd", "--json"}), AllOf(HasSubstr("--iso"), HasSubstr("quincunx info")));
  EXPECT_THAT(render_refusal({"volume.nrrd", "--iso", "1"}), HasSubstr("-o"));
}

}  // namespace
}  // namespace quincunx::test
