#include "bench/sweep_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "accel/structure.h"
#include "bench/sweep_plot.h"
#include "tests/app/program.h"

namespace quincunx {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// The frames of two rounds and two views, in ms.
SweepMeasurement measurement(std::vector<double> frame_ms, const SweepSetting& setting) {
  SweepMeasurement m;
  m.cost = {.frame_ms = std::move(frame_ms), .rays = 200, .hits = 80, .evaluations = 500};
  m.steps = 300;
  m.intervals = 100;
  m.traversal_ms = {1.0, 3.0};
  m.traversal_intervals = 1200;
  m.stages.classify_ms = 0.5;
  m.stages.cluster_ms = 0.25;
  m.scene.build_ms = 1.0;
  m.scene.table_ms = 0.75;
  m.scene.device_bytes = {{"coefficients", 9}, {"structure", 4096}, {"occupancy", 77}};
  if (!setting.skips()) return m;
  m.scene.blocks = 64;
  m.scene.block_extents = {4, 4, 4};
  m.scene.active_blocks = 16;
  m.scene.leaves = 4;
  m.scene.nodes = 9;
  m.scene.one_child = 2;
  m.scene.depth = 5;
  return m;
}

/// none 40 and 80 ms; grid half, octree a quarter of it with blocks of 4; both 20 ms slower with blocks of 8. Auto chose grid, 8.
SweepReport known_report() {
  SweepReport report{.volume = "folder/some_volume.nrrd",
                     .spline = "bcc7",
                     .isovalues = {1.5, 2.0},
                     .transfer_function = "",
                     .look = {},
                     .width = 10,
                     .height = 10,
                     .views = 2,
                     .rounds = 2,
                     .choices = {.labels = {"grid", "octree"}, .blocks = {4, 8}},
                     .machine = {"a device", "", "a processor", 2},
                     .settings = {},
                     .measured = {},
                     .bricks = {}};
  report.settings = sweep_settings(report.choices, labelled_skip("grid", {.block = 8}));
  const std::vector<std::vector<double>> frames{
      {40, 80, 40, 80}, {20, 40, 20, 40}, {10, 20, 10, 20}, {40, 60, 40, 60}, {30, 40, 30, 40}};
  for (std::size_t n = 0; n < frames.size(); ++n) report.measured.push_back(measurement(frames[n], report.settings[n]));
  return report;
}

TEST(SweepReport, FrameTableHasARowForEachStructureAndAColumnForEachBlock) {
  const Table table = sweep_frame_table(known_report());
  EXPECT_THAT(table.headings, ElementsAre("structure", "none", "4", "8", "best speed-up"));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_THAT(table.rows[0], ElementsAre("grid", "60", "30", "+50", "2"));
  EXPECT_THAT(table.rows[1], ElementsAre("octree", "60", "*15", "35", "4"));
}

TEST(SweepReport, FrameTableHasRowsWithAndWithoutCellTestsWhereBothWereMeasured) {
  SweepReport report = known_report();
  report.choices.cell_tests = CellTests::both;
  report.choices.blocks = {4};
  report.settings = sweep_settings(report.choices, std::nullopt);
  const Table table = sweep_frame_table(report);
  EXPECT_THAT(table.headings, ElementsAre("structure", "cell test", "none", "4", "best speed-up"));
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_THAT(table.rows[0], ElementsAre("grid", "on", "60", "30", "2"));
  EXPECT_THAT(table.rows[1], ElementsAre("grid", "off", "60", "50", testing::_));
  EXPECT_EQ(sweep_stage_table(report).headings[1], "cell test");
}

TEST(SweepReport, StageTableHasARowForEachSetting) {
  const Table table = sweep_stage_table(known_report());
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_THAT(table.rows[0], ElementsAre("none", "-", "0", "0", "-", "0", "-", "-", "-", "-", "0.5", "0.25", "0", "0", "1.75", "4096", "2", "60", "80", "1"));
  EXPECT_THAT(table.rows[2],
              ElementsAre("octree", "4", "64", "16", "25", "4", "25", "9", "2", "5", "0.5", "0.25", "0", "0", "1.75", "4096", "2", "*15", "20", "4"));
  EXPECT_EQ(table.headings.size(), table.rows[0].size());
}

TEST(SweepReport, SpeedUpIsOfFramesOfTheSameRoundAndViewWhereThereAreFewerRoundsToo) {
  SweepReport report = known_report();
  // 40 / 40, 80 / 60: the median of 1 and 1.333.
  EXPECT_NEAR(report.speedup_of(3).median, 7.0 / 6.0, 1e-12);
  report.measured[0].cost.frame_ms = {40, 80, 4000, 8000};
  report.measured[3].cost.frame_ms.resize(2);
  EXPECT_NEAR(report.speedup_of(3).median, 7.0 / 6.0, 1e-12);
}

TEST(SweepReport, TellsHowFarAutoIsFromTheBest) {
  SweepReport report = known_report();
  EXPECT_EQ(sweep_choice(report), "auto chose grid, blocks of 8 cells: 3.33 times the best (octree, 4)");
  report.settings = sweep_settings(report.choices, labelled_skip("octree", {.block = 4}));
  EXPECT_EQ(sweep_choice(report), "auto chose octree, blocks of 4 cells: the best");
  report.settings = sweep_settings(report.choices, labelled_skip("none"));
  EXPECT_EQ(sweep_choice(report), "auto chose none: 4.00 times the best (octree, 4)");
  report.settings = sweep_settings(report.choices, labelled_skip("octree", {.block = 8}));
  report.measured.resize(2);
  EXPECT_EQ(sweep_choice(report), "auto chose octree, blocks of 8 cells: not measured");
}

TEST(SweepReport, CaptionSaysWhatWasMeasuredWhere) {
  const std::string caption = sweep_caption(known_report());
  for (const char* part : {"some_volume.nrrd, bcc7, isovalues 1.5, 2, 10 x 10, 2 views, 2 rounds, exact, cell test on", "a device", "* the best"})
    EXPECT_THAT(caption, HasSubstr(part));
  EXPECT_THAT(caption, Not(HasSubstr("folder")));
}

TEST(SweepReport, JsonHasTheStatisticsOfEachSetting) {
  const auto json = sweep_json(known_report());
  EXPECT_EQ(json["planned"], 5);
  EXPECT_EQ(json["measured"], 5);
  EXPECT_EQ(json["best"], 2);
  EXPECT_EQ(json["auto"]["structure"], "grid");
  EXPECT_DOUBLE_EQ(json["auto"]["times_best"], 50.0 / 15.0);
  const auto& octree = json["settings"][2];
  EXPECT_EQ(octree["structure"], "octree");
  EXPECT_EQ(octree["block"], 4);
  EXPECT_EQ(octree["frame_ms_worst"], 20.0);
  EXPECT_EQ(octree["evaluations_per_ray"], 2.5);
  EXPECT_EQ(octree["steps_per_ray"], 1.5);
  EXPECT_EQ(octree["intervals_per_ray"], 0.5);
  EXPECT_EQ(octree["active_fraction"], 0.25);
  EXPECT_EQ(octree["depth_complexity"], 6.0 / 12.0);  // 1200 intervals of 200 rays, 4 + 4 + 4 blocks
  EXPECT_EQ(octree["one_child"], 2);
  EXPECT_EQ(octree["structure_bytes"], 4096);
  EXPECT_EQ(octree["occupancy_bytes"], 77);
  EXPECT_EQ(octree["frames_ms"].size(), 4u);
  EXPECT_TRUE(json["settings"][0]["block"].is_null());
  EXPECT_TRUE(json["settings"][0]["depth_complexity"].is_null());
}

TEST(SweepReport, SaysWhatIsSeenAndHow) {
  SweepReport report = known_report();
  EXPECT_EQ(sweep_subject(report), "isovalues 1.5, 2");
  report.transfer_function = "folder/head.json";
  report.look = DirectVolume{};
  report.look->step = 0.5;
  report.intersect = Intersect::march;
  report.step = 0.25;
  EXPECT_EQ(sweep_subject(report), "isovalues 1.5, 2 and transfer function head.json");
  EXPECT_EQ(sweep_method(report), "march 0.25, post, steps of 0.5 cells");
  report.isovalues.clear();
  report.look->step = 1.0;
  report.look->shade = false;
  report.look->classify = Classify::pre_integrated;
  EXPECT_EQ(sweep_subject(report), "transfer function head.json");
  EXPECT_EQ(sweep_method(report), "pre-integrated, unlit, steps of 1 cell");
  EXPECT_EQ(sweep_json(report)["storage"], "float32");
  report.storage = Storage::unorm16;
  EXPECT_EQ(sweep_method(report), "pre-integrated, unlit, steps of 1 cell, coefficients in unorm16");
  const auto json = sweep_json(report);
  EXPECT_EQ(json["storage"], "unorm16");
  EXPECT_EQ(json["transfer_function"]["file"], "folder/head.json");
  EXPECT_EQ(json["transfer_function"]["classify"], "pre-integrated");
}

TEST(SweepReport, BricksTableHasARowForTheWholeVolumeAndEachSizeOfBrick) {
  SweepReport report = known_report();
  BricksMeasurement whole, bricks;
  whole.frame_ms = {10, 20};
  whole.device_bytes = 1 << 20;
  bricks = {.brick = 16, .first = {.edge = 16, .count = 64, .slots = 9, .resident = 7, .loads = 8, .evictions = 1, .loaded_bytes = 99, .rounds = 3, .load_ms = 2.5},
            .first_ms = 4.0, .frame_ms = {11, 30}, .loads = 5, .device_bytes = 1 << 21, .differing_pixels = 0};
  report.bricks = {whole, bricks};
  const Table table = sweep_bricks_table(report);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_THAT(table.rows[0], ElementsAre("whole volume", "-", "-", "-", "-", "-", "-", "1", "15", "1"));
  EXPECT_THAT(table.rows[1], ElementsAre("16", "64", "9", "7", "8", "2.5", "5", "2", "20.5", "1.3"));
  EXPECT_EQ(table.headings.size(), table.rows[0].size());
  EXPECT_THAT(sweep_text(report), HasSubstr("whole volume"));
  const auto json = sweep_json(report);
  EXPECT_TRUE(json["bricks"][0]["brick"].is_null());
  EXPECT_EQ(json["bricks"][1]["first_rounds"], 3);
  EXPECT_EQ(json["bricks"][1]["loads"], 5);
}

TEST(SweepReport, SaysLoudlyWherePicturesDiffer) {
  SweepReport report = known_report();
  EXPECT_EQ(sweep_pictures(report), "the pictures of 4 other settings are those of none, bit for bit");
  report.measured[2].differing_pixels = 12;
  report.bricks.resize(2);
  report.bricks[1].brick = 32;
  report.bricks[1].differing_pixels = 1;
  EXPECT_THAT(report.differing(), ElementsAre("octree, 4: 12 pixels", "bricks of 32: 1 pixels"));
  EXPECT_THAT(sweep_pictures(report), HasSubstr("DIFFERENT PICTURES: octree, 4: 12 pixels"));
}

TEST(SweepReport, CsvHasAHeaderAndALineForEachMeasuredSetting) {
  SweepReport report = known_report();
  report.measured[1].cost.frame_ms.assign(4, 1.0 / 3.0);
  EXPECT_EQ(test::lines(sweep_csv(report)).size(), 6u);
  report.measured.resize(2);
  const std::vector<std::string> lines = test::lines(sweep_csv(report));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[0], testing::StartsWith("structure,block,cell_test,auto,frame_ms_median,"));
  EXPECT_THAT(lines[1], testing::StartsWith("none,,false,false,60.0,"));
  EXPECT_THAT(lines[2], testing::StartsWith("grid,4,true,false,0.3333333333333333,"));
  for (const std::string& line : lines) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 37);
}

TEST(SweepReport, TextsHoldBothTablesAndTheChoice) {
  const SweepReport report = known_report();
  EXPECT_EQ(test::lines(sweep_text(report)).size(), 1 + 1 + 3 + 1 + 6 + 1 + 2u);
  const std::string markdown = sweep_markdown(report);
  EXPECT_EQ(test::lines(markdown).size(), 1 + 1 + 4 + 1 + 7 + 1 + 2u);
  EXPECT_THAT(markdown, HasSubstr("| octree    |   60 | *15 |"));
}

TEST(SweepPlot, DrawsALineForEachStructureNoneAcrossAndTheTwoMarks) {
  const std::string script = sweep_plot_script(known_report());
  EXPECT_THAT(script, HasSubstr("$data1 << EOD\n4 30\n8 50\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("$data2 << EOD\n4 15\n8 35\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("$data3 << EOD\n4 15\nEOD\n"));  // the best
  EXPECT_THAT(script, HasSubstr("$data4 << EOD\n8 50\nEOD\n"));  // auto's
  EXPECT_THAT(script, HasSubstr("plot 60 with lines"));
  EXPECT_THAT(script, HasSubstr("title 'grid'"));
  EXPECT_THAT(script, HasSubstr("set xtics nomirror ('4' 4, '8' 8)"));
  EXPECT_THAT(script, HasSubstr("'some_volume.nrrd, isovalues 1.5, 2, 10 x 10, exact'.\"\\n\".'a device'"));
  EXPECT_THAT(script, HasSubstr("set logscale x 2\nset logscale y 10\n"));
}

TEST(SweepPlot, NeitherMarksNoneNorLetsANameOutOfItsQuotes) {
  SweepReport report = known_report();
  report.volume = "it's\n`touch x`.nrrd";
  report.measured[0].cost.frame_ms.assign(4, 1.0);
  report.settings = sweep_settings(report.choices, labelled_skip("none"));
  const std::string script = sweep_plot_script(report);
  EXPECT_THAT(script, HasSubstr("set title 'it''s?`touch x`.nrrd, "));
  EXPECT_THAT(script, Not(HasSubstr("the best")));
  EXPECT_THAT(script, Not(HasSubstr("chosen by auto")));
}

}  // namespace
}  // namespace quincunx
