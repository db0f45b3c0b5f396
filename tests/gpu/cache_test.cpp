#include <cstdlib>
#include <fstream>

#include "gpu/device_state.h"
#include "gpu/disk_cache.h"
#include "gpu/hash.h"
#include "tests/gpu/test_device.h"

namespace quincunx::gpu {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<fs::path> files_of(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) found.push_back(entry.path());
  }
  return found;
}

std::string read_all(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
}

void write_all(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::vector<std::byte> some_bytes() {
  const std::string_view text = "forty-two bytes of content, give or take..";
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

TEST(Hash128, GivesThePublishedValues) {
  // FNV-1a of nothing is the offset basis; of "a", from the authors' test vectors.
  EXPECT_EQ(Hash128().hex(), "6c62272e07bb014262b821756295c58d");
  Hash128 hash;
  hash.add(std::as_bytes(std::span("a", 1)));
  EXPECT_EQ(hash.hex(), "d228cb696f1a8caf78912b704e4a8964");
}

TEST(DiskCache, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  EXPECT_FALSE(read_cached(folder.path, "x").has_value());
  write_cached(folder.path, "x", some_bytes());
  EXPECT_EQ(read_cached(folder.path, "x"), some_bytes());
  write_cached(folder.path, "x", {});
  EXPECT_EQ(read_cached(folder.path, "x"), std::vector<std::byte>());
  EXPECT_THAT(files_of(folder.path, ".tmp"), IsEmpty());
}

TEST(DiskCache, MissesWhereTheFileIsCutAtAnyByteOrHasOneTooMany) {
  const TemporaryFolder folder;
  write_cached(folder.path, "x", some_bytes());
  const std::string whole = read_all(folder.path / "x");
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
    write_all(folder.path / "x", whole.substr(0, bytes));
    EXPECT_FALSE(read_cached(folder.path, "x").has_value()) << "cut to " << bytes;
  }
  write_all(folder.path / "x", whole + "!");
  EXPECT_FALSE(read_cached(folder.path, "x").has_value());
}

TEST(DiskCache, MissesWhereABitOfAnyByteIsFlipped) {
  const TemporaryFolder folder;
  write_cached(folder.path, "x", some_bytes());
  const std::string whole = read_all(folder.path / "x");
  for (std::size_t byte = 0; byte < whole.size(); ++byte) {
    std::string altered = whole;
    altered[byte] = static_cast<char>(altered[byte] ^ (1 << byte % 8));
    write_all(folder.path / "x", altered);
    EXPECT_FALSE(read_cached(folder.path, "x").has_value()) << "byte " << byte;
  }
}

TEST(DiskCache, WithoutAFolderIsSilentlyNoCache) {
  const TemporaryFolder folder;
  write_all(folder.path / "file", "not a folder");
  const std::string bad = (folder.path / "file" / "cache").string();
  EXPECT_EQ(prepare_cache_folder(bad), "");
  write_cached("", "x", some_bytes());
  write_cached(bad, "x", some_bytes());
  EXPECT_FALSE(read_cached("", "x").has_value());
  EXPECT_FALSE(read_cached(bad, "x").has_value());
}

TEST(DiskCache, LivesInTheUsersCacheFolderUnlessToldOtherwise) {
  const TemporaryFolder folder;
  ASSERT_EQ(setenv("XDG_CACHE_HOME", folder.path.c_str(), 1), 0);
  EXPECT_EQ(prepare_cache_folder(""), (folder.path / "quincunx").string());
  EXPECT_TRUE(fs::is_directory(folder.path / "quincunx"));
  ASSERT_EQ(setenv("XDG_CACHE_HOME", "relative/is/ignored", 1), 0);
  ASSERT_EQ(setenv("HOME", folder.path.c_str(), 1), 0);
  EXPECT_EQ(prepare_cache_folder(""), (folder.path / ".cache" / "quincunx").string());
  ASSERT_EQ(unsetenv("XDG_CACHE_HOME"), 0);
  ASSERT_EQ(unsetenv("HOME"), 0);
  EXPECT_EQ(prepare_cache_folder(""), "");
}

// A kernel of two files with one define.
class ShaderCacheTest : public GpuTest {
 protected:
  void SetUp() override { open(); }
  std::vector<std::uint32_t> compiled() { return compile(*device, files.lookup(), source); }
  std::vector<fs::path> entries() { return files_of(folder.path, ".spv"); }

  Files files{{{"k.comp",
                "#version 460\nlayout(local_size_x = 1) in;\nlayout(binding = 0) buffer Out { float o[]; } result;\n"
                "#include \"part.glsl\"\nvoid main() { result.o[0] = part(); }\n"},
               {"part.glsl", "float part() { return VALUE; }\n"}}};
  KernelSource source{"k.comp", {{"VALUE", "1.0"}}};
};

TEST_F(ShaderCacheTest, HitsWhereNothingHasChanged) {
  const auto first = compiled();
  ASSERT_THAT(entries(), SizeIs(1));
  // A marked entry that comes back shows that it was read, not compiled.
  std::vector<std::uint32_t> marked = first;
  marked.push_back(0xabcdef);
  write_cached(folder.path, entries()[0].filename(), std::as_bytes(std::span(marked)));
  EXPECT_EQ(compiled(), marked);
}

TEST_F(ShaderCacheTest, MissesWhereAFileAnIncludeOrADefineHasChanged) {
  const auto first = compiled();
  source.defines[0].second = "2.0";
  EXPECT_NE(compiled(), first);
  EXPECT_THAT(entries(), SizeIs(2));
  files.texts["part.glsl"] = "float part() { return VALUE + 1.0; }\n";
  compiled();
  EXPECT_THAT(entries(), SizeIs(3));
  files.texts["k.comp"] += "// a comment\n";
  compiled();
  EXPECT_THAT(entries(), SizeIs(4));
  files.texts["unrelated.glsl"] = "float unrelated;\n";
  compiled();
  EXPECT_THAT(entries(), SizeIs(4));
}

TEST_F(ShaderCacheTest, CompilesAgainAndMendsTheFileWhereItIsCorrupt) {
  const auto first = compiled();
  const fs::path entry = entries().at(0);
  const std::string whole = read_all(entry);
  std::string altered = whole;
  altered[whole.size() / 2] = static_cast<char>(altered[whole.size() / 2] ^ 4);
  for (const std::string& bad : {altered, whole.substr(0, whole.size() / 2), std::string()}) {
    write_all(entry, bad);
    EXPECT_EQ(compiled(), first);
    EXPECT_EQ(read_all(entry), whole);
  }
}

TEST_F(ShaderCacheTest, IsNotNeeded) {
  write_all(folder.path / "file", "not a folder");
  DeviceConfig config = this->config();
  config.cache_folder = (folder.path / "file").string();
  const auto first = compiled();
  device = open_device(config);
  EXPECT_EQ(compiled(), first);
}

TEST_F(GpuTest, PipelineCacheThatHasNotGrownIsNotWritten) {
  open();
  device.reset();
  EXPECT_THAT(files_of(folder.path, ".pipelines"), IsEmpty());
}

TEST_F(GpuTest, PipelineCacheIsKeptOnClosingAndLoadedWhereItIsWhole) {
  const auto open_and_close = [&](std::size_t loaded) {
    open();
    // Some drivers' caches never grow: say that it was loaded with fewer bytes.
    device->pipeline_cache_bytes = std::min(loaded, device->pipeline_cache_bytes);
    device.reset();
  };
  open_and_close(0);
  const auto kept = files_of(folder.path, ".pipelines");
  ASSERT_THAT(kept, SizeIs(1));
  const auto content = read_cached(folder.path, kept[0].filename());
  ASSERT_TRUE(content.has_value());
  EXPECT_GE(content->size(), 32u);  // Vulkan's header of pipeline caches
  const std::string whole = read_all(kept[0]);
  const auto time = fs::last_write_time(kept[0]);
  open_and_close(SIZE_MAX);
  EXPECT_EQ(fs::last_write_time(kept[0]), time) << "it has not grown";
  write_all(kept[0], whole.substr(0, whole.size() / 2));
  open_and_close(0);
  EXPECT_EQ(read_all(kept[0]).size(), whole.size()) << "a cut file is replaced";
}

}  // namespace
}  // namespace quincunx::gpu
