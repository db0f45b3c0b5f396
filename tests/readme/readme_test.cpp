// The README does what it shows.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "io/image_file.h"
#include "tests/readme/markdown.h"

namespace quincunx {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = QUINCUNX_SOURCE_DIR;

std::string read_text(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

const std::string& readme() {
  static const std::string text = read_text(kSource / "README.md");
  return text;
}

std::vector<FencedBlock> shell_blocks() {
  std::vector<FencedBlock> blocks = fenced_blocks(readme());
  std::erase_if(blocks, [](const FencedBlock& block) { return block.language != "sh"; });
  return blocks;
}

/// A folder with the bundled volumes in it, where `quincunx` is the program that was built; removed with the object.
class Readme : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "quincunx-readme-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    fs::create_directory(folder_ / "bin");
    fs::create_directory(folder_ / "out");
    fs::create_symlink(QUINCUNX_PROGRAM, folder_ / "bin" / "quincunx");
    fs::create_directory_symlink(kSource / "data", folder_ / "data");
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Runs `text` in the folder as one script that ends at its first failure; its exit status and all it printed.
  struct Outcome {
    int status;
    std::string printed;
  };
  Outcome run(const std::string& text) const {
    const fs::path script = folder_ / "script.sh", log = folder_ / "script.log";
    std::ofstream(script) << "set -euo pipefail\ncd '" << folder_.string() << "'\nPATH='" << (folder_ / "bin").string()
                          << "':$PATH\n"
                          << text;
    const std::string command = "timeout 120 bash '" + script.string() + "' >'" + log.string() + "' 2>&1 </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, read_text(log)};
  }

  fs::path folder_;
};

TEST_F(Readme, EveryCommandRunsInItsOrder) {
  const std::vector<FencedBlock> blocks = shell_blocks();
  EXPECT_GE(blocks.size(), 10u);
  for (const FencedBlock& block : blocks) {
    const Outcome outcome = run(block.text);
    EXPECT_EQ(outcome.status, 0) << "README.md:" << block.line << ":\n" << block.text << outcome.printed;
  }
}

TEST_F(Readme, AFailingCommandOfABlockIsNoticedWhereverItStands) {
  EXPECT_EQ(run("quincunx --version\n").status, 0);
  EXPECT_EQ(run("quincunx info nothing.nrrd\nquincunx --version\n").status, 2);
  EXPECT_EQ(run("quincunx info nothing.nrrd | cat\n").status, 2);
}

TEST_F(Readme, EverySubcommandHasAnExample) {
  std::string commands;
  for (const FencedBlock& block : shell_blocks()) commands += block.text;
  const std::string help = run("quincunx --help\n").printed, heading = "ubcommands:\n";
  const std::size_t list = help.find(heading);
  ASSERT_NE(list, std::string::npos) << help;
  std::istringstream lines(help.substr(list + heading.size()));
  int count = 0;
  for (std::string line, name; std::getline(lines, line) && std::istringstream(line) >> name; ++count)
    EXPECT_TRUE(std::regex_search(commands, std::regex("\\bquincunx " + name + "\\s"))) << name;
  EXPECT_GE(count, 6);
}

TEST_F(Readme, ThePictureIsTheOneThatTheCommandBesideItMakes) {
  const std::string picture = "docs/mri_head.png";
  ASSERT_NE(readme().find("](" + picture + ")"), std::string::npos);
  for (const FencedBlock& block : shell_blocks()) {
    if (block.text.find(picture) == std::string::npos) continue;
    const Outcome outcome = run(block.text);
    ASSERT_EQ(outcome.status, 0) << outcome.printed;
  }
  const Image made = read_image((folder_ / picture).string()), shown = read_image((kSource / picture).string());
  ASSERT_EQ(made.width, shown.width);
  ASSERT_EQ(made.height, shown.height);
  ASSERT_EQ(made.pixels.size(), shown.pixels.size());
  // Another device may round an edge to the other side, no more.
  std::size_t different = 0;
  for (std::size_t n = 0; n < made.pixels.size(); ++n) different += std::abs(made.pixels[n] - shown.pixels[n]) > 0.02f;
  EXPECT_LE(different, made.pixels.size() / 1000);
  EXPECT_LT(fs::file_size(kSource / picture), 400'000u);
}

TEST_F(Readme, TheStatisticsHaveTheKeysThatItNamesAndNoOthers) {
  const auto keys_of = [&](const std::string& flags) {
    const Outcome outcome =
        run("quincunx render data/neghip_bcc.nrrd --iso 40 --size 16 16 --stats out/keys.json " + flags);
    EXPECT_EQ(outcome.status, 0) << outcome.printed;
    std::set<std::string> keys;
    const auto written = nlohmann::json::parse(read_text(folder_ / "out" / "keys.json"));
    for (const auto& [key, value] : written.items()) {
      keys.insert(key);
      if (!value.is_object()) continue;
      for (const auto& item : value.items()) keys.insert(item.key());
    }
    return keys;
  };
  std::set<std::string> written = keys_of("");
  written.merge(keys_of("--intersect march --normal central"));
  written.merge(keys_of("--heat steps -o out/keys.png"));
  written.merge(keys_of("--skip bvh --cluster"));
  written.merge(keys_of("--skip kdtree"));
  written.merge(keys_of("--skip hybrid"));
  written.merge(keys_of("--skip segments"));
  written.merge(keys_of("--tf data/transfer/neghip_clear.json --adaptive 0.1 --modulate 1,2 --jitter 1"));
  written.merge(keys_of("--pool 1M --brick 16"));

  const std::string text = section(readme(), "## Statistics");
  ASSERT_FALSE(text.empty());
  std::set<std::string> named;
  for (const std::string& word : code_words(text)) named.insert(word);
  for (const std::string& key : written) EXPECT_TRUE(named.contains(key)) << key << " is written and not explained";

  // The first column holds keys alone.
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| `")) continue;
    for (const std::string& key : code_words(line.substr(0, line.find('|', 1))))
      EXPECT_TRUE(written.contains(key)) << key << " is explained and not written";
  }
}

TEST(Documents, LinkToFilesThatAreThere) {
  std::vector<fs::path> pages{kSource / "README.md", kSource / "data" / "README.md"};
  for (const auto& entry : fs::directory_iterator(kSource / "docs"))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  std::size_t links = 0;
  for (const fs::path& page : pages)
    for (const std::string& file : linked_files(read_text(page))) {
      EXPECT_TRUE(fs::exists(page.parent_path() / file)) << page.filename() << " links to " << file;
      ++links;
    }
  EXPECT_GE(links, 5u);
}

TEST(Documents, NameSourceFilesThatAreThere) {
  // A path in backquotes such as `render/kernel.cpp`; `spline/<name>.cpp` stands for files to come.
  const std::set<std::string> folders{"lattice", "io",  "spline", "accel", "gpu",  "shaders", "render",
                                      "app",     "bench", "tests",  "data",  "docs", "cmake"};
  std::size_t names = 0;
  for (const char* page : {"README.md", "docs/architecture.md", "docs/exactness.md", "docs/splines.md", "docs/structures.md"})
    for (const std::string& word : code_words(read_text(kSource / page))) {
      const bool path = word.find('/') != std::string::npos && word.find_first_of(" *<") == std::string::npos;
      if (!path || !folders.contains(word.substr(0, word.find('/')))) continue;
      EXPECT_TRUE(fs::exists(kSource / word)) << page << " names " << word;
      ++names;
    }
  EXPECT_GE(names, 10u);
}

}  // namespace
}  // namespace quincunx
