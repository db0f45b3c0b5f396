#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/volume_file.h"
#include "tests/io/read_twice.h"
#include "tests/io/test_files.h"

namespace quincunx {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// The bytes of samples, in either order.
template <class T>
std::string packed(const std::vector<T>& samples, std::endian order) {
  std::string bytes;
  for (const T& s : samples) {
    std::string one(sizeof s, '\0');
    std::memcpy(one.data(), &s, sizeof s);
    bytes += order == std::endian::native ? one : std::string(one.rbegin(), one.rend());
  }
  return bytes;
}

std::string header(const std::string& type, std::size_t count, const std::string& lines) {
  return "NRRD0001\ntype: " + type + "\ndimension: 3\nsizes: " + std::to_string(count) + " 1 1\n" + lines + "\n";
}

class NrrdSamples : public FileTest {
 protected:
  template <class T>
  std::vector<T> read(std::string_view bytes) {
    return std::get<std::vector<T>>(read_twice(file("v.nrrd", bytes)).samples);
  }
  std::string refusal(std::string_view bytes) {
    const std::string message = error_of([&] { read_twice(file("v.nrrd", bytes)); });
    EXPECT_THAT(message, HasSubstr(path("v.nrrd")));
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  }

  /// Every encoding and byte order gives these samples back.
  template <class T>
  void expect_read(const std::string& type, const std::vector<T>& samples, const std::string& text) {
    for (const auto& [name, order] : {std::pair("little", std::endian::little), std::pair("big", std::endian::big)}) {
      const std::string endian = std::string("endian: ") + name + "\n";
      const std::string bytes = packed(samples, order);
      EXPECT_EQ(read<T>(header(type, samples.size(), endian + "encoding: raw\n") + bytes), samples) << type << name;
      EXPECT_EQ(read<T>(header(type, samples.size(), endian + "encoding: gzip\n") + gzipped(bytes)), samples);
    }
    EXPECT_EQ(read<T>(header(type, samples.size(), "encoding: ascii\n") + text), samples) << type;
  }
};

TEST_F(NrrdSamples, EveryTypeEncodingAndByteOrderIsRead) {
  expect_read<std::uint8_t>("uchar", {0, 1, 128, 255}, "0 1\n128\t255\n");
  expect_read<std::int16_t>("short", {-32768, -1, 258, 32767}, "-32768 -1, +258,32767");
  expect_read<std::uint16_t>("ushort", {0, 258, 32768, 65535}, "\n0 258 32768 65535\r\n");
  const float tiny = std::numeric_limits<float>::denorm_min();
  expect_read<float>("float", {-0.1f, 3.4028235e38f, tiny, std::numeric_limits<float>::infinity(), 0.0f},
                     "-0.1 3.4028235e38 1e-45 inf 1e-60 ");
}

TEST_F(NrrdSamples, NotANumberIsReadAsItIs) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto raw =
      read<float>(header("float", 2, "endian: big\nencoding: raw\n") + packed<float>({nan, 1}, std::endian::big));
  EXPECT_TRUE(std::isnan(raw[0]));
  EXPECT_EQ(raw[1], 1.0f);
  EXPECT_TRUE(std::isnan(read<float>(header("float", 1, "encoding: txt\n") + "NaN")[0]));
}

TEST_F(NrrdSamples, AVolumeLargerThanABlockIsReadInEveryEncodingWithProgress) {
  std::vector<std::uint16_t> samples(1'300'001);
  std::string text;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    samples[n] = std::uint16_t(n * 40503u);
    text += std::to_string(samples[n]) += ' ';
  }
  const std::string bytes = packed(samples, std::endian::big);
  for (const std::string& data : {"endian: big\nencoding: raw\n\n" + bytes,
                                  "endian: big\nencoding: gzip\n\n" + gzipped(bytes), "encoding: ascii\n\n" + text}) {
    std::vector<double> fractions;
    std::string head = header("ushort", samples.size(), "");
    head.pop_back();
    const Volume v = read_volume(file("v.nrrd", head + data), [&](double fraction) { fractions.push_back(fraction); });
    EXPECT_TRUE(std::get<std::vector<std::uint16_t>>(v.samples) == samples);
    ASSERT_GE(fractions.size(), 3u);
    EXPECT_EQ(fractions.front(), 0.0);
    EXPECT_EQ(fractions.back(), 1.0);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  }
}

TEST_F(NrrdSamples, AnInterruptFromProgressIsLetThrough) {
  const std::string path = file("v.nrrd", header("uchar", 2, "encoding: raw\n") + "ab");
  EXPECT_THROW(read_volume(path, [](double) { throw Interrupted(); }), Interrupted);
}

TEST_F(NrrdSamples, RawDataAreNeitherShorterNorLongerThanTheSizesSay) {
  const std::string head = header("short", 2, "endian: big\nencoding: raw\n");
  EXPECT_THAT(read<std::int16_t>(head + "aabb"), ElementsAre('a' * 257, 'b' * 257));
  EXPECT_THAT(refusal(head + "aab"), HasSubstr("found 3 bytes of samples, expected 4"));
  EXPECT_THAT(refusal(head + "aabb\n"), HasSubstr("found 5 bytes of samples, expected 4"));
}

TEST_F(NrrdSamples, GzipDataAreNeitherShorterNorLongerAndUndamaged) {
  const std::string head = header("uchar", 4, "encoding: gzip\n");
  EXPECT_THAT(read<std::uint8_t>(head + gzipped("abcd")), ElementsAre('a', 'b', 'c', 'd'));
  // RFC 1952: a file may have several members, which unpack to their concatenation.
  EXPECT_THAT(read<std::uint8_t>(head + gzipped("a") + gzipped("") + gzipped("bcd")), ElementsAre('a', 'b', 'c', 'd'));
  EXPECT_THAT(refusal(head + gzipped("abc")), HasSubstr("found 3 bytes of samples, expected 4"));
  EXPECT_THAT(refusal(head + gzipped("abcde")), HasSubstr("found more than 4 bytes of samples, expected 4"));
  EXPECT_THAT(refusal(head + gzipped("abcd") + gzipped("e")), HasSubstr("expected 4"));
  EXPECT_THAT(refusal(head + gzipped("abcd") + "junk"), HasSubstr("expected a gzip stream"));
  EXPECT_THAT(refusal(head + "not gzip at all"), HasSubstr("expected a gzip stream"));
  std::string damaged = gzipped("abcd");
  damaged[damaged.size() - 6] ^= 1;  // in the checksum
  EXPECT_THAT(refusal(head + damaged), HasSubstr("incorrect data check"));
}

TEST_F(NrrdSamples, AsciiDataAreJustAsManyNumbersOfTheType) {
  const std::string head = header("uchar", 3, "encoding: ascii\n");
  EXPECT_THAT(refusal(head + "1 2"), HasSubstr("2 numbers"));
  EXPECT_THAT(refusal(head + "1 2       "), HasSubstr("found 2 numbers, expected 3"));
  EXPECT_THAT(refusal(head + "1 2 3 4"), HasSubstr("found more numbers, expected 3"));
  for (const char* word : {"256", "-1", "1.5", "0x10", "two", "1e2", "+-1", "+", "nan"}) {
    EXPECT_THAT(refusal(head + "1 " + word + " 3"),
                AllOf(HasSubstr("sample 1 is '" + std::string(word)), HasSubstr("uint8")));
  }
  EXPECT_THAT(refusal(header("float", 2, "encoding: ascii\n") + "1 1e39"), HasSubstr("sample 1 is '1e39'"));
  EXPECT_THAT(refusal(header("uchar", 1, "encoding: ascii\n") + std::string(3 << 20, '1')),
              HasSubstr("sample 0 is '111"));
}

TEST_F(NrrdSamples, SizesAreCheckedAgainstTheLengthOfTheFileBeforeAnythingIsAllocated) {
  // 2^40 samples, and just beyond what could be packed into the bytes that there are.
  const std::size_t huge = std::size_t(1) << 40;
  EXPECT_THAT(refusal(header("float", huge, "endian: little\nencoding: raw\n") + "abcd"),
              HasSubstr("expected 4398046511104"));
  EXPECT_THAT(refusal(header("float", huge, "endian: little\nencoding: gzip\n") + gzipped("abcd")),
              HasSubstr("4398046511104"));
  EXPECT_THAT(refusal(header("float", huge, "encoding: ascii\n") + "1 2 3"), HasSubstr("1099511627776"));
  const std::string stream = gzipped("abcd");
  EXPECT_THAT(refusal(header("uchar", stream.size() * 1032 + 1, "encoding: gzip\n") + stream),
              HasSubstr("stream of at most"));
  EXPECT_THAT(refusal(header("uchar", stream.size() * 1032, "encoding: gzip\n") + stream), HasSubstr("found 4 bytes"));
}

TEST_F(NrrdSamples, WhatDeflatePacksBestIsStillRead) {
  // 8 MiB of zeros shrink by 1028: near the bound of 1032.
  const std::string zeros(8 << 20, '\0'), stream = gzipped(zeros);
  ASSERT_GT(zeros.size() / stream.size(), 1000u);
  EXPECT_EQ(read<std::uint8_t>(header("uchar", zeros.size(), "encoding: gzip\n") + stream).size(), zeros.size());
}

TEST_F(NrrdSamples, ADetachedHeaderFindsItsDataBesideIt) {
  file("v.raw", "abc");
  const auto samples = [&](const std::string& lines) {
    return std::get<std::vector<std::uint8_t>>(read_twice(file("v.nhdr", header("uchar", 3, lines))).samples);
  };
  EXPECT_THAT(samples("encoding: raw\ndata file: v.raw\n"), ElementsAre('a', 'b', 'c'));
  file("v.raw.gz", gzipped("abc"));
  EXPECT_THAT(samples("encoding: gz\ndatafile: ./v.raw.gz\n"), ElementsAre('a', 'b', 'c'));
  std::filesystem::create_directory(path("data of mine"));
  file("data of mine/v.txt", "97 98 99\n");
  EXPECT_THAT(samples("encoding: text\ndata file: data of mine/v.txt\n"), ElementsAre('a', 'b', 'c'));

  EXPECT_THAT(error_of([&] { samples("encoding: raw\ndata file: w.raw\n"); }),
              HasSubstr(path("w.raw") + ": cannot be read"));
  EXPECT_THAT(error_of([&] { samples("encoding: raw\ndata file: data of mine\n"); }), HasSubstr("a folder"));
  EXPECT_THAT(error_of([&] { samples("encoding: raw\ndata file: /dev/zero\n"); }), HasSubstr("a special file"));
  file("v.raw", "ab");
  EXPECT_THAT(error_of([&] { samples("encoding: raw\ndata file: v.raw\n"); }),
              HasSubstr(path("v.raw") + ": found 2 bytes"));
}

TEST_F(NrrdSamples, LinesAndBytesBeforeTheSamplesAreSkipped) {
  const auto samples = [&](const std::string& lines, const std::string& data) {
    return read<std::uint8_t>(header("uchar", 3, lines) + data);
  };
  const auto abc = ElementsAre('a', 'b', 'c');
  EXPECT_THAT(samples("encoding: raw\nline skip: 2\n", "one\n\nabc"), abc);
  EXPECT_THAT(samples("encoding: raw\nbyte skip: 2\n", "xxabc"), abc);
  EXPECT_THAT(samples("encoding: raw\nline skip: 1\nbyte skip: 2\n", "line\nxxabc"), abc);
  EXPECT_THAT(samples("encoding: raw\nbyte skip: -1\n", "anything\nabc"), abc);
  EXPECT_THAT(samples("encoding: gzip\nline skip: 1\nbyte skip: 2\n", "line\n" + gzipped("xxabc")), abc);
  EXPECT_THAT(samples("encoding: ascii\nline skip: 1\nbyte skip: 2\n", "line\nxx97 98 99"), abc);
  EXPECT_THAT(samples("encoding: raw\nline skip: 1\n", std::string(10'000, 'x') + "\nabc"), abc);

  EXPECT_THAT(refusal(header("uchar", 3, "encoding: raw\nline skip: 2\n") + "one\nabc"), HasSubstr("'line skip'"));
  EXPECT_THAT(refusal(header("uchar", 3, "encoding: raw\nbyte skip: 1\n") + "abc"), HasSubstr("found 2 bytes"));
  EXPECT_THAT(refusal(header("uchar", 3, "encoding: raw\nbyte skip: 9\n") + "abc"), HasSubstr("'byte skip'"));
  EXPECT_THAT(refusal(header("uchar", 3, "encoding: raw\nbyte skip: -1\n") + "ab"), HasSubstr("found 2 bytes"));
  EXPECT_THAT(refusal(header("uchar", 3, "encoding: gzip\nbyte skip: 9\n") + gzipped("abc")), HasSubstr("'byte skip'"));
  EXPECT_THAT(refusal(header("uchar", 3, "encoding: ascii\nbyte skip: 9\n") + "1 2 3"), HasSubstr("'byte skip'"));
}

TEST_F(NrrdSamples, AFileThatIsNoneIsRefused) {
  EXPECT_THAT(error_of([&] { read_twice(path("missing.nrrd")); }),
              HasSubstr("missing.nrrd: cannot be read: No such file"));
  EXPECT_THAT(error_of([&] { read_twice(path(".")); }), HasSubstr("a folder"));
  EXPECT_THAT(refusal(""), HasSubstr("the file is empty"));
}

}  // namespace
}  // namespace quincunx
