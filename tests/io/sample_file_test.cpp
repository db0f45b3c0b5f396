#include "io/sample_file.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <cstdlib>
#include <random>

#include "io/volume_file.h"
#include "tests/io/sparse_volume.h"
#include "tests/io/test_files.h"

namespace quincunx {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Random samples, of which the box read is a part.
template <class T>
Volume noise(LatticeKind lattice, const Extents& extents) {
  Volume v{lattice, extents, {{1, 2, 3}, glm::dmat3(0.5)}, std::vector<T>{}, {{"content", "noise"}}};
  std::mt19937 random(4);
  for (std::size_t n = 0; n < v.sample_count(); ++n) std::get<std::vector<T>>(v.samples).push_back(T(random() % 251));
  return v;
}

/// A header that says big endian, and the samples of `volume`, 5 x 4 x 3, in that order.
std::string big_endian_file(const Volume& volume) {
  std::string text = "NRRD0004\ntype: ushort\ndimension: 4\nsizes: 5 4 3 2\nendian: big\nencoding: raw\nlattice:=bcc\n\n";
  for (const std::uint16_t s : std::get<std::vector<std::uint16_t>>(volume.samples)) text += {char(s >> 8), char(s & 255)};
  return text;
}

class SampleFileTest : public FileTest {
 protected:
  /// Every box of `file` holds the samples of the volume.
  static void expect_boxes(const SampleFile& file, const Volume& volume) {
    const VolumeSource expected(volume);
    const Extents& n = volume.extents;
    std::mt19937 random(8);
    for (int box = 0; box < 200; ++box) {
      glm::i64vec3 low, high;
      for (int a = 0; a < 3; ++a) {
        low[a] = random() % 4 == 0 ? 0 : std::int64_t(random() % std::uint64_t(n[a]));
        high[a] = random() % 4 == 0 ? n[a] : low[a] + 1 + std::int64_t(random() % std::uint64_t(n[a] - low[a]));
      }
      const Volume found = file.read_box(low, high), wanted = expected.read_box(low, high);
      ASSERT_EQ(found.extents, wanted.extents);
      ASSERT_EQ(found.samples, wanted.samples) << "box " << box;
      ASSERT_EQ(found.world.origin, wanted.world.origin);
    }
  }
};

TEST_F(SampleFileTest, AnyBoxIsReadFromRawAndFromPackedFiles) {
  for (const LatticeKind lattice : {LatticeKind::cartesian, LatticeKind::bcc})
    for (const Encoding encoding : {Encoding::raw, Encoding::gzip}) {
      const Volume volume = noise<float>(lattice, {9, 7, 5});
      write_volume(volume, path("v.nrrd"), encoding);
      const SampleFile source(path("v.nrrd"), {});
      EXPECT_EQ(source.header().lattice, lattice);
      EXPECT_EQ(source.header().extents, volume.extents);
      EXPECT_EQ(source.header().type(), SampleType::float32);
      EXPECT_EQ(source.scratch_bytes(), encoding == Encoding::raw ? 0u : volume.sample_count() * 4);
      expect_boxes(source, volume);
    }
}

TEST_F(SampleFileTest, BoxesOfTheOtherByteOrderAreTurned) {
  const Volume volume = noise<std::uint16_t>(LatticeKind::bcc, {5, 4, 3});
  const SampleFile source(file("v.nrrd", big_endian_file(volume)), {});
  EXPECT_EQ(std::get<std::vector<std::uint16_t>>(source.read_box({1, 2, 0}, {4, 3, 2}).samples),
            std::get<std::vector<std::uint16_t>>(VolumeSource(volume).read_box({1, 2, 0}, {4, 3, 2}).samples));
}

TEST_F(SampleFileTest, RowsFarApartAndRowsCloseTogetherAreReadAlike) {
  const Volume volume = noise<std::uint8_t>(LatticeKind::cartesian, {10'000, 6, 3});
  write_volume(volume, path("v.nrrd"), Encoding::raw);
  const SampleFile source(path("v.nrrd"), {});
  // 4096 bytes between two rows are where reading all of them ends: 5904 wanted.
  for (const auto& [x0, x1] : {std::pair(10, 8'000), std::pair(10, 5'914), std::pair(10, 5'915), std::pair(9'999, 10'000)})
    EXPECT_EQ(source.read_box({x0, 1, 0}, {x1, 6, 3}).samples, VolumeSource(volume).read_box({x0, 1, 0}, {x1, 6, 3}).samples);
}

TEST_F(SampleFileTest, SeveralThreadsMayReadAtOnce) {
  const Volume volume = noise<std::int16_t>(LatticeKind::bcc, {20, 20, 20});
  write_volume(volume, path("v.nrrd"), Encoding::gzip);
  const SampleFile source(path("v.nrrd"), {});
  const VolumeSource expected(volume);
  std::atomic<int> wrong = 0;
  tbb::parallel_for(0, 400, [&](int n) {
    const glm::i64vec3 low(n % 17, n % 11, n % 13), high = low + std::int64_t(3);
    wrong += source.read_box(low, high).samples != expected.read_box(low, high).samples;
  });
  EXPECT_EQ(wrong, 0);
}

TEST_F(SampleFileTest, UnpackingLeavesNothingBehindAndTellsProgress) {
  const Volume volume = noise<float>(LatticeKind::cartesian, {100, 100, 30});
  write_volume(volume, path("v.nrrd"), Encoding::gzip);
  std::vector<double> fractions;
  {
    const SampleFile source(path("v.nrrd"), {path("")}, [&](double fraction) { fractions.push_back(fraction); });
    EXPECT_EQ(file_count(), 1) << "the scratch file has no name";
    EXPECT_EQ(source.read_box({0, 0, 0}, volume.extents).samples, volume.samples);
  }
  EXPECT_EQ(file_count(), 1);
  EXPECT_GE(fractions.size(), 3u);
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_THROW(SampleFile(path("v.nrrd"), {path("")}, [](double) { throw Interrupted(); }), Interrupted);
  EXPECT_EQ(file_count(), 1);
}

TEST_F(SampleFileTest, AScratchFolderThatCannotTakeTheSamplesIsNamed) {
  write_volume(noise<std::uint8_t>(LatticeKind::cartesian, {2, 2, 2}), path("v.nrrd"), Encoding::gzip);
  EXPECT_THAT(error_of([&] { SampleFile(path("v.nrrd"), {path("missing")}); }),
              AllOf(HasSubstr("--scratch: "), HasSubstr(path("missing")), HasSubstr("No such file")));
  // Numbers of four bytes, two of text each: more of them than fit the disk, which holds the first ones only.
  const std::uint64_t planes = (std::filesystem::space(path("")).available >> 22) + 1;
  std::string text = "NRRD0001\ntype: float\ndimension: 3\nsizes: 1024 1024 " + std::to_string(planes) + "\nencoding: ascii\n\n";
  for (int n = 0; n < 300'000; ++n) text += "1 ";
  const std::string huge = file("huge.nrrd", text);
  std::filesystem::resize_file(huge, text.size() + (planes << 21));
  EXPECT_THAT(error_of([&] { SampleFile(huge, {path("")}); }),
              AllOf(HasSubstr("--scratch: " + path("")), HasSubstr("GiB free"), HasSubstr(huge)));
  EXPECT_EQ(file_count(), 2);
}

TEST_F(SampleFileTest, AFileThatBecomesShorterIsAnError) {
  const Volume volume = noise<std::uint8_t>(LatticeKind::cartesian, {10, 10, 10});
  write_volume(volume, path("v.nrrd"), Encoding::raw);
  const SampleFile source(path("v.nrrd"), {});
  std::filesystem::resize_file(path("v.nrrd"), std::filesystem::file_size(path("v.nrrd")) - 500);
  EXPECT_NO_THROW(source.read_box({0, 0, 0}, {10, 10, 5}));
  EXPECT_THAT(error_of([&] { source.read_box({0, 0, 5}, {10, 10, 6}); }), HasSubstr(path("v.nrrd") + ": became shorter"));
}

TEST_F(SampleFileTest, SamplesBeyond4GiBAndBeyondNumber2To32AreFound) {
  // 5.4e9 samples a coset, 21.5 GB in all, of which a few blocks are on the disk.
  const Extents n(2100, 2000, 1280);
  SparseVolume sparse(LatticeKind::bcc, n, SampleType::uint16, path("v.nrrd"));
  const auto value = [](const glm::dvec3& u) { return 1.0 + u.x + u.y + u.z; };
  const glm::i64vec3 corner = n - std::int64_t(3);
  sparse.put(corner, n, value);
  sparse.put({1000, 1000, 1022}, {1003, 1002, 1025}, value);  // number 2^32 of the first coset is in plane 1022

  const SampleFile source(path("v.nrrd"), {});
  for (const glm::i64vec3& low : {corner, glm::i64vec3(1000, 1000, 1022)}) {
    const Volume box = source.read_box(low, low + glm::i64vec3(3, 2, 3));
    for (int coset = 0; coset < 2; ++coset)
      for (std::int64_t k = 0; k < 3; ++k)
        for (std::int64_t i = 0; i < 3; ++i)
          EXPECT_EQ(box.sample(coset, {i, 1, k}), value(glm::dvec3(std::int64_t(2) * (low + glm::i64vec3(i, 1, k)) + std::int64_t(coset))));
  }
  EXPECT_EQ(source.read_box({999, 1000, 1022}, {1000, 1001, 1023}).sample(0, {0, 0, 0}), 0.0);
}

}  // namespace
}  // namespace quincunx
