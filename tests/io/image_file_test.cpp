#include "io/image_file.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "tests/io/test_files.h"

namespace quincunx {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAreArray;

const std::vector<std::string> all_channels{
    "R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z", "cost.evaluations", "cost.steps", "cost.intervals"};

/// Values that differ in every pixel and channel, with an infinite depth and a few awkward ones.
Image numbered(int width, int height, std::vector<std::string> channels) {
  Image image{width, height, std::move(channels), {}};
  const std::size_t count = std::size_t(width) * std::size_t(height) * image.channels.size();
  for (std::size_t n = 0; n < count; ++n) image.pixels.push_back(float(n) / 7.0f - 3.0f);
  if (const int z = image.channel("Z"); z >= 0) image.pixels[std::size_t(z)] = std::numeric_limits<float>::infinity();
  image.pixels[0] = std::numeric_limits<float>::max();
  image.pixels[1] = std::numeric_limits<float>::denorm_min();
  return image;
}

class ImageFile : public FileTest {
 protected:
  /// The pixels of one linear R G B [A] value, written as PNG and read back as codes 0..255.
  std::vector<int> png_codes(std::vector<std::string> channels, std::vector<float> pixels) {
    const int width = int(pixels.size() / channels.size());
    write_image({width, 1, std::move(channels), std::move(pixels)}, path("i.png"));
    std::vector<int> codes;
    for (const float v : read_image(path("i.png")).pixels) codes.push_back(int(std::lround(v * 255.0f)));
    return codes;
  }
};

TEST_F(ImageFile, EveryExrChannelComesBackUnderItsNameBitForBit) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(7, 3), std::pair(64, 40)}) {
    const Image image = numbered(width, height, all_channels);
    write_image(image, path("i.exr"));
    const Image again = read_image(path("i.exr"));
    EXPECT_EQ(again.width, width);
    EXPECT_EQ(again.height, height);
    EXPECT_THAT(again.channels, UnorderedElementsAreArray(all_channels));
    ASSERT_EQ(again.pixels.size(), image.pixels.size());
    for (const std::string& name : all_channels) {
      const auto to = std::size_t(image.channel(name)), from = std::size_t(again.channel(name));
      for (std::size_t p = 0; p < image.pixels.size(); p += all_channels.size()) {
        ASSERT_EQ(again.pixels[p + from], image.pixels[p + to]) << name << " pixel " << p / all_channels.size();
      }
    }
  }
}

TEST_F(ImageFile, TheSameImageMakesTheSameBytesLater) {
  const Image image = numbered(20, 20, all_channels);
  write_image(image, path("first.exr"));
  write_image(image, path("first.png"));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // the formats keep times in seconds
  write_image(image, path("later.exr"));
  write_image(image, path("later.png"));
  EXPECT_TRUE(bytes_of(path("first.exr")) == bytes_of(path("later.exr")));
  EXPECT_TRUE(bytes_of(path("first.png")) == bytes_of(path("later.png")));
}

TEST_F(ImageFile, PngHoldsSrgbCodesOfTheLinearColours) {
  // sRGB of 0.5 is 0.7354 (187.5), of 0.001 is 0.01292 (3.3), of 0.2 is 0.4845 (123.5).
  EXPECT_THAT(png_codes({"R", "G", "B"}, {0.0f, 0.5f, 1.0f, 0.001f, 0.2f, 0.2140f}),
              ElementsAre(0, 188, 255, 3, 124, 127));
  EXPECT_THAT(png_codes({"R", "G", "B"}, {-1.0f, 2.0f, std::nanf("")}), ElementsAre(0, 255, 0));
}

TEST_F(ImageFile, PngHasStraightAlphaWhereTheImageHasAlpha) {
  // Colour 0.25 of opacity 0.5 is the straight colour 0.5; without opacity the colour stays.
  EXPECT_THAT(png_codes({"R", "G", "B", "A"}, {0.25f, 0.5f, 0.0f, 0.5f, 0.5f, 0.0f, 1.0f, 0.0f}),
              ElementsAre(188, 255, 0, 128, 188, 0, 255, 0));
  EXPECT_EQ(read_image(path("i.png")).channels.size(), 4u);
}

TEST_F(ImageFile, PngTakesTheColoursByNameAndLeavesOutTheRest) {
  EXPECT_THAT(png_codes({"Z", "B", "G", "R"}, {std::numeric_limits<float>::infinity(), 0.0f, 0.5f, 1.0f}),
              ElementsAre(255, 188, 0));
  EXPECT_THAT(error_of([&] { write_image({1, 1, {"R", "G"}, {0, 0}}, path("j.png")); }), HasSubstr("R, G and B"));
}

TEST_F(ImageFile, RowZeroIsAtTheTop) {
  for (const char* name : {"i.exr", "i.png"}) {
    write_image({1, 2, {"R", "G", "B"}, {1, 1, 1, 0, 0, 0}}, path(name));
    EXPECT_EQ(read_image(path(name)).pixels[0], 1.0f) << name;
    EXPECT_EQ(read_image(path(name)).pixels[3], 0.0f) << name;
  }
}

TEST_F(ImageFile, AnExtensionThatIsNotKnownIsRefusedEarlyAndLate) {
  const Image image = numbered(2, 2, {"R", "G", "B"});
  for (const char* name : {"i.jpg", "i", "i.exr.bak", ".png"}) {
    EXPECT_THAT(error_of([&] { check_image_path(path(name)); }), HasSubstr("expected .exr or .png")) << name;
    EXPECT_THAT(error_of([&] { write_image(image, path(name)); }), HasSubstr("expected .exr or .png")) << name;
  }
  EXPECT_NO_THROW(check_image_path(path("i.PNG")));
  EXPECT_EQ(file_count(), 0);
}

TEST_F(ImageFile, APlaceThatCannotBeWrittenIsRefusedEarlyAndLateAndNothingIsLeft) {
  const Image image = numbered(2, 2, {"R", "G", "B"});
  std::filesystem::create_directory(path("folder.png"));
  for (const char* name : {"missing/i.exr", "missing/i.png", "folder.png"}) {
    EXPECT_THAT(error_of([&] { check_image_path(path(name)); }), HasSubstr(path(name) + ": cannot be written"));
    EXPECT_THAT(error_of([&] { write_image(image, path(name)); }), HasSubstr(path(name) + ": cannot be written"));
  }
  EXPECT_EQ(file_count(), 1);
}

TEST_F(ImageFile, AnImageThatIsNoneIsRefusedAndTheOldFileStays) {
  file("i.exr", "old");
  for (const Image& image : {Image{0, 0, {"R"}, {}}, Image{2, 2, {"R"}, {1, 2, 3}}, Image{-2, -2, {"R"}, {1, 2, 3, 4}},
                             Image{1, 1, {}, {}}}) {
    EXPECT_THROW(write_image(image, path("i.exr")), InputError);
  }
  EXPECT_EQ(bytes_of(path("i.exr")), "old");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(ImageFile, AFileThatIsNoImageIsRefusedNamingIt) {
  EXPECT_THAT(error_of([&] { read_image(path("missing.png")); }),
              HasSubstr("missing.png: cannot be read: No such file"));
  EXPECT_THAT(error_of([&] { read_image(path("")); }), HasSubstr("a folder"));
  EXPECT_THAT(error_of([&] { read_image(file("i.png", "junk")); }),
              AllOf(HasSubstr(path("i.png")), HasSubstr("cannot be read")));
  write_image(numbered(30, 30, all_channels), path("i.exr"));
  const std::string half = bytes_of(path("i.exr")).substr(0, 2000);
  EXPECT_THAT(error_of([&] { read_image(file("h.exr", half)); }),
              AllOf(HasSubstr(path("h.exr")), HasSubstr("cannot be read")));
}

}  // namespace
}  // namespace quincunx
