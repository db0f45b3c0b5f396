#include "io/nrrd_header.h"

#include "tests/io/test_files.h"

namespace quincunx {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

NrrdHeader parse(const std::string& text) { return interpret_nrrd(parse_nrrd_text(text, "v.nrrd")); }

/// A header with these lines after the magic; the empty line ends it.
std::string header(const std::string& lines) { return "NRRD0004\n" + lines + "\n"; }

/// A 3-D header with lines of its own beside the necessary ones.
std::string cartesian(const std::string& lines) {
  return header("type: float\ndimension: 3\nsizes: 3 4 5\nendian: little\nencoding: raw\n" + lines);
}

/// A 4-D header with lines of its own beside the necessary ones.
std::string bcc(const std::string& lines) {
  return header("type: uchar\ndimension: 4\nsizes: 3 4 5 2\nencoding: raw\nlattice:=bcc\n" + lines);
}

std::string refusal(const std::string& text) {
  const std::string message = error_of([&] { parse(text); });
  EXPECT_THAT(message, HasSubstr("v.nrrd"));
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  return message;
}

TEST(NrrdHeader, ASmallHeaderMeansUnitStepsFromTheOrigin) {
  const NrrdHeader h = parse(cartesian(""));
  EXPECT_EQ(h.lattice, LatticeKind::cartesian);
  EXPECT_EQ(h.extents, Extents(3, 4, 5));
  EXPECT_EQ(h.sample_count, 60u);
  EXPECT_EQ(h.type, SampleType::float32);
  EXPECT_EQ(h.encoding, NrrdEncoding::raw);
  EXPECT_EQ(h.world.axes, glm::dmat3(1.0));
  EXPECT_EQ(h.world.origin, glm::dvec3(0.0));
  EXPECT_EQ(h.data_offset, cartesian("").size());
}

TEST(NrrdHeader, EverySpellingOfTheFourTypesIsKnown) {
  const auto type_of = [](const std::string& type) {
    return parse(header("type: " + type + "\ndimension: 3\nsizes: 1 1 1\nendian: big\nencoding: raw\n")).type;
  };
  for (const char* t : {"uchar", "unsigned char", "uint8", "uint8_t", "UCHAR", "unsigned  char"})
    EXPECT_EQ(type_of(t), SampleType::uint8) << t;
  for (const char* t : {"short", "short int", "signed short", "signed short int", "int16", "int16_t"})
    EXPECT_EQ(type_of(t), SampleType::int16) << t;
  for (const char* t : {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"})
    EXPECT_EQ(type_of(t), SampleType::uint16) << t;
  EXPECT_EQ(type_of("float"), SampleType::float32);
  for (const char* t : {"double", "int", "signed char", "int8", "uint32", "long long", "block", "", "uint 8"}) {
    EXPECT_THAT(error_of([&] { type_of(t); }),
                AllOf(HasSubstr("v.nrrd: field 'type': found '" + std::string(t) + "'"), HasSubstr("ushort")));
  }
}

TEST(NrrdHeader, EverySpellingOfTheEncodingsIsKnown) {
  const auto encoding_of = [](const std::string& encoding) {
    return parse(header("type: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: " + encoding + "\n")).encoding;
  };
  EXPECT_EQ(encoding_of("raw"), NrrdEncoding::raw);
  for (const char* e : {"gzip", "gz", "GZip"}) EXPECT_EQ(encoding_of(e), NrrdEncoding::gzip);
  for (const char* e : {"ascii", "text", "txt"}) EXPECT_EQ(encoding_of(e), NrrdEncoding::ascii);
  for (const char* e : {"bzip2", "hex", ""}) {
    EXPECT_THAT(error_of([&] { encoding_of(e); }), HasSubstr("expected raw, gzip (gz) or ascii"));
  }
}

TEST(NrrdHeader, TheByteOrderIsNeededJustWhereItMatters) {
  const auto swap_of = [](const std::string& lines) {
    return parse(header("dimension: 3\nsizes: 1 1 1\n" + lines)).swap_bytes;
  };
  EXPECT_TRUE(swap_of("type: short\nencoding: raw\nendian: big\n"));
  EXPECT_FALSE(swap_of("type: short\nencoding: raw\nendian: little\n"));
  EXPECT_FALSE(swap_of("type: short\nencoding: ascii\n"));
  EXPECT_FALSE(swap_of("type: short\nencoding: ascii\nendian: big\n"));
  EXPECT_FALSE(swap_of("type: uchar\nencoding: raw\nendian: big\n"));
  EXPECT_THAT(error_of([&] { swap_of("type: short\nencoding: gzip\n"); }), HasSubstr("no field 'endian'"));
  EXPECT_THAT(error_of([&] { swap_of("type: short\nencoding: gzip\nendian: middle\n"); }), HasSubstr("'middle'"));
}

TEST(NrrdHeader, SpacingsAreTheVoxelStepsOfCartesianAndTwiceTheStepsOfBcc) {
  EXPECT_EQ(parse(cartesian("spacings: 0.5 -2 1e-1\n")).world.axes,
            glm::dmat3(glm::dvec3(0.5, 0, 0), glm::dvec3(0, -2, 0), glm::dvec3(0, 0, 0.1)));
  EXPECT_EQ(parse(bcc("spacings: 2 1 +6 nan\n")).world.axes,
            glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0.5, 0), glm::dvec3(0, 0, 3)));
}

TEST(NrrdHeader, SpaceDirectionsMayBeShearedAndNeedNoNamedSpace) {
  const std::string directions = "space directions: (1,0.5,0) ( 0 , 2 , 0 )(0,-1,4)";
  const glm::dmat3 steps(glm::dvec3(1, 0.5, 0), glm::dvec3(0, 2, 0), glm::dvec3(0, -1, 4));
  for (const char* space : {"", "space: left-posterior-superior\n", "space: RAS\n", "space dimension: 3\n"}) {
    const NrrdHeader h = parse(cartesian(space + directions + "\nspace origin: (-1.5, 2,3e1)\n"));
    EXPECT_EQ(h.world.axes, steps);
    EXPECT_EQ(h.world.origin, glm::dvec3(-1.5, 2, 30));
    const NrrdHeader b = parse(bcc(space + directions + " none\nspace origin: (-1.5,2,30)\n"));
    EXPECT_EQ(b.world.axes, 0.5 * steps);
    EXPECT_EQ(b.world.origin, glm::dvec3(-1.5, 2, 30));
  }
}

TEST(NrrdHeader, StepsThatDoNotSpanTheSpaceAreRefused) {
  for (const char* steps : {"spacings: 1 0 1",
                            "spacings: 1 nan 1",
                            "spacings: inf 1 1",
                            "spacings: 1 1",
                            "spacings: 1 1 1 1",
                            "spacings: 1 x 1",
                            "spacings:",
                            "spacings: 1e-200 1e-200 1e-200",
                            "spacings: 1e200 1e200 1e200",
                            "space directions: (1,0,0) (0,1,0) (1,1,0)",
                            "space directions: (1,0,0) (0,1,0) (0,0,0)",
                            "space directions: (1,0,0) (0,1,0) (0,0,nan)",
                            "space directions: (1,0,0) (0,1,0) (0,0,inf)",
                            "space directions: (1,0,0) (0,1,0) none",
                            "space directions: (1,0,0) (0,1,0)",
                            "space directions: (1,0) (0,1) (1,1)",
                            "space directions: (1,0,0,0) (0,1,0,0) (0,0,1,0)",
                            "space directions: (1,0,0) (0,1,0) (0,0,1",
                            "space directions: (1,0,0) (0,1,0) (0,0,1) none",
                            "space directions: (1 0 0) (0 1 0) (0 0 1)",
                            "space directions: (1,0,0) (0,1,0) (1,1,1e-13)",
                            "space origin: (1,2)",
                            "space origin: 1 2 3",
                            "space origin: (1,2,nan)",
                            "space: nowhere",
                            "space: left-posterior-superior-time",
                            "space dimension: 2",
                            "spacings: 1 1 1\nspace directions: (1,0,0) (0,1,0) (0,0,1)"}) {
    EXPECT_THAT(refusal(cartesian(std::string(steps) + "\n")), HasSubstr("expected")) << steps;
  }
  EXPECT_THAT(refusal(bcc("space directions: (1,0,0) (0,1,0) (0,0,1)\n")), HasSubstr("and none"));
  EXPECT_THAT(refusal(bcc("space directions: none (1,0,0) (0,1,0) (0,0,1)\n")), HasSubstr("and none"));
}

TEST(NrrdHeader, ABccVolumeIsFourDimensionalWithTwoCosetsAndSaysSo) {
  const NrrdHeader h = parse(bcc("kinds: domain domain domain list\n"));
  EXPECT_EQ(h.lattice, LatticeKind::bcc);
  EXPECT_EQ(h.extents, Extents(3, 4, 5));
  EXPECT_EQ(h.sample_count, 120u);
  EXPECT_EQ(h.world.axes, glm::dmat3(0.5));  // unit steps of a coset's grid

  const std::string rest = "type: uchar\nencoding: raw\n";
  EXPECT_THAT(refusal(header(rest + "dimension: 4\nsizes: 3 4 5 2\n")), HasSubstr("lattice:=bcc"));
  EXPECT_THAT(refusal(header(rest + "dimension: 4\nsizes: 3 4 5 3\nlattice:=bcc\n")), HasSubstr("nx ny nz 2"));
  EXPECT_THAT(refusal(header(rest + "dimension: 3\nsizes: 3 4 5\nlattice:=bcc\n")), HasSubstr("nx ny nz 2"));
  EXPECT_THAT(refusal(header(rest + "dimension: 4\nsizes: 3 4 5 2\nlattice:=cartesian\n")),
              HasSubstr("lattice:=cartesian"));
  EXPECT_THAT(refusal(header(rest + "dimension: 4\nsizes: 3 4 5 2\nlattice:=fcc\n")),
              AllOf(HasSubstr("'fcc'"), HasSubstr("bcc or cartesian")));
}

TEST(NrrdHeader, AxesThatAreNotOfSpaceAreRefused) {
  EXPECT_NO_THROW(parse(cartesian("kinds: space domain ???\n")));
  EXPECT_NO_THROW(parse(bcc("kinds: domain domain domain none\n")));
  EXPECT_THAT(refusal(cartesian("kinds: 3-vector domain domain\n")), HasSubstr("domain domain domain"));
  EXPECT_THAT(refusal(cartesian("kinds: domain domain\n")), HasSubstr("domain domain domain"));
  EXPECT_THAT(refusal(bcc("kinds: domain domain domain time\n")), HasSubstr("domain domain domain list"));
}

TEST(NrrdHeader, SizesAreWholeNumbersFromOneUpAsManyAsTheDimension) {
  for (const char* sizes :
       {"", "3 4", "3 4 5 6", "0 4 5", "-3 4 5", "3x 4 5", "3.0 4 5", "1e3 4 5", "3 4 99999999999999999999"}) {
    EXPECT_THAT(refusal(header("type: uchar\ndimension: 3\nencoding: raw\nsizes: " + std::string(sizes) + "\n")),
                HasSubstr("field 'sizes'"))
        << sizes;
  }
  // (2^40)^3 is 0 in 64 bits.
  const std::string huge = "1099511627776 1099511627776 1099511627776";
  EXPECT_THAT(refusal(header("type: uchar\ndimension: 3\nencoding: raw\nsizes: " + huge + "\n")), HasSubstr("2^62"));
  for (const char* dimension : {"", "2", "5", "16", "3 3", "three", "-1", "3000000000"}) {
    EXPECT_THAT(
        refusal(header("type: uchar\nsizes: 3 4 5\nencoding: raw\ndimension: " + std::string(dimension) + "\n")),
        HasSubstr("field 'dimension'"));
  }
}

TEST(NrrdHeader, EveryNecessaryFieldIsMissed) {
  const std::vector<std::string> lines{"type: short\n", "dimension: 3\n", "sizes: 1 1 1\n", "endian: big\n",
                                       "encoding: raw\n"};
  for (const std::string& missing : lines) {
    std::string rest;
    for (const std::string& line : lines)
      if (line != missing) rest += line;
    EXPECT_THAT(refusal(header(rest)), HasSubstr("no field '" + missing.substr(0, missing.find(':')) + "'"));
  }
}

TEST(NrrdHeader, NothingMayStandTwice) {
  EXPECT_THAT(refusal(cartesian("type: short\n")), HasSubstr("field 'type' for the second time"));
  EXPECT_THAT(refusal(cartesian("byteskip: 1\nbyte skip: 1\n")), HasSubstr("field 'byte skip' for the second time"));
  EXPECT_THAT(refusal(cartesian("a:=1\na:=1\n")), HasSubstr("key 'a' for the second time"));
  EXPECT_THAT(refusal(bcc("lattice:=bcc\n")), HasSubstr("key 'lattice' for the second time"));
}

TEST(NrrdHeader, AllVersionsOfTheMagicAndNoOthersAreKnown) {
  const std::string rest = cartesian("").substr(8);
  for (const char version : {'1', '2', '3', '4', '5'}) EXPECT_NO_THROW(parse(std::string("NRRD000") + version + rest));
  for (const char* magic : {"NRRD0006", "NRRD0000", "NRRD", "nrrd0004", "NRRD0004 ", "NRRD00041", "", "\x89PNG"}) {
    EXPECT_THAT(refusal(magic + rest), HasSubstr("expected NRRD0001 to NRRD0005")) << magic;
  }
}

TEST(NrrdHeader, CommentsCarriageReturnsCapitalsAndFieldsWithoutConsequenceAreTaken) {
  std::string text = cartesian(
      "# type: short\n#\nContent: x\nold min: 0\noldmax: 1\naxis mins: 0 0 0\ncenters: cell cell cell\nlabels: \"a\" "
      "\"b\" \"c\"\n"
      "units: \"mm\" \"mm\" \"mm\"\nspace units: \"mm\" \"mm\" \"mm\"\nmeasurement frame: (1,0,0) (0,1,0) "
      "(0,0,1)\nmin:\n");
  EXPECT_NO_THROW(parse(text));
  std::string windows;
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const NrrdHeader h = parse(windows + "samples");
  EXPECT_EQ(h.extents, Extents(3, 4, 5));
  EXPECT_EQ(h.data_offset, windows.size());
  EXPECT_THAT(h.notes, ElementsAre(Pair("content", "x")));
}

TEST(NrrdHeader, AnUnknownFieldOrALineThatIsNeitherFieldNorKeyIsRefusedWithItsNumber) {
  for (const char* line : {"sizzes: 3 4 5", "hello", "type:short", ":=value", ": value"}) {
    EXPECT_THAT(refusal(header(std::string("type: uchar\n") + line + "\n")),
                AllOf(HasSubstr("header line 3"), HasSubstr(line)));
  }
}

TEST(NrrdHeader, NotesKeepTheirOrderAndTheirEscapesAreUndone) {
  const NrrdHeader h = parse(cartesian(
      "space: lps\ncontent: head\nb:=two\\nlines\na:=back\\\\slash \\t\nc:=\nsee: that:=a := b\nlattice:=cartesian\n"));
  EXPECT_THAT(h.notes, ElementsAre(Pair("content", "head"), Pair("space", "lps"), Pair("b", "two\nlines"),
                                   Pair("a", "back\\slash \\t"), Pair("c", ""), Pair("see: that", "a := b")));
}

TEST(NrrdHeader, ADetachedHeaderNamesOneFileBesideItAndMayEndWithoutAnEmptyLine) {
  const std::string fields = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n";
  const auto data_file = [&](const std::string& line) {
    return interpret_nrrd(parse_nrrd_text(fields + line, "/some/where/v.nhdr")).data_file;
  };
  EXPECT_EQ(data_file("data file: v.raw\n"), "/some/where/v.raw");
  EXPECT_EQ(data_file("datafile: ./my volume.raw"), "/some/where/./my volume.raw");
  EXPECT_EQ(data_file("data file: /else/where.raw\n\n"), "/else/where.raw");
  for (const char* list : {"LIST", "LIST 2", "slice%03d.raw 1 9 1", "slice%03d.raw 1 9 1 2", ""}) {
    EXPECT_THAT(error_of([&] { data_file("data file: " + std::string(list) + "\n"); }),
                HasSubstr("the name of one file"));
  }
  EXPECT_THAT(error_of([&] { data_file(""); }), HasSubstr("ends inside the header"));
}

// The system would open the file of the part before a zero byte, and a terminal obeys an escape in a message.
TEST(NrrdHeader, TheNameOfADetachedFileHasNoControlCharacters) {
  for (const std::string& name : {std::string("v.raw\0.txt", 10), std::string("v\x1b[2J.raw"), std::string("v\r.raw"), std::string("v\x7f.raw")}) {
    const std::string message = refusal("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: raw\ndata file: " + name + "\n");
    EXPECT_THAT(message, HasSubstr("field 'data file': found 'v"));
    EXPECT_THAT(message, HasSubstr("without control characters"));
  }
}

TEST(NrrdHeader, SkipsAreWholeNumbers) {
  const NrrdHeader h = parse(cartesian("line skip: 2\nbyteskip: 7\n"));
  EXPECT_EQ(h.line_skip, 2);
  EXPECT_EQ(h.byte_skip, 7);
  EXPECT_EQ(parse(cartesian("byte skip: -1\n")).byte_skip, -1);
  for (const char* skip :
       {"line skip: -1", "line skip: x", "byte skip: -2", "byte skip: 1.5", "byte skip: 99999999999999999999"}) {
    EXPECT_THAT(refusal(cartesian(std::string(skip) + "\n")), HasSubstr("whole number"));
  }
  EXPECT_THAT(refusal(header("type: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: gzip\nbyte skip: -1\n")),
              HasSubstr("at least 0"));
}

TEST(NrrdHeader, AHeaderWithoutAnEndIsNotReadForever) {
  const std::string endless(3 << 20, 'a');
  EXPECT_THAT(refusal("NRRD0004\ntype: " + endless), HasSubstr("more than 1048576 bytes"));
  EXPECT_THAT(refusal("NRRD0004\n#" + endless + "\n\n"), HasSubstr("more than 1048576 bytes"));
  EXPECT_THAT(refusal(endless), HasSubstr("aaa...'"));
  EXPECT_LT(refusal(endless).size(), 200u);
  std::string many = "NRRD0004\n";
  while (many.size() < (2 << 20)) many += "#\n";
  EXPECT_THAT(refusal(many + "\n"), HasSubstr("more than 1048576 bytes"));
}

TEST(NrrdHeader, AHeaderFullOfKeysIsReadInNoTime) {
  // A look at every key for every key would take minutes.
  std::string keys;
  while (keys.size() < 1'000'000) keys += std::to_string(keys.size()) + ":=\n";
  EXPECT_GT(parse(cartesian(keys)).notes.size(), 100'000u);
}

TEST(NrrdHeader, WhatIsNotPrintableIsShownEscapedInMessages) {
  const std::string line("ty\0pe\x1b[2J\xff", 10);
  EXPECT_THAT(refusal("NRRD0004\n" + line + "\n\n"), HasSubstr("'ty\\x00pe\\x1b[2J\\xff'"));
}

}  // namespace
}  // namespace quincunx
