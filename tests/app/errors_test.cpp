// Bad input: status 2, exactly one line on standard error, nothing on standard output, nothing written.
#include <gtest/gtest.h>

#include <limits>

#include "io/volume_file.h"
#include "program.h"

namespace quincunx::test {
namespace {

/// A folder with a good BCC volume (bcc.nrrd), a Cartesian one (cartesian.nrrd) and one point (p.csv).
class Errors : public ProgramInFolder {
 protected:
  void SetUp() override {
    const auto ramp = [](const glm::dvec3& x) { return x.x + x.y; };
    write_volume(make_volume(LatticeKind::bcc, {4, 4, 4}, {}, ramp), bcc, Encoding::raw);
    write_volume(make_volume(LatticeKind::cartesian, {4, 4, 4}, {}, ramp), cartesian, Encoding::raw);
    write_file(points, "1,1,1\n");
  }

  /// `render` of `volume` at isovalue 3 to out.png with more arguments.
  Arguments render(const Arguments& more) const {
    Arguments arguments{"render", bcc, "-o", out, "--iso", "3", "--size", "8", "8"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  const std::string bcc = folder / "bcc.nrrd", cartesian = folder / "cartesian.nrrd", points = folder / "p.csv";
  const std::string out = folder / "out.png", missing = folder / "missing.nrrd";
};

TEST_F(Errors, NameAnUnknownSubCommandOrItsAbsence) {
  expect_refused({}, {"subcommand"});
  expect_refused({"rendr"}, {"rendr", "quincunx --help"});
}

TEST_F(Errors, NameAnUnknownFlag) {
  expect_refused({"info", bcc, "--jsn"}, {"'--jsn'", "quincunx info --help"});
  expect_refused(render({"--isovalue", "4"}), {"'--isovalue'", "quincunx render --help"});
}

TEST_F(Errors, NameAMissingArgument) {
  expect_refused({"info"}, {"VOLUME"});
  expect_refused({"sample", "sphere", out, "--lattice", "bcc"}, {"--dims"});
  expect_refused({"render", bcc, "-o", out}, {"--iso", "quincunx info"});
  expect_refused({"render", bcc, "--iso", "3"}, {"-o"});
}

TEST_F(Errors, NameAFileThatIsNotThere) {
  expect_refused({"info", missing}, {"missing.nrrd"});
  expect_refused({"eval", bcc, "--points", folder / "none.csv"}, {"none.csv"});
  expect_refused({"render", missing, "-o", out, "--iso", "3"}, {"missing.nrrd"});
  expect_refused(render({"--camera", folder / "none.json"}), {"none.json"});
}

TEST_F(Errors, NameAFileThatIsCutShort) {
  const std::string whole = read_file(bcc), cut = folder / "cut.nrrd";
  // Before, within and just after the header, and without the last byte.
  for (const std::size_t size : {std::size_t(0), std::size_t(20), whole.find("\n\n") + 2}) {
    write_file(cut, whole.substr(0, size));
    expect_refused({"info", cut}, {"cut.nrrd"});
  }
  write_file(cut, whole.substr(0, whole.size() - 1));
  expect_refused({"render", cut, "-o", out, "--iso", "3"}, {"cut.nrrd"});
}

TEST_F(Errors, NameAFileThatIsNoVolume) {
  const std::string text = folder / "text.nrrd", wrong = folder / "wrong.nrrd";
  write_file(text, "not a volume\n");
  expect_refused({"info", text}, {"text.nrrd"});
  std::string header = read_file(bcc);
  const std::size_t sizes = header.find("sizes: 4 4 4 2");
  ASSERT_NE(sizes, std::string::npos);
  write_file(wrong, header.replace(sizes, 14, "sizes: 9 9 9 2"));
  expect_refused({"info", wrong}, {"wrong.nrrd"});
  expect_refused({"info", folder / "."}, {"folder"});
}

TEST_F(Errors, NameAnUnknownLatticeMethodAndField) {
  expect_refused({"convert", cartesian, out, "--lattice", "fcc"}, {"--lattice", "'fcc'", "bcc"});
  expect_refused({"convert", cartesian, out, "--lattice", "bcc", "--method", "fit"}, {"--method", "'fit'", "subset"});
  expect_refused({"sample", "cube", out, "--lattice", "bcc", "--dims", "2", "2", "2"}, {"'cube'", "marschner-lobb"});
  expect_refused({"sample", "sphere", out, "--lattice", "hcp", "--dims", "2", "2", "2"}, {"--lattice", "'hcp'"});
}

TEST_F(Errors, NameSizesThatAreNone) {
  for (const std::string bad : {"0", "-1", "99999999999999999999"}) {
    expect_refused({"sample", "sphere", out, "--lattice", "bcc", "--dims", "2", bad, "2"}, {"--dims", "'" + bad + "'"});
  }
  expect_refused({"sample", "sphere", out, "--lattice", "bcc", "--dims", "2", "2"}, {"--dims"});
}

TEST_F(Errors, NameThePlaceOfSamplesThatAreNotFinite) {
  Volume volume = make_volume(LatticeKind::bcc, {2, 3, 4}, {}, [](const glm::dvec3& x) { return x.x; });
  // Coset 1, index (1, 2, 3): the last of 48.
  std::get<std::vector<float>>(volume.samples).back() = std::numeric_limits<float>::quiet_NaN();
  const std::string nan = folder / "nan.nrrd";
  write_volume(volume, nan);
  expect_refused({"render", nan, "-o", out, "--iso", "3"}, {"nan.nrrd", "1 NaN or infinite of 48", "coset 1, index (1, 2, 3)"});
  expect_refused({"eval", nan, "--points", points}, {"nan.nrrd"});
}

TEST_F(Errors, NameWhatSamplesThatAreNotFiniteCannotBeTakenAs) {
  for (const std::string bad : {"zero", "fill", "fill=", "fill=nan", "fill=inf", "fill=1e39", "0", "empty=0"})
    expect_refused(render({"--nan=" + bad}), {"--nan", "'" + (bad.starts_with("fill=") && bad != "fill=1e39" ? bad.substr(5) : bad) + "'"});
  expect_refused(render({"--nan", "empty", "--pool", "1M"}), {"--nan", "empty", "--pool", "fill=V"});
}

TEST_F(Errors, NameTheSplineOfAnotherLattice) {
  expect_refused({"eval", cartesian, "--points", points, "--spline", "bcc7"}, {"--spline", "cartesian", "bcc, the lattice of bcc7"});
  expect_refused({"eval", bcc, "--points", points, "--spline", "tricubic"}, {"--spline", "bcc", "cartesian, the lattice of tricubic"});
}

TEST_F(Errors, NameAFlagsBadValue) {
  expect_refused({"render", bcc, "-o", out, "--iso", "nan"}, {"--iso", "'nan'", "finite number"});
  expect_refused(render({"--skip", "quadtree"}), {"--skip", "'quadtree'", "auto, none, grid"});
  expect_refused({"eval", bcc, "--points", points, "--precision", "half"}, {"--precision", "'half'", "double, float"});
}

TEST_F(Errors, NameBothWaysWhereACameraIsGivenTwice) {
  expect_refused(render({"--zoom", "2", "--eye", "1", "2", "3"}), {"--zoom", "--eye"});
  expect_refused(render({"--eye", "1", "2", "3", "--target", "1", "2", "3"}), {"--eye"});
}

TEST_F(Errors, NameAPlaceThatCannotBeWritten) {
  const std::string nowhere = folder / "no/such/folder/out";
  expect_refused({"convert", cartesian, nowhere + ".nrrd", "--lattice", "bcc"}, {"no/such/folder"});
  expect_refused({"sample", "sphere", nowhere + ".nrrd", "--lattice", "bcc", "--dims", "2", "2", "2"},
                 {"no/such/folder"});
  expect_refused({"render", bcc, "-o", nowhere + ".png", "--iso", "3"}, {"no/such/folder"});
  expect_refused(render({"--stats", nowhere + ".json"}), {"no/such/folder"});
}

TEST_F(Errors, NameADeviceThatIsNotThere) {
  expect_refused(render({"--device", "no such device"}), {"no such device"});
  expect_refused(render({"--device", "4711"}), {"4711"});
}

}  // namespace
}  // namespace quincunx::test
