// The experiments of publications at sizes of no meaning: their tables have the rows that they should, and generated volumes are what they are said to be.
#include "bench/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "accel/structure.h"
#include "bench/preset_plot.h"
#include "lattice/error.h"
#include "tests/app/program.h"

namespace quincunx {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;

/// Two structures: kernels take longest, and every other test of structures has all of them.
PresetWishes tiny_wishes() {
  return {.volumes = {},
          .thresholds = {},
          .spline = "",
          .device = "",
          .size = {.cells = 20, .block = 4, .cluster_cells = 32, .cluster_blocks = {2, 4}, .width = 12, .height = 12, .views = 2, .rounds = 1, .cluster_rounds = 1},
          .labels = {"grid", "bvh:cubes"}};
}

/// The rows of one run at that size.
PresetReport run_tiny(std::string_view name, const PresetWishes& wishes) {
  ProgressBar bar(Verbosity::quiet);
  PresetRun run(wishes, bar);
  EXPECT_TRUE(run_preset(name, run));
  return run.report();
}

/// The words of a column, each once, in order.
std::vector<std::string> words(const PresetReport& report, std::string_view column) {
  std::vector<std::string> all;
  for (const auto& row : report.rows) {
    const std::string word = row[report.column(column)];
    if (std::find(all.begin(), all.end(), word) == all.end()) all.push_back(word);
  }
  return all;
}

void expect_whole_table(const PresetReport& report) {
  EXPECT_TRUE(report.differing.empty()) << preset_pictures(report);
  EXPECT_EQ(preset_table(report).rows.size(), report.rows.size());
  for (const auto& row : report.rows) {
    ASSERT_EQ(row.size(), report.columns.size());
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (row[c].is_number()) { EXPECT_TRUE(std::isfinite(row[c].get<double>())) << report.columns[c]; }
      EXPECT_EQ(row[c].is_string(), c < report.left || row[c] == "38-53" || row[c] == "5-35" || row[c] == "10-15" || row[c] == "20-40") << report.columns[c];
    }
  }
  EXPECT_EQ(preset_json(report)["rows"].size(), report.rows.size());
  EXPECT_EQ(test::lines(preset_csv(report)).size(), report.rows.size() + 1);
  EXPECT_THAT(preset_markdown(report), HasSubstr(report.preset->paper));
}

TEST(Presets, HaveNamesOfTheirOwnAndSayAfterWhomAndWhatIsNotKnown) {
  std::set<std::string_view> names;
  for (const Preset& preset : presets()) {
    EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
    EXPECT_EQ(&preset_of(preset.name), &preset);
    EXPECT_THAT(std::string(preset.published), HasSubstr("not at hand")) << preset.name;
  }
  EXPECT_THROW(preset_of("ganter"), InputError);
}

/// Published leaves stand beside cubes of data of the same character alone.
void check_ganter_table1(const PresetReport& report) {
  EXPECT_EQ(words(report, "data_set"), (std::vector<std::string>{"strands", "solid parts", "vessels"}));
  for (const auto& row : report.rows) {
    const bool told = row[report.column("clusters")] == "cubes" && row[0] != "vessels";
    EXPECT_EQ(row[report.column("published_leaves_percent")].is_string(), told);
    if (row[report.column("clusters")] == "none") { EXPECT_EQ(row[report.column("leaves")], row[report.column("active")]); }
  }
}

void check_active_parts(const PresetReport& report) {
  std::vector<double> parts;
  for (const auto& row : report.rows)
    if (row[report.column("clusters")] == "cubes") parts.push_back(row[report.column("active_percent")]);
  const std::vector<double> wanted{8, 20, 40, 60, 80, 100};
  ASSERT_EQ(parts.size(), wanted.size());
  for (std::size_t n = 0; n < wanted.size(); ++n) EXPECT_NEAR(parts[n], wanted[n], 1.0);
}

void check_same_active_blocks(const PresetReport& report) {
  const std::size_t active = report.column("active"), function = report.column("function");
  for (const auto& row : report.rows)
    for (const auto& other : report.rows)
      if (row[0] == other[0] && !row[active].is_null() && !other[active].is_null()) { EXPECT_EQ(row[active], other[active]) << row[function] << other[function]; }
}

void check_nothing_empty(const PresetReport& report) {
  for (const auto& row : report.rows)
    if (row[report.column("structure")] != "none") { EXPECT_EQ(row[report.column("active_percent")], 100.0); }
}

/// Rows: data sets, or cases, times what is measured of each; two structures and, where frames are shown, none.
struct Expected {
  std::size_t rows;
  void (*check)(const PresetReport&);
};
void no_more(const PresetReport&) {}

const std::map<std::string, Expected> kExpected{{"ganter-table1", {3 * 2 * 3, check_ganter_table1}},
                                                {"ganter-figure6", {3 * 1, no_more}},
                                                {"ganter-figure7", {1 * 6 * 3, check_active_parts}},
                                                {"ganter-figure8", {3 * 2, no_more}},
                                                {"ganter-figure10", {2 * 2 * 3, check_same_active_blocks}},
                                                {"zellmann-table1", {4 * 2, no_more}},
                                                {"zellmann-figure3", {4 * 2, no_more}},
                                                {"zellmann-figure4", {1 * 2, check_nothing_empty}},
                                                {"zellmann-figure5", {9 * 2, no_more}},
                                                {"kinkelin-table3", {3 * 2 * 2, no_more}}};

class PresetMeasured : public testing::TestWithParam<std::string> {};

TEST_P(PresetMeasured, HasTheRowsOfItsTable) {
  const PresetReport report = run_tiny(GetParam(), tiny_wishes());
  EXPECT_EQ(report.rows.size(), kExpected.at(GetParam()).rows);
  kExpected.at(GetParam()).check(report);
  expect_whole_table(report);
  EXPECT_EQ(report.panels.empty(), GetParam().find("table") != std::string::npos);
  if (!report.panels.empty()) { EXPECT_THAT(preset_plot_script(report), HasSubstr("plot $panel0_0")); }
}

INSTANTIATE_TEST_SUITE_P(All, PresetMeasured, testing::ValuesIn(preset_names()), [](const auto& tested) {
  std::string name = tested.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(PresetRun, TakesFilesInPlaceOfGeneratedVolumesAndTheSplineOfTheirLattice) {
  PresetWishes wishes = tiny_wishes();
  wishes.volumes = {QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd"};
  wishes.thresholds = {40.0};
  const PresetReport report = run_tiny("ganter-table1", wishes);
  EXPECT_EQ(words(report, "data_set"), (std::vector<std::string>{"neghip_bcc"}));
  expect_whole_table(report);
  ProgressBar bar(Verbosity::quiet);
  wishes.thresholds = {1000.0};
  PresetRun run(wishes, bar);
  EXPECT_THROW(run_preset("ganter-table1", run), InputError);
}

TEST(PresetRun, InterruptedKeepsTheRowsThatAreComplete) {
  const Preset preset{.name = "cut", .paper = "", .shows = "", .published = "", .takes_volumes = true, .measure = nullptr};
  PresetReport report;
  report.preset = &preset;
  report.columns = {"word", "number"};
  report.rows = {{"a,\"b\"", nullptr}, {"c", 0.1}};
  report.whole = false;
  EXPECT_THAT(preset_text(report), testing::AllOf(HasSubstr("INTERRUPTED"), testing::Not(HasSubstr("pictures"))));
  report.compared = 2;
  EXPECT_THAT(preset_text(report), HasSubstr("2 other settings are those of none, bit for bit"));
  report.differing = {"strands, grid: 3 pixels"};
  EXPECT_THAT(preset_text(report), HasSubstr("DIFFERENT PICTURES: strands, grid: 3 pixels"));
  EXPECT_EQ(preset_csv(report), "word,number\n\"a,\"\"b\"\"\",\nc,0.1\n");
  EXPECT_EQ(preset_table(report).rows[0][1], "-");
}

/// Of blocks of 4 cells, those that hold a sample of the threshold or more.
double active_part(const PresetVolume& data) {
  const Volume& volume = data.volume;
  const int step = lattice_step(volume.lattice);
  const std::int64_t edge = (domain_max(volume.lattice, volume.extents).x + 3) / 4;
  std::set<std::int64_t> active;
  for (int c = 0; c < coset_count(volume.lattice); ++c)
    for (std::int64_t k = 0; k < volume.extents.z; ++k)
      for (std::int64_t j = 0; j < volume.extents.y; ++j)
        for (std::int64_t i = 0; i < volume.extents.x; ++i) {
          if (volume.sample(c, {i, j, k}) < data.threshold) continue;
          const glm::i64vec3 b = glm::min((glm::i64vec3(i, j, k) * std::int64_t(step) + std::int64_t(c)) / std::int64_t(4), glm::i64vec3(edge - 1));
          active.insert((b.z * edge + b.y) * edge + b.x);
        }
  return double(active.size()) / double(edge * edge * edge);
}

TEST(PresetVolumes, HaveTheActivePartThatTheyClaimOnBothLattices) {
  for (const LatticeKind lattice : {LatticeKind::bcc, LatticeKind::cartesian}) {
    for (const std::string_view name : {"strands", "points"}) {
      const double part = active_part(generated_volume(name, lattice, 64));
      EXPECT_GE(part, 1.0 / 12.0) << name;
      EXPECT_LT(part, 1.0 / 12.0 + 0.02) << name;
    }
    EXPECT_GE(active_part(generated_volume("solid parts", lattice, 64)), 1.0 / 7.0);
    EXPECT_LT(active_part(generated_volume("solid parts", lattice, 64)), 1.0 / 7.0 + 0.1);  // by one ellipsoid at most
    EXPECT_GT(active_part(generated_volume("vessels", lattice, 64)), 0.02);
    EXPECT_LT(active_part(generated_volume("vessels", lattice, 64)), 0.15);
  }
}

TEST(PresetVolumes, AreAFunctionOfTheirArgumentsAndBallsAreAmongMoreBalls) {
  for (const std::string_view name : preset_volume_names()) {
    const PresetVolume one = generated_volume(name, LatticeKind::bcc, 33), other = generated_volume(name, LatticeKind::bcc, 33);
    EXPECT_EQ(one.volume.samples, other.volume.samples) << name;
    EXPECT_EQ(domain_max(LatticeKind::bcc, one.volume.extents), glm::i64vec3(33)) << name;
  }
  EXPECT_THROW(generated_volume("noise", LatticeKind::bcc, 33), InputError);
  const Volume few = generated_balls(2, 4.0, LatticeKind::cartesian, 32).volume, more = generated_balls(5, 4.0, LatticeKind::cartesian, 32).volume;
  const auto &a = std::get<std::vector<std::uint8_t>>(few.samples), &b = std::get<std::vector<std::uint8_t>>(more.samples);
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), [](auto x, auto y) { return x <= y; }));
  EXPECT_NE(a, b);
}

TEST(PresetVolumes, OfWavesAreSmoothAndTheSameAlongARowAsAtItsSamples) {
  // Values that go on from sample to sample by factors are those of the sines: neighbours along x differ no more than along z.
  const Volume volume = generated_volume("waves", LatticeKind::cartesian, 32).volume;
  double along_x = 0.0, along_z = 0.0;
  for (std::int64_t k = 0; k < 32; ++k)
    for (std::int64_t j = 0; j < 32; ++j)
      for (std::int64_t i = 0; i < 32; ++i) {
        const double here = volume.sample(0, {i, j, k});
        along_x = std::max(along_x, std::abs(volume.sample(0, {i + 1, j, k}) - here));
        along_z = std::max(along_z, std::abs(volume.sample(0, {i, j, k + 1}) - here));
      }
  EXPECT_LT(along_x, 2.0 * along_z);
  EXPECT_LT(along_z, 2.0 * along_x);
  EXPECT_LT(along_x, 64.0);
}

TEST(PresetPlot, ASeriesLooksTheSameInEveryPanelAlsoWhereAnotherIsMissing) {
  PresetReport report;
  report.preset = &presets().front();
  report.columns = {"clusters", "structure", "build_ms", "frame_ms"};
  report.left = 0;
  report.rows = {{1, "none", nullptr, 9.0}, {1, "grid", 0.5, 3.0}};
  report.panels = {{.title = "frames", .x = "clusters", .series = "structure", .y = "frame_ms"}, {.title = "construction", .x = "clusters", .series = "structure", .y = "build_ms"}};
  const std::string script = preset_plot_script(report);
  const auto look_of = [&](const std::string& block) {
    const std::size_t from = script.find("$" + block + " using");
    EXPECT_NE(from, std::string::npos) << block;
    const std::string line = script.substr(from, script.find('\n', from) - from);
    return line.substr(line.find(" pt "), line.find(" title ") - line.find(" pt "));
  };
  EXPECT_EQ(look_of("panel1_0"), look_of("panel0_1")) << "grid";
  EXPECT_NE(look_of("panel0_0"), look_of("panel0_1"));
}

}  // namespace
}  // namespace quincunx
