// quincunx sweep as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "accel/structure.h"
#include "bench/presets.h"
#include "io/volume_file.h"
#include "lattice/field.h"
#include "tests/app/program.h"

namespace quincunx::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kNeghip = QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd";

class SweepProgram : public ProgramInFolder {
 protected:
  /// Quick, unless `more` says otherwise.
  Arguments sweep(const Arguments& more) const {
    Arguments arguments{"sweep", kNeghip, "--iso", "40", "--size", "48", "48", "--orbit", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  const std::string out = folder / "out";
};

/// The rows of a CSV without quotes, as maps from the header's words.
std::vector<std::map<std::string, std::string>> read_csv(const std::string& path) {
  const auto split = [](const std::string& line) {
    std::vector<std::string> words;
    std::istringstream stream(line + ",");
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    return words;
  };
  std::vector<std::map<std::string, std::string>> rows;
  const std::vector<std::string> text = lines(read_file(path));
  const std::vector<std::string> keys = split(text.at(0));
  for (std::size_t n = 1; n < text.size(); ++n) {
    const std::vector<std::string> values = split(text[n]);
    EXPECT_EQ(values.size(), keys.size());
    for (std::size_t k = 0; k < std::min(keys.size(), values.size()); ++k) rows.resize(n), rows[n - 1][keys[k]] = values[k];
  }
  return rows;
}

bool gnuplot_is_there() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

TEST_F(SweepProgram, WritesTheSameNumbersAsTablesCsvJsonAndADrawing) {
  const Outcome outcome = run(sweep({"--structures", "grid,distance", "--blocks", "16,8", "-o", out}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("auto chose "));

  const json report = json::parse(read_file(out + "/sweep.json"));
  const auto rows = read_csv(out + "/sweep.csv");
  // none, two structures with two blocks, and what auto chose where that is none of them.
  ASSERT_EQ(rows.size(), report["settings"].size());
  ASSERT_GE(rows.size(), 5u);
  EXPECT_LE(rows.size(), 6u);
  EXPECT_EQ(report["blocks"], json({8, 16}));
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const json& setting = report["settings"][n];
    EXPECT_EQ(rows[n].at("structure"), setting["structure"]);
    EXPECT_EQ(setting["frames_ms"].size(), 2u);
    EXPECT_EQ(setting["hits"], report["settings"][0]["hits"]);  // no way to skip changes a picture
    EXPECT_GT(setting["traversal_ms"], 0.0);
    for (const auto& [key, text] : rows[n]) {
      ASSERT_TRUE(setting.contains(key)) << key;
      const json& value = setting[key];
      if (value.is_number()) {
        EXPECT_EQ(std::strtod(text.c_str(), nullptr), value.get<double>()) << key;
      } else {
        EXPECT_EQ(text, value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump()) << key;
      }
    }
  }
  const json &none = report["settings"][0], &grid = report["settings"][1];
  EXPECT_EQ(none["structure"], "none");
  EXPECT_EQ(none["speedup_median"], 1.0);
  EXPECT_EQ(none["blocks"], 0);
  EXPECT_EQ(grid["structure"], "grid");
  EXPECT_EQ(grid["block"], 8);
  EXPECT_LT(grid["evaluations_per_ray"], none["evaluations_per_ray"]);
  EXPECT_GT(grid["classify_ms"], 0.0);
  EXPECT_GT(grid["change_ms"], 0.0);
  EXPECT_GT(grid["depth_complexity"], 0.0);
  EXPECT_GT(grid["structure_bytes"], 0);
  EXPECT_GT(grid["occupancy_bytes"], 0);
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row.at("auto") == "true"; }), 1);

  EXPECT_THAT(read_file(out + "/sweep.md"), HasSubstr("| structure |"));
  if (gnuplot_is_there()) {
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(read_file(out + "/sweep.svg"), testing::AllOf(HasSubstr("<svg"), HasSubstr("neghip_bcc.nrrd"), HasSubstr("</svg>")));
  } else {
    EXPECT_THAT(outcome.err, HasSubstr("gnuplot"));
  }
}

TEST_F(SweepProgram, ComparesVolumesAndBricksAndFindsTheirPicturesTheSame) {
  const std::string tf = QUINCUNX_SOURCE_DIR "/data/transfer/neghip_clear.json";
  const Outcome outcome = run({"sweep", kNeghip, "--dvr", tf, "--size", "48", "48", "--orbit", "2", "--structures", "grid,octree,bvh:boxes", "--blocks", "8",
                               "--bricks", "32,8", "--pool", "600K", "--classify", "pre-integrated", "-o", out});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("transfer function neghip_clear.json"));
  EXPECT_THAT(outcome.out, HasSubstr("bit for bit"));
  const json report = json::parse(read_file(out + "/sweep.json"));
  EXPECT_EQ(report["transfer_function"]["classify"], "pre-integrated");
  EXPECT_EQ(report["isovalues"], json::array());
  for (const json& setting : report["settings"]) {
    EXPECT_EQ(setting["differing_pixels"], 0);
    EXPECT_GT(setting["table_ms"], 0.0);
    EXPECT_GT(setting["hits"], 100);
  }
  ASSERT_EQ(report["bricks"].size(), 3u);
  EXPECT_TRUE(report["bricks"][0]["brick"].is_null());
  EXPECT_EQ(report["bricks"][1]["brick"], 8);
  EXPECT_EQ(report["bricks"][1]["differing_pixels"], 0);
  EXPECT_EQ(report["bricks"][2]["count"], 8);
  EXPECT_EQ(report["bricks"][2]["slots"], 8);  // 19^3 x 2 floats each are 54,872 bytes
  EXPECT_EQ(report["bricks"][2]["loads"], 0);  // all are resident when frames are timed
  EXPECT_EQ(report["bricks"][1]["frames_ms"].size(), 2u);
}

TEST_F(SweepProgram, TakesCartesianVolumes) {
  const std::string volume = folder / "v.nrrd";
  write_volume(make_volume(LatticeKind::cartesian, {12, 11, 10}, {}, [](const glm::dvec3& x) { return std::sin(0.5 * x.x) + std::cos(0.4 * x.y); }), volume);
  const Outcome outcome = run({"sweep", volume, "--iso", "0.3", "--spline", "tricubic", "--size", "24", "24", "--orbit", "1", "--structures", "grid",
                               "--blocks", "4", "--quiet", "--json", "-o", out});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["spline"], "tricubic");
}

TEST_F(SweepProgram, WritesAllButTheDrawingWithoutGnuplot) {
  const TemporaryFolder empty;
  std::filesystem::create_directory(out);
  write_file(out + "/sweep.svg", "of an earlier sweep");
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (empty / ".").c_str(), 1);
  const Outcome outcome = run(sweep({"--structures", "grid", "--blocks", "16", "--quiet", "-o", out}));
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("note: "), HasSubstr("gnuplot-nox")));
  EXPECT_FALSE(std::filesystem::exists(out + "/sweep.svg"));
  EXPECT_TRUE(std::filesystem::exists(out + "/sweep.csv"));
}

TEST_F(SweepProgram, PrintsTheJsonThatItWrites) {
  const Outcome outcome =
      run(sweep({"--structures", "none", "--cell-test", "both", "--blocks", "16", "--repeat", "2", "--json", "-o", out + "/"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, read_file(out + "/sweep.json"));
  EXPECT_EQ(json::parse(outcome.out)["settings"][0]["frames_ms"].size(), 4u);
}

TEST_F(SweepProgram, MakesAPublishedExperimentAgain) {
  const Outcome outcome = run({"sweep", "--preset", "ganter-table1", kNeghip, "--iso", "40", "-o", out});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = json::parse(read_file(out + "/ganter-table1.json"));
  EXPECT_EQ(report["preset"], "ganter-table1");
  ASSERT_EQ(report["rows"].size(), 9u);  // three sizes of blocks, merged in two ways and not at all
  EXPECT_EQ(read_csv(out + "/ganter-table1.csv").size(), 9u);
  EXPECT_EQ(report["rows"][0]["data_set"], "neghip_bcc");
  EXPECT_THAT(read_file(out + "/ganter-table1.md"), HasSubstr("| data set"));
  EXPECT_THAT(outcome.out, testing::AllOf(HasSubstr("Ganter"), HasSubstr("22,058 active of 262,144 blocks")));
  EXPECT_FALSE(std::filesystem::exists(out + "/ganter-table1.svg"));  // it is no figure
}

TEST_F(SweepProgram, SaysWhichExperimentsThereAre) {
  const std::string list = run({"sweep", "--list-presets"}).out, help = run({"sweep", "--help"}).out;
  for (const std::string& name : preset_names()) {
    EXPECT_THAT(list, HasSubstr(name));
    EXPECT_THAT(help, HasSubstr(name));
  }
}

TEST_F(SweepProgram, RefusesWithAPresetWhatItFixes) {
  expect_refused({"sweep", "--preset", "ganter", "-o", out}, {"--preset", "ganter-table1"});
  expect_refused({"sweep", "--preset", "ganter-table1", "--blocks", "4", "-o", out}, {"--blocks", "ganter-table1"});
  expect_refused({"sweep", "--preset", "ganter-table1", "--size", "64", "64", "-o", out}, {"--size", "ganter-table1"});
  expect_refused({"sweep", "--preset", "ganter-table1", "--orbit", "2", "-o", out}, {"--orbit", "fixes"});
  expect_refused({"sweep", "--preset", "ganter-table1", "--tf", "f.json", "-o", out}, {"--tf", "fixes"});
  expect_refused({"sweep", "--preset", "ganter-table1"}, {"--output"});
  expect_refused({"sweep", "--preset", "ganter-table1", "--device", "cpu", "-o", out}, {"--device"});
  expect_refused({"sweep", "--preset", "ganter-table1", kNeghip, "-o", out}, {"--iso", "0 values for 1 volume"});
  expect_refused({"sweep", "--preset", "ganter-table1", kNeghip, "--iso", "4000", "-o", out}, {"--iso", "4000", "neghip"});
  expect_refused({"sweep", "--preset", "ganter-table1", "--iso", "40", "-o", out}, {"--iso", "no volume"});
  expect_refused({"sweep", "--preset", "zellmann-figure5", kNeghip, "--iso", "40", "-o", out}, {"VOLUME", "makes its own"});
  expect_refused({"sweep", kNeghip, "--iso", "40", "--full", "-o", out}, {"--full", "--preset"});
  expect_refused({"sweep", kNeghip, kNeghip, "--iso", "40", "-o", out}, {"VOLUME", "2 files"});
  expect_refused({"sweep", "--iso", "40", "-o", out}, {"VOLUME", "--preset"});
}

TEST_F(SweepProgram, InterruptedLeavesNothingOrWholeFiles) {
  // Hours of work, of which the first round takes a second or two once kernels are compiled.
  const Arguments arguments = sweep({"--repeat", "100000", "--structures", "grid", "--blocks", "16", "-o", out});
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> begun;
  const auto measuring = [&] {
    if (!begun && std::filesystem::exists(out)) begun = Clock::now();
    return begun && Clock::now() - *begun > std::chrono::seconds(3);
  };
  const Outcome outcome = run_and_signal(arguments, SIGINT, measuring);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  if (!std::filesystem::exists(out)) {
    EXPECT_EQ(outcome.err, "quincunx: interrupted\n");
    return;
  }
  const json report = json::parse(read_file(out + "/sweep.json"));
  EXPECT_EQ(read_csv(out + "/sweep.csv").size(), report["measured"]);
  EXPECT_THAT(outcome.err, HasSubstr("quincunx: interrupted: " + report["measured"].dump() + " of " + report["planned"].dump() + " settings"));
}

TEST_F(SweepProgram, RefusesBadInputInOneLineAndMakesNoFolder) {
  expect_refused(sweep({}), {"--output"});
  expect_refused({"sweep", kNeghip, "-o", out}, {"--iso", "--tf"});
  expect_refused({"sweep", kNeghip, "--tf", folder / "none.json", "-o", out}, {"none.json"});
  expect_refused({"sweep", kNeghip, "--iso", "40", "--classify", "post", "-o", out}, {"--classify", "--tf"});
  expect_refused(sweep({"--bricks", "8,12", "-o", out}), {"--bricks", "12", "power of two from 4 to 256"});
  expect_refused(sweep({"--bricks", "16,16", "-o", out}), {"--bricks", "twice"});
  expect_refused(sweep({"--bricks", "8,64", "--pool", "10K", "-o", out}), {"--pool", "10240 bytes", "one brick of 64 cells"});
  expect_refused(sweep({"--bricks", "16", "--intersect", "march", "-o", out}), {"--bricks", "march"});
  expect_refused(sweep({"--bricks", "16", "--storage", "unorm16", "-o", out}), {"--bricks", "unorm16", "float32"});
  expect_refused(sweep({"--storage", "unorm8", "--precision", "double", "-o", out}), {"--storage", "unorm8", "--precision double"});
  Arguments unknown{"--structures", "grid,tree", "-o", out};
  std::vector<std::string> parts{"--structures", "'tree'"};
  parts.insert(parts.end(), skip_labels().begin(), skip_labels().end());
  expect_refused(sweep(unknown), parts);
  expect_refused(sweep({"--structures", "grid,grid", "-o", out}), {"--structures", "twice"});
  expect_refused(sweep({"--blocks", "8,12", "-o", out}), {"--blocks", "12", "power of two"});
  expect_refused(sweep({"--blocks", "8,8", "-o", out}), {"--blocks", "twice"});
  expect_refused(sweep({"--blocks", "", "-o", out}), {"--blocks"});
  expect_refused({"sweep", kNeghip, "--iso", "40", "--orbit", "0", "-o", out}, {"--orbit", "'0'"});
  expect_refused(sweep({"--cell-test", "maybe", "-o", out}), {"--cell-test", "both"});
  expect_refused(sweep({"--device", "cpu", "-o", out}), {"--device", "the reference walks no structure"});
  expect_refused(sweep({"--device", "no such device", "-o", out}), {"no such device"});
  expect_refused(sweep({"-o", kNeghip}), {"-o", "neghip_bcc.nrrd", "expected a folder"});
  expect_refused(sweep({"-o", folder / "no/such"}), {"-o", "no folder"});
  expect_refused({"sweep", folder / "none.nrrd", "--iso", "1", "-o", out}, {"none.nrrd"});
  expect_refused({"sweep", kNeghip, "--iso", "40,40", "--size", "48", "48", "-o", out}, {"40"});
}

}  // namespace
}  // namespace quincunx::test
