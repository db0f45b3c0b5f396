#include <limits>
#include <random>

#include "io/volume_file.h"
#include "tests/io/test_files.h"

namespace quincunx {
namespace {

using testing::HasSubstr;

// Sheared, left-handed, and with numbers that need all their digits.
const World world{{-106.121731, 1.0 / 3.0, 1e-9},
                  glm::dmat3(glm::dvec3(0.1, 0.0, 1e-17), glm::dvec3(1.0 / 7.0, -2.0, 0.0), glm::dvec3(0.0, 0.5, 4e5))};

template <class T>
std::vector<T> random_samples(std::size_t count) {
  std::mt19937 random(3);
  std::vector<T> samples(count);
  for (T& s : samples) s = T(random());
  return samples;
}

class VolumeWriter : public FileTest {
 protected:
  void expect_round_trip(const Volume& volume) {
    for (const Encoding encoding : {Encoding::raw, Encoding::gzip}) {
      write_volume(volume, path("v.nrrd"), encoding);
      const Volume again = read_volume(path("v.nrrd"));
      EXPECT_EQ(again.lattice, volume.lattice);
      EXPECT_EQ(again.extents, volume.extents);
      EXPECT_EQ(again.world.origin, volume.world.origin);
      EXPECT_EQ(again.world.axes, volume.world.axes);
      EXPECT_EQ(again.notes, volume.notes);
      EXPECT_EQ(again.samples, volume.samples);
      EXPECT_EQ(file_count(), 1);
    }
  }
};

TEST_F(VolumeWriter, EveryTypeComesBackOnBothLattices) {
  for (const LatticeKind lattice : {LatticeKind::bcc, LatticeKind::cartesian}) {
    const std::size_t count = std::size_t(coset_count(lattice)) * 3 * 4 * 5;
    expect_round_trip({lattice, {3, 4, 5}, world, random_samples<std::uint8_t>(count), {}});
    expect_round_trip({lattice, {3, 4, 5}, world, random_samples<std::int16_t>(count), {}});
    expect_round_trip({lattice, {3, 4, 5}, world, random_samples<std::uint16_t>(count), {}});
    expect_round_trip({lattice, {3, 4, 5}, world, random_samples<float>(count), {}});
    expect_round_trip({lattice, {1, 1, 1}, {}, random_samples<float>(std::size_t(coset_count(lattice))), {}});
  }
}

TEST_F(VolumeWriter, AVolumeLargerThanABlockComesBack) {
  expect_round_trip({LatticeKind::bcc, {100, 90, 80}, world, random_samples<std::uint16_t>(2 * 720'000), {}});
}

TEST_F(VolumeWriter, NotesComeBackWhateverStandsInThem) {
  Volume volume{LatticeKind::bcc, {1, 1, 1}, {}, std::vector<float>{1, 2}, {}};
  volume.notes = {{"content", "a head"},
                  {"space", "left-posterior-superior"},
                  {"license", "CC BY 4.0: see := and \\n"},
                  {"two", "lines\nof it"},
                  {"empty", ""},
                  {"a key: with a colon", "x"},
                  {"  spaces", "  kept "}};
  expect_round_trip(volume);
  volume.notes = {{"content", "two\nlines"}, {"space", "no space of the format"}};
  expect_round_trip(volume);
}

TEST_F(VolumeWriter, NotesThatAHeaderCannotHoldAreRefusedAndNothingIsWritten) {
  using Notes = std::vector<std::pair<std::string, std::string>>;
  for (const Notes& notes : {Notes{{"", "x"}}, Notes{{"a:=b", "x"}}, Notes{{"#a", "x"}}, Notes{{"type: short", "x"}},
                             Notes{{"lattice", "bcc"}}, Notes{{"a", "x"}, {"a", "y"}},
                             Notes{{"a", "ends in a return\r"}}, Notes{{"a", std::string(2 << 20, 'x')}}}) {
    const Volume volume{LatticeKind::cartesian, {1, 1, 1}, {}, std::vector<float>{1}, notes};
    EXPECT_THAT(error_of([&] { write_volume(volume, path("v.nrrd")); }), HasSubstr(path("v.nrrd")));
    EXPECT_EQ(file_count(), 0);
  }
}

TEST_F(VolumeWriter, TheHeaderOfABccVolumeIsThatOfTheConventions) {
  const Volume volume{
      LatticeKind::bcc, {1, 1, 1}, {{1, 2, 3}, glm::dmat3(0.5)}, std::vector<std::uint8_t>{'a', 'b'}, {{"k", "v"}}};
  write_volume(volume, path("v.nrrd"), Encoding::raw);
  EXPECT_EQ(bytes_of(path("v.nrrd")),
            "NRRD0004\ntype: uint8\ndimension: 4\nspace dimension: 3\nsizes: 1 1 1 2\n"
            "space directions: (1,0,0) (0,1,0) (0,0,1) none\nkinds: domain domain domain list\nendian: little\n"
            "encoding: raw\nspace origin: (1,2,3)\nlattice:=bcc\nk:=v\n\nab");
}

TEST_F(VolumeWriter, TheSameVolumeMakesTheSameBytes) {
  const Volume volume{LatticeKind::bcc, {20, 20, 20}, world, random_samples<std::int16_t>(16'000), {}};
  write_volume(volume, path("a.nrrd"));
  write_volume(volume, path("b.nrrd"));
  const std::string bytes = bytes_of(path("a.nrrd"));
  EXPECT_TRUE(bytes == bytes_of(path("b.nrrd")));
  const std::size_t stream = bytes.find("\n\n") + 2;
  EXPECT_EQ(bytes.substr(stream + 4, 4), std::string(4, '\0'));  // no time in the gzip header
}

TEST_F(VolumeWriter, AVolumeThatIsNoneIsRefusedAndNothingIsWritten) {
  const World flat{{}, glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 1, 0))};
  const World nowhere{{std::numeric_limits<double>::quiet_NaN(), 0, 0}, glm::dmat3(1.0)};
  for (const Volume& volume : {Volume{LatticeKind::bcc, {1, 1, 1}, {}, std::vector<float>(1), {}},
                               Volume{LatticeKind::bcc, {0, 1, 1}, {}, std::vector<float>(), {}},
                               Volume{LatticeKind::bcc, {1, 1, 1}, flat, std::vector<float>(2), {}},
                               Volume{LatticeKind::bcc, {1, 1, 1}, nowhere, std::vector<float>(2), {}}}) {
    EXPECT_THAT(error_of([&] { write_volume(volume, path("v.nrrd")); }), HasSubstr(path("v.nrrd")));
    EXPECT_EQ(file_count(), 0);
  }
}

TEST_F(VolumeWriter, APlaceThatCannotBeWrittenIsRefused) {
  const Volume volume{LatticeKind::cartesian, {1, 1, 1}, {}, std::vector<float>{1}, {}};
  EXPECT_THAT(error_of([&] { write_volume(volume, path("missing/v.nrrd")); }),
              HasSubstr("missing/v.nrrd: cannot be written"));
  EXPECT_EQ(file_count(), 0);
}

TEST_F(VolumeWriter, AnInterruptLeavesTheOldFileAsItWas) {
  file("v.nrrd", "old");
  const Volume volume{LatticeKind::cartesian, {128, 128, 128}, {}, random_samples<std::uint8_t>(128 * 128 * 128), {}};
  for (const double stop : {0.0, 0.5, 1.0}) {
    EXPECT_THROW(write_volume(volume, path("v.nrrd"), Encoding::raw,
                              [&](double fraction) {
                                if (fraction >= stop) throw Interrupted();
                              }),
                 Interrupted);
    EXPECT_EQ(bytes_of(path("v.nrrd")), "old");
    EXPECT_EQ(file_count(), 1);
  }
}

}  // namespace
}  // namespace quincunx
