#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "lattice/error.h"
#include "render/color_space.h"
#include "render/transfer_function.h"

namespace quincunx {
namespace {

using testing::HasSubstr;

class TransferFunctionFile : public ::testing::Test {
 protected:
  TransferFunction read(const std::string& text) {
    std::filesystem::remove(path_);  // a file written over is slow to close
    std::ofstream(path_, std::ios::binary) << text;
    return read_transfer_function(path_);
  }
  /// The message, which names the file and is one line; "no error" where there is none.
  std::string error(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& caught) {
      const std::string message = caught.what();
      EXPECT_THAT(message, HasSubstr(path_));
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_LT(message.size(), 500u);
      return message;
    }
    return "no error";
  }
  ~TransferFunctionFile() override { std::filesystem::remove(path_); }

  const std::string path_ = ::testing::TempDir() + "quincunx_" + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".json";
  const std::string whole_ = R"({"unit":2.5,"colors":[[0,"#Ff0000"],[90,0.25,0.5,1]],"opacities":[[-1e1,0],[40,0.125],[95,1]]})";
  const std::string map_ = R"([{"Name":"none"},{"ColorSpace":"RGB","Creator":"x","NanColor":[0,0,0],"Name":"two","Points":[0,0,0.5,0,5,1,0.5,0],)"
                           R"("RGBPoints":[0,0,0,0,2,1,0.5,0]},{"RGBPoints":"broken, but never looked at"}])";
};

TEST_F(TransferFunctionFile, HoldsColoursOpacitiesAndAUnit) {
  const TransferFunction f = read(whole_);
  EXPECT_EQ(f.unit, 2.5);
  ASSERT_EQ(f.colors.size(), 2u);
  EXPECT_EQ(f.colors[0].value, 0.0);
  EXPECT_EQ(f.colors[0].color, glm::dvec3(1, 0, 0));
  EXPECT_EQ(f.colors[1].color, glm::dvec3(0.25, 0.5, 1));
  ASSERT_EQ(f.opacities.size(), 3u);
  EXPECT_EQ(f.opacities[0].value, -10.0);
  EXPECT_EQ(f.opacities[1].opacity, 0.125);
}

TEST_F(TransferFunctionFile, MayLeaveOutTheUnitHaveOneColourAndNoOpacityAtAll) {
  const TransferFunction f = read(R"({"colors":[[3,"#ffffff"]],"opacities":[[0,0],[1,0]]})");
  EXPECT_EQ(f.unit, 0.0);
  EXPECT_EQ(f.color(-100.0), glm::dvec3(1.0));
  EXPECT_EQ(f.opacity(0.5), 0.0);
}

TEST_F(TransferFunctionFile, ReadsTheFirstOfParaViewsMapsThatHasColours) {
  const TransferFunction f = read(map_);
  EXPECT_EQ(f.unit, 0.0);
  EXPECT_EQ(f.low(), 0.0);
  EXPECT_EQ(f.high(), 5.0);
  EXPECT_EQ(f.opacity(2.5), 0.5);
  // Half way to 1 and 0.5 in sRGB.
  EXPECT_NEAR(f.color(1.0).r, linear_from_srgb(glm::dvec3(0.5)).r, 1e-3);
  EXPECT_NEAR(f.color(1.0).g, linear_from_srgb(glm::dvec3(0.25)).g, 1e-3);
}

TEST_F(TransferFunctionFile, WithoutPointsGrowsOpaqueOverItsColours) {
  const TransferFunction f = read(R"([{"RGBPoints":[-1,0,0,0,0,1,1,1,3,1,0,0]}])");
  EXPECT_EQ(f.opacity(-1.0), 0.0);
  EXPECT_EQ(f.opacity(1.0), 0.5);
  EXPECT_EQ(f.opacity(7.0), 1.0);
}

TEST_F(TransferFunctionFile, KeepsToParaViewsColoursBetweenItsPoints) {
  const std::vector<glm::dvec3> colors{{0.23, 0.3, 0.75}, {0.71, 0.016, 0.15}, {0, 0, 0}, {1, 1, 1}, {0, 1, 0}, {1, 0, 0.1}, {1, 0, 0.1}};
  std::string points;
  for (std::size_t n = 0; n < colors.size(); ++n)
    points += (n ? "," : "") + std::to_string(n) + "," + std::to_string(colors[n].r) + "," + std::to_string(colors[n].g) + "," + std::to_string(colors[n].b);
  const std::vector<std::pair<std::string, ColorSpace>> spaces{
      {R"("RGB")", ColorSpace::rgb},        {R"("HSV")", ColorSpace::hsv},       {R"("HSV","HSVWrap":1)", ColorSpace::hsv_wrap},
      {R"("HSV","HSVWrap":true)", ColorSpace::hsv_wrap}, {R"("HSV","HSVWrap":0)", ColorSpace::hsv}, {R"("Lab")", ColorSpace::lab},
      {R"("CIELAB")", ColorSpace::lab},     {R"("Diverging")", ColorSpace::diverging}, {R"("Step")", ColorSpace::step}};
  for (const auto& [name, space] : spaces) {
    const TransferFunction f = read(R"([{"ColorSpace":)" + name + R"(,"RGBPoints":[)" + points + "]}]");
    EXPECT_LT(f.colors.size(), 2000u);
    for (int n = 0; n <= 6000; ++n) {
      const double value = n / 1000.0;
      const std::size_t k = std::min(std::size_t(value), colors.size() - 2);
      const glm::dvec3 expected = interpolate(space, colors[k], colors[k + 1], value - double(k));
      const glm::dvec3 error = glm::abs(srgb_from_linear(f.color(value)) - expected);
      EXPECT_LT(std::max({error.r, error.g, error.b}), 1.0 / 512.0) << name << " at " << value;
    }
  }
}

TEST_F(TransferFunctionFile, CutAnywhereIsAnErrorThatSaysWhere) {
  for (const std::string& text : {whole_, map_})
    for (std::size_t n = 0; n < text.size(); ++n) EXPECT_THAT(error(text.substr(0, n)), HasSubstr("not JSON from byte " + std::to_string(n + 1))) << n;
}

TEST_F(TransferFunctionFile, WithAnyByteDamagedIsReadOrRefused) {
  for (const std::string& text : {whole_, map_})
    for (std::size_t n = 0; n < text.size(); ++n)
      for (const char byte : {'\xff', '[', '9'}) {
        std::string damaged = text;
        damaged[n] = byte;
        error(damaged);
      }
}

TEST_F(TransferFunctionFile, OfOurFormErrorsNameWhatWasFoundAndExpected) {
  const std::string colors = R"("colors":[[0,"#000000"],[1,"#ffffff"]])", opacities = R"("opacities":[[0,0],[1,1]])";
  const auto with = [&](const std::string& more) { return error("{" + colors + "," + opacities + "," + more + "}"); };
  const auto with_colors = [&](const std::string& list) { return error("{\"colors\":" + list + "," + opacities + "}"); };
  const auto with_opacities = [&](const std::string& list) { return error("{" + colors + ",\"opacities\":" + list + "}"); };
  EXPECT_EQ(error("{" + colors + "," + opacities + "}"), "no error");
  EXPECT_THAT(error("{" + colors + "}"), HasSubstr(": key \"opacities\" is missing"));
  EXPECT_THAT(error("{" + opacities + "}"), HasSubstr(": key \"colors\" is missing"));
  EXPECT_THAT(with(R"("colours":[])"), HasSubstr("unknown key \"colours\"; expected unit, colors, opacities"));
  EXPECT_THAT(with(colors), HasSubstr("key \"colors\" stands twice"));
  for (const std::string unit : {"0", "-1", "null", "\"1\"", "[1]", "true"})
    EXPECT_THAT(with("\"unit\":" + unit), HasSubstr("\"unit\"")) << unit;
  EXPECT_THAT(with(R"("unit":1e999)"), HasSubstr("not JSON"));
  EXPECT_THAT(with(R"("unit":NaN)"), HasSubstr("not JSON"));
  EXPECT_THAT(with_colors("[]"), HasSubstr("\"colors\" has 0 points; expected 1 to 65536"));
  EXPECT_THAT(with_colors("7"), HasSubstr("\"colors\" is 7; expected a list of points"));
  EXPECT_THAT(with_colors("[[]]"), HasSubstr("point 0 of \"colors\" is []"));
  EXPECT_THAT(with_colors("[[0,1,1]]"), HasSubstr("expected [value, \"#rrggbb\"] or [value, r, g, b]"));
  EXPECT_THAT(with_colors("[[0,0,0,1.5]]"), HasSubstr("point 0 of \"colors\" holds 1.5; expected a number from 0 to 1"));
  EXPECT_THAT(with_colors("[[0,0,0,null]]"), HasSubstr("holds null; expected a finite number"));
  for (const std::string name : {"\"red\"", "\"#12345\"", "\"#12345g\"", "\"#-12345\"", "\"#1234567\"", "null"})
    EXPECT_THAT(with_colors("[[0," + name + "]]"), HasSubstr("expected \"#rrggbb\"")) << name;
  EXPECT_THAT(with_colors(R"([[1,"#000000"],[0,"#000000"]])"), HasSubstr("point 1 of \"colors\" has the value 0 after 1; expected ascending"));
  EXPECT_THAT(with_opacities("[[0,0],[0,1]]"), HasSubstr("point 1 of \"opacities\" has the value 0 after 0"));
  EXPECT_THAT(with_opacities("[[0,1]]"), HasSubstr("\"opacities\" has 1 point; expected 2 to 65536"));
  EXPECT_THAT(with_opacities("[[0,0],[1,1,1]]"), HasSubstr("point 1 of \"opacities\" is [1,1,1]; expected [value, opacity]"));
  EXPECT_THAT(with_opacities("[[0,0],[1,-0.1]]"), HasSubstr("holds -0.1"));
  EXPECT_THAT(with_opacities("[[0,0],[1e300,1]]"), HasSubstr("has the value 1e+300"));
  EXPECT_THAT(with_opacities("{\"0\":1}"), HasSubstr("expected a list of points"));
  EXPECT_THAT(error("3"), HasSubstr("a JSON number; expected an object"));
}

TEST_F(TransferFunctionFile, OfParaViewErrorsNameWhatWasFoundAndExpected) {
  const auto with = [&](const std::string& members) { return error("[{" + members + "}]"); };
  const std::string colors = R"("RGBPoints":[0,0,0,0,1,1,1,1])";
  EXPECT_EQ(with(colors), "no error");
  EXPECT_THAT(error("[]"), HasSubstr("a list of 0 without \"RGBPoints\""));
  EXPECT_THAT(error("[1,[2],{}]"), HasSubstr("a list of 3 without \"RGBPoints\""));
  EXPECT_THAT(with(R"("RGBPoints":[0,0,0,0,1,1,1])"), HasSubstr("\"RGBPoints\" has 7 numbers; expected a list of four numbers a point"));
  EXPECT_THAT(with(R"("RGBPoints":{})"), HasSubstr("\"RGBPoints\" is {}"));
  EXPECT_THAT(with(R"("RGBPoints":[0,0,0,0])"), HasSubstr("\"RGBPoints\" has 1 point; expected 2"));
  EXPECT_THAT(with(R"("RGBPoints":[0,0,0,0,1,255,0,0])"), HasSubstr("point 1 of \"RGBPoints\" holds 255"));
  EXPECT_THAT(with(R"("RGBPoints":[0,0,0,0,1,null,0,0])"), HasSubstr("holds null"));
  EXPECT_THAT(with(R"("RGBPoints":[1,0,0,0,1,1,0,0])"), HasSubstr("point 1 of \"RGBPoints\" has the value 1 after 1"));
  EXPECT_THAT(with(colors + R"(,"ColorSpace":"Lab/CIEDE2000")"), HasSubstr("\"ColorSpace\" is \"Lab/CIEDE2000\"; expected RGB"));
  EXPECT_THAT(with(colors + R"(,"ColorSpace":3)"), HasSubstr("\"ColorSpace\" is 3"));
  EXPECT_THAT(with(colors + R"(,"Points":[0,0,0.5,0])"), HasSubstr("\"Points\" has 1 point; expected 2"));
  EXPECT_THAT(with(colors + R"(,"Points":[0,0,0.5,0,1,1,0.4,0])"), HasSubstr("point 1 of \"Points\" has the midpoint 0.4 and the sharpness 0"));
  EXPECT_THAT(with(colors + R"(,"Points":[0,0,0.5,0.1,1,1,0.5,0])"), HasSubstr("the sharpness 0.1; expected 0.5 and 0"));
  EXPECT_THAT(with(colors + R"(,"Points":[1,0,0.5,0,0,1,0.5,0])"), HasSubstr("point 1 of \"Points\" has the value 0 after 1"));
  EXPECT_THAT(with(colors + R"(,"Points":[0,0,0.5,0,1,2,0.5,0])"), HasSubstr("holds 2"));
}

TEST_F(TransferFunctionFile, OfAnySizeOrDepthIsRefusedInLittleMemory) {
  for (const std::string open : {"[", "{\"a\":"}) {
    std::string deep;
    for (int n = 0; n < 2000000; ++n) deep += open;
    EXPECT_THAT(error(deep), HasSubstr("lists in lists over 16 levels"));
  }
  std::string many = "[0";
  for (int n = 0; n < 1100000; ++n) many += ",0";
  EXPECT_THAT(error(many + "]"), HasSubstr("more than 1048576 values"));
  std::string points = R"({"opacities":[[0,0],[1,1]],"colors":[[0,0,0,0])";
  for (int n = 1; n < 65537; ++n) points += ",[" + std::to_string(n) + ",0,0,0]";
  EXPECT_THAT(error(points + "]}"), HasSubstr("\"colors\" has 65537 points; expected 1 to 65536"));
  const std::string quoted = R"({"colors":[[0,")" + std::string(1 << 20, 'x') + R"("]],"opacities":[[0,0],[1,1]]})";
  EXPECT_THAT(error(quoted), HasSubstr("xxx ...; expected \"#rrggbb\""));
  error(R"({"colors":)" + std::string(1 << 20, 'x'));
  { std::ofstream(path_, std::ios::binary) << ""; }
  std::filesystem::resize_file(path_, (std::uintmax_t(64) << 20) + 1);  // all zeros, and a hole on the disk
  try {
    read_transfer_function(path_);
    FAIL() << "no error";
  } catch (const InputError& caught) {
    EXPECT_THAT(std::string(caught.what()), HasSubstr("67108865 bytes; expected a transfer function of at most 67108864"));
  }
}

TEST(TransferFunctionFiles, OfTheDataFolderAreGood) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(QUINCUNX_SOURCE_DIR "/data/transfer"))
    if (entry.path().extension() == ".json") {
      EXPECT_NO_THROW(read_transfer_function(entry.path().string())) << entry.path();
      ++files;
    }
  EXPECT_GT(files, 0);
}

TEST(TransferFunctionFiles, ThatAreNotThereOrNoFilesAreErrors) {
  EXPECT_THROW(read_transfer_function("/nowhere/f.json"), InputError);
  EXPECT_THROW(read_transfer_function(::testing::TempDir()), InputError);
}

}  // namespace
}  // namespace quincunx
