// quincunx compare: its settings, its report and page, and the command as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/compare_page.h"
#include "bench/compare_plot.h"
#include "bench/compare_presets.h"
#include "bench/compare_report.h"
#include "bench/html.h"
#include "io/volume_file.h"
#include "lattice/error.h"
#include "tests/app/program.h"

namespace quincunx {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

CompareSubject small_subject() { return field_subject(make_field("sphere"), 16, {Density::equal}); }

std::vector<std::string> labels(const CompareSubject& subject, const CompareChoices& choices) {
  std::vector<std::string> all;
  for (const CompareSetting& s : compare_settings(subject, choices)) all.push_back(s.label(subject));
  return all;
}

TEST(CompareSubject, HasAsManyOrFewerBccSamplesOnTheSameCube) {
  const CompareSubject subject = field_subject(make_field("marschner-lobb"), 81, {Density::equal, Density::sparse});
  ASSERT_EQ(subject.volumes.size(), 3u);
  const auto count = [&](std::size_t n) {
    const Volume& v = subject.volumes[n].volume;
    return double(coset_count(v.lattice)) * double(v.extents.x * v.extents.y * v.extents.z);
  };
  EXPECT_EQ(count(0), 81.0 * 81.0 * 81.0);
  EXPECT_NEAR(count(1) / count(0), 1.0, 0.02);                   // cubes hold whole numbers of samples
  EXPECT_NEAR(count(2) / count(0), std::sqrt(0.5), 0.02);
  for (const CompareVolume& v : subject.volumes) {
    const glm::dvec3 low = v.volume.world.to_world(glm::dvec3(0.0)), high = v.volume.world.to_world(glm::dvec3(domain_max(v.volume.lattice, v.volume.extents)));
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(low[a], -1.0, 1e-12);
      EXPECT_NEAR(high[a], 1.0, 1e-12);
    }
  }
  // The density that a spacing stands for: one sample in a Cartesian cell, one in four cells of BCC.
  EXPECT_NEAR(4.0 * std::pow(bcc_step(Density::equal), 3), 1.0, 1e-12);
  EXPECT_NEAR(4.0 * std::pow(bcc_step(Density::sparse), 3), std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(subject.inside(glm::dvec3(0.0)));
  EXPECT_FALSE(subject.inside(glm::dvec3(0.0, 0.0, 0.9)));  // five steps of 0.025
}

TEST(CompareSubject, TakesACartesianVolumeAsTheTruthOfCoarserOnesOfEqualDensity) {
  // So smooth that nothing is lost to the low-pass, and little to the coarser lattices.
  const auto f = [](const glm::dvec3& x) { return std::sin(0.2 * x.x) * std::cos(0.15 * x.y) + 0.01 * x.z; };
  const World world{.origin = {1.0, 2.0, 3.0}, .axes = glm::dmat3(1.0)};
  const Volume volume = test::make_volume(LatticeKind::cartesian, {65, 49, 41}, world, f);
  const CompareSubject subject = reduced_subject("smooth", volume, 0.2, 2.0, {Density::equal, Density::sparse});
  ASSERT_EQ(subject.volumes.size(), 3u);
  EXPECT_EQ(subject.volumes[0].volume.extents, Extents(33, 25, 21));
  EXPECT_DOUBLE_EQ(subject.cell, 2.0);
  const auto count = [&](std::size_t n) {
    const Volume& v = subject.volumes[n].volume;
    return double(coset_count(v.lattice)) * double(v.extents.x * v.extents.y * v.extents.z);
  };
  EXPECT_NEAR(count(1) / count(0), 1.0, 0.1);
  EXPECT_NEAR(count(2) / count(0), std::sqrt(0.5), 0.1);
  const glm::dvec3 x(30.3, 25.7, 20.1);
  EXPECT_NEAR(subject.truth->at(x).value, f(x), 1e-4);
  for (const char* name : {"tricubic", "bcc7"}) {
    const auto spline = make_spline(name);
    CompareSetting setting;
    setting.volume = spline->lattice() == LatticeKind::cartesian ? 0 : 1;
    const VolumeErrors e = volume_errors(subject, setting, *spline, spline->coefficients(subject.volumes[setting.volume].volume, Spline::Prefilter::automatic), 1000, 1);
    EXPECT_LT(e.value_max, 2e-3) << name;
    EXPECT_GT(e.value_max, 1e-7) << name;
  }
  EXPECT_THROW(reduced_subject("coarse", volume, 0.2, 4.0, {Density::equal}), InputError);
}

TEST(CompareSettings, CombineWhatEachSplineHasOnTheVolumesOfItsLattice) {
  const CompareSubject subject = small_subject();
  CompareChoices choices;
  choices.splines = {"bcc7", "trilinear"};
  choices.steps = {0.5};
  choices.prefilters = {Spline::Prefilter::automatic, Spline::Prefilter::none, Spline::Prefilter::fir};
  EXPECT_THAT(labels(subject, choices),
              ElementsAre("trilinear, exact", "trilinear, march 0.5", "bcc7 fir, exact", "bcc7 fir, march 0.5", "bcc7, exact", "bcc7, march 0.5"));
  choices.splines = {"trilinear"};
  choices.intersects = {Intersect::exact};
  choices.prefilters = {Spline::Prefilter::none};
  choices.normals = {NormalChoice{}, {Normal::central, 0.25}};
  choices.skips = {SkipConfig{}, SkipConfig{.structure = "none"}};
  EXPECT_THAT(labels(subject, choices),
              ElementsAre("trilinear, exact", "trilinear, exact, none", "trilinear, exact, central 0.25", "trilinear, exact, central 0.25, none"));
  choices.prefilters = {Spline::Prefilter::none};
  choices.normals = {NormalChoice{}};
  choices.skips = {SkipConfig{}};
  choices.storages = {Storage::float32, Storage::unorm8};
  EXPECT_THAT(labels(subject, choices), ElementsAre("trilinear, exact", "trilinear, unorm8, exact"));
  // Pieces of cwlb are no polynomials.
  choices.splines = {"cwlb"};
  choices.storages = {Storage::float32};
  choices.intersects = {Intersect::exact, Intersect::march};
  EXPECT_THAT(labels(subject, choices), ElementsAre("cwlb, march 0.5"));
  choices.prefilters = {Spline::Prefilter::iir};
  EXPECT_THROW(compare_settings(subject, choices), InputError);
}

TEST(ComparePresets, HoldWhereFlagsDoNotSay) {
  for (const std::string& name : compare_preset_names()) EXPECT_FALSE(compare_preset(name).field.empty());
  CompareWishes wishes;
  wishes.steps = {1.0};
  wishes.samples = 20;
  const ComparePreset preset = with_wishes(compare_preset("table3"), wishes);
  EXPECT_EQ(preset.samples, 20);
  EXPECT_THAT(preset.choices.steps, ElementsAre(1.0));
  EXPECT_GT(preset.choices.normals.size(), 3u);
}

/// Three lines of which the second one is slower and worse than the first.
CompareReport made_up(const CompareSubject& subject) {
  CompareReport report{.command = "quincunx compare \"<&>\" </script>", .machine = {"a device", "a driver", "a processor", 2}, .subject = &subject, .plan = {}, .measured = {}, .metric = &compare_metric("image")};
  const double ms[] = {5.0, 6.0, 9.0}, rmse[] = {0.2, 0.3, 0.0};
  for (int n = 0; n < 3; ++n) {
    CompareLine line;
    line.setting.spline = "trilinear";
    line.setting.step = n;
    line.setting.intersect = n == 0 ? Intersect::exact : Intersect::march;
    line.frame_ms = {ms[n], ms[n], ms[n]};
    line.truth.emplace(), line.volume.emplace();
    line.image_rmse = rmse[n];
    line.picture = Frame{16, 12, std::vector<float>(16 * 12 * 4, 0.5f), std::vector<float>(16 * 12), std::vector<float>(16 * 12 * 3), {}};
    report.measured.references.push_back(line.picture);
    report.measured.lines.push_back(line);
  }
  report.measured.truth = report.measured.references.front();
  return report;
}

TEST(ParetoFront, HoldsWhatNothingElseBeatsInBoth) {
  const CompareSubject subject = small_subject();
  CompareReport report = made_up(subject);
  EXPECT_THAT(pareto_front(report.measured.lines, *report.metric), ElementsAre(0u, 2u));
  report.measured.lines[1].image_rmse = 0.1;
  EXPECT_THAT(pareto_front(report.measured.lines, *report.metric), ElementsAre(0u, 1u, 2u));
  report.measured.lines[1].frame_ms = {1.0};
  EXPECT_THAT(pareto_front(report.measured.lines, *report.metric), ElementsAre(1u, 2u));
  EXPECT_THROW(compare_metric("beauty"), InputError);
}

TEST(CompareReport, HasAsManyFieldsInEachLineOfTheCsvAndTheSameNumbersInTheJson) {
  const CompareSubject subject = small_subject();
  CompareReport report = made_up(subject);
  report.measured.lines[2].truth.reset(), report.measured.lines[2].volume.reset();  // not known
  const std::vector<std::string> csv = test::lines(compare_csv(report));
  ASSERT_EQ(csv.size(), 4u);
  for (const std::string& line : csv) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 38) << line;
  report = made_up(subject);
  const Json json = Json::parse(compare_json(report).dump());
  EXPECT_EQ(json["settings"][1]["errors"]["image"], 0.3);
  EXPECT_EQ(json["front"]["image"], Json({0, 2}));
  EXPECT_THAT(compare_markdown(report), AllOf(HasSubstr("| march 1 "), HasSubstr("a device, a driver, on 2 cores of a processor")));
}

TEST(ComparePage, HoldsAllThatItNeedsAndNothingThatEndsItsScripts) {
  const CompareSubject subject = small_subject();
  const std::string page = compare_html(made_up(subject));
  EXPECT_THAT(page, HasSubstr("quincunx compare &quot;&lt;&amp;&gt;&quot; &lt;/script&gt;"));
  EXPECT_THAT(page, HasSubstr("Permission is hereby granted"));
  for (const char* outside : {"<link", "src=\"http", "url(", "@import", "sourceMappingURL"}) EXPECT_THAT(page, Not(HasSubstr(outside)));
  // Three scripts, each ended once.
  std::size_t ends = 0;
  for (std::size_t at = page.find("</script>"); at != std::string::npos; at = page.find("</script>", at + 1)) ++ends;
  EXPECT_EQ(ends, 3u);
}

TEST(ComparePlot, PutsErrorsOfNothingOnTheLowerEdgeAndDrawsTheFront) {
  const CompareSubject subject = small_subject();
  const std::string script = compare_plot_script(made_up(subject));
  EXPECT_THAT(script, HasSubstr("$front << EOD\n5 0.2\n9 0.066"));
  EXPECT_THAT(script, HasSubstr("title 'trilinear, march 1'"));
}

TEST(Html, SpellsBytesInBase64) {  // RFC 4648, section 10
  const char* const text[] = {"", "f", "fo", "foo", "foob", "fooba", "foobar"};
  const char* const spelt[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (int n = 0; n < 7; ++n) EXPECT_EQ(base64(text[n]), spelt[n]);
}

class CompareProgram : public test::ProgramInFolder {
 protected:
  test::Arguments compare(const test::Arguments& more) const {
    test::Arguments arguments{"compare", "gyroid", "--samples", "20", "--size", "32", "32", "--rounds", "2", "--points", "500", "-o", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  const std::string out = folder / "out";
};

TEST_F(CompareProgram, TellsErrorsOfIntersectionFromThoseOfReconstruction) {
  const test::Outcome run = test::run(compare({"--splines", "bcc7,trilinear,tricubic", "--steps", "0.9", "--json"}));
  ASSERT_EQ(run.status, 0) << run.err;
  const Json json = Json::parse(run.out);
  ASSERT_EQ(json["settings"].size(), 6u);
  std::map<std::string, Json> by_label;
  for (const Json& s : json["settings"]) by_label[s["label"]] = s;
  for (const char* exact : {"bcc7 fir, exact", "trilinear, exact", "tricubic fir, exact"}) {
    const Json& s = by_label.at(exact);
    EXPECT_EQ(s["reference"]["missed"].get<int>() + s["reference"]["false_hits"].get<int>() + s["reference"]["wrong_sheet"].get<int>(), 0) << exact;
    EXPECT_LT(s["reference"]["depth_max_cells"], 1e-3) << exact;
    EXPECT_EQ(s["frame_ms"].size(), 2u);
    EXPECT_GT(s["frame_ms"][0], 0.0);
  }
  // The reconstruction is the same however it is intersected, and better with a better spline.
  EXPECT_EQ(by_label.at("bcc7 fir, exact")["reconstruction"], by_label.at("bcc7 fir, march 0.9")["reconstruction"]);
  const auto value = [&](const char* label) { return by_label.at(label)["reconstruction"]["value_rmse"].get<double>(); };
  EXPECT_LT(5.0 * value("bcc7 fir, exact"), value("trilinear, exact"));
  EXPECT_LT(5.0 * value("tricubic fir, exact"), value("trilinear, exact"));
  EXPECT_LT(by_label.at("bcc7 fir, exact")["truth"]["depth_rms_cells"], by_label.at("trilinear, exact")["truth"]["depth_rms_cells"]);
  EXPECT_THAT(json["command"].get<std::string>(), AllOf(HasSubstr("quincunx compare gyroid "), HasSubstr("--samples 20"), Not(HasSubstr(out))));
  for (const char* name : {"compare.csv", "compare.json", "compare.md", "compare.html"}) EXPECT_TRUE(std::filesystem::exists(out + "/" + name)) << name;
}

TEST_F(CompareProgram, TakesAVolumeWhoseTruthIsNotKnown) {
  const test::Outcome run = test::run({"compare", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd", "--iso", "40", "--splines", "bcc7", "--steps", "1", "--size", "32", "32", "--rounds", "1", "--normals", "analytic,0.5", "--structures",
                                       "grid,none", "--markdown", "-o", out});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("| bcc7   | bcc    | fir       | float32 | march 1 | central 0.5 | none"), Not(HasSubstr("true")), HasSubstr("Error and time")));
}

/// The body element of a page after a browser ran its scripts; "" where there is no browser.
std::string body_in_a_browser(const std::string& page, const std::string& hash, const std::string& home) {
  if (std::system("chromium --version >/dev/null 2>&1") != 0) return "";
  const std::string file = home + "/dom.html";
  const std::string command = "HOME='" + home + "' timeout 60 chromium --headless --no-sandbox --disable-gpu --dump-dom 'file://" + std::filesystem::absolute(page).string() + hash + "' >'" + file + "' 2>/dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string dom = test::read_file(file);
  const std::size_t begin = dom.find("<body");
  return begin == std::string::npos ? "no body" : dom.substr(begin, dom.find('>', begin) - begin);
}

TEST_F(CompareProgram, MakesAPageThatDrawsEveryCombinationInABrowser) {
  const test::Outcome run = test::run(compare({"--splines", "trilinear", "--steps", "0.9,0.5", "--quiet"}));
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string body = body_in_a_browser(out + "/compare.html", "", folder / "");
  if (body.empty()) GTEST_SKIP() << "no chromium";
  EXPECT_THAT(body, AllOf(HasSubstr("data-points=\"3\""), HasSubstr("data-error=\"image\""), HasSubstr("data-front=\"")));
  EXPECT_THAT(body_in_a_browser(out + "/compare.html", "#ref-wrong", folder / ""), HasSubstr("data-error=\"ref-wrong\""));
}

TEST_F(CompareProgram, RefusesWhatItCannotCompareAndWritesNothing) {
  expect_refused(compare({"--splines", "bcc9"}), {"bcc9", "bcc7"});
  expect_refused(compare({"--splines", "bcc7,bcc7"}), {"--splines: found bcc7 twice"});
  expect_refused(compare({"--storage", "float64"}), {"--storage", "float64", "unorm8"});
  expect_refused(compare({"--reduce", "0.5"}), {"--reduce", "0.5", "16"});
  expect_refused({"compare", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd", "--iso", "40", "--reduce", "2", "-o", out}, {"--reduce", "bcc", "Cartesian"});
  expect_refused(compare({"--steps", "0"}), {"--steps", "0.001"});
  expect_refused(compare({"--normals", "flat"}), {"--normals", "flat"});
  expect_refused(compare({"--preset", "table9"}), {"--preset", "table9", "table3"});
  expect_refused(compare({"--error", "beauty"}), {"--error", "beauty", "image"});
  expect_refused(compare({"--structures", "quadtree"}), {"quadtree"});
  expect_refused(compare({"--device", "cpu"}), {"cpu"});
  expect_refused({"compare", "-o", out}, {"VOLUME", "--preset"});
  expect_refused({"compare", "gyroid"}, {"--output"});
  expect_refused({"compare", folder / "none.nrrd", "--iso", "1", "-o", out}, {"none.nrrd"});
  expect_refused({"compare", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd", "-o", out}, {"--iso"});
  expect_refused({"compare", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd", "--iso", "40", "--error", "normal", "-o", out}, {"--error", "normal", "image"});
  expect_refused({"compare", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd", "--iso", "40", "--splines", "tricubic", "-o", out}, {"--splines", "tricubic"});
}

}  // namespace
}  // namespace quincunx
