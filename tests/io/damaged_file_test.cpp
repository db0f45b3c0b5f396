// Files cut short, changed at random, or made of nothing: each is read or refused, and nothing else happens.
#include <random>

#include "tests/io/read_twice.h"
#include "tests/io/test_files.h"

namespace quincunx {
namespace {

using testing::HasSubstr;

class DamagedFile : public FileTest {
 protected:
  /// Reads a file of these bytes. True where it was read, false where an InputError of one line names a file.
  bool reads(std::string_view bytes) {
    try {
      read_twice(file("v.nrrd", bytes));
      return true;
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_THAT(message, HasSubstr(path("")));
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      return false;
    }
  }
};

const std::string cartesian_fields =
    "NRRD0004\n# made for a test\ntype: ushort\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 3 4\n"
    "space directions: (1,0,0) (0,1,0) (0,0,2.5)\nkinds: domain domain domain\nendian: little\n"
    "space origin: (-1,2,0.5)\nprovenance:=a test\n";
const std::string bcc_fields =
    "NRRD0005\ntype: short\ndimension: 4\nsizes: 2 3 2 2\nspacings: 1 1 2 nan\nendian: big\nlattice:=bcc\nbyte skip: "
    "0\n";

/// 24 samples as bytes and as text.
std::string sample_bytes() {
  std::string bytes;
  for (int n = 0; n < 48; ++n) bytes += char(n * 5);
  return bytes;
}
std::string sample_text() {
  std::string text;
  for (int n = 0; n < 24; ++n) text += std::to_string(n * 100) + " ";
  return text + "7";  // one digit more, so that the last cut is one number short
}

std::vector<std::string> small_files() {
  std::string text = sample_text();
  text.erase(text.size() - 2);  // 24 numbers, the last "2300"
  return {cartesian_fields + "encoding: raw\n\n" + sample_bytes(),
          cartesian_fields + "encoding: gzip\n\n" + gzipped(sample_bytes()),
          cartesian_fields + "encoding: ascii\n\n" + text, bcc_fields + "encoding: raw\n\n" + sample_bytes(),
          bcc_fields + "encoding: gzip\n\n" + gzipped(sample_bytes())};
}

TEST_F(DamagedFile, AFileCutAtAnyByteIsRefused) {
  for (const std::string& whole : small_files()) {
    EXPECT_TRUE(reads(whole));
    // A number in text may lose digits and still be one: there the last byte that matters is its first.
    const bool text = whole.find("encoding: ascii") != std::string::npos;
    const std::size_t end = text ? whole.rfind(' ') + 2 : whole.size();
    for (std::size_t length = 0; length < end; ++length) {
      EXPECT_FALSE(reads(whole.substr(0, length))) << "cut to " << length << " of " << whole.size();
    }
  }
}

TEST_F(DamagedFile, ADetachedFileCutAtAnyByteIsRefused) {
  const std::string fields = cartesian_fields + "encoding: gzip\ndata file: v.gz";
  const std::string data = gzipped(sample_bytes());
  file("v.gz", data);
  EXPECT_TRUE(reads(fields));
  for (std::size_t length = 0; length < fields.size(); ++length) EXPECT_FALSE(reads(fields.substr(0, length)));
  for (std::size_t length = 0; length < data.size(); ++length) {
    file("v.gz", data.substr(0, length));
    EXPECT_FALSE(reads(fields));
  }
}

TEST_F(DamagedFile, AnyFlippedBitOfAGzipStreamIsNoticedOrOfNoConsequence) {
  const std::string head = cartesian_fields + "encoding: gzip\n\n", stream = gzipped(sample_bytes());
  const Volume whole = read_twice(file("v.nrrd", head + stream));
  int read = 0;
  for (std::size_t byte = 0; byte < stream.size(); ++byte) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = stream;
      damaged[byte] = char(damaged[byte] ^ (1 << bit));
      if (!reads(head + damaged)) continue;
      ++read;
      EXPECT_EQ(read_twice(path("v.nrrd")).samples, whole.samples) << "byte " << byte << " bit " << bit;
    }
  }
  // The header's time, extra flags, system and text flag mean nothing, nor do up to 7 bits that fill a byte.
  EXPECT_GE(read, 49);
  EXPECT_LE(read, 56);
}

TEST_F(DamagedFile, HeadersChangedAtRandomAreReadOrRefused) {
  std::mt19937 random(20);
  // What a header is made of: a change to one of these reaches further than a random byte.
  const std::string_view parts = "0123456789-+.,()%\\#:=\n\r\t NaneEinfx\xff";
  int read = 0, refused = 0;
  for (const std::string& whole : small_files()) {
    const std::size_t header = whole.find("\n\n") + 2;
    for (int n = 0; n < 800; ++n) {
      std::string damaged = whole;
      for (unsigned change = random() % 3 + 1; change > 0; --change) {
        const std::size_t at = random() % header;
        const char byte = random() % 4 == 0 ? char(random()) : parts[random() % parts.size()];
        if (const unsigned how = random() % 3; how == 0) {
          damaged[at] = byte;
        } else if (how == 1) {
          damaged.insert(at, 1, byte);
        } else {
          damaged.erase(at, 1 + random() % 4);
        }
      }
      ++(reads(damaged) ? read : refused);
    }
  }
  // Both happen: most changes hit something that matters, some a comment or a note.
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 1000);
}

TEST_F(DamagedFile, RandomBytesAreRefused) {
  std::mt19937 random(21);
  for (int n = 0; n < 200; ++n) {
    std::string bytes = n % 2 == 0 ? "" : "NRRD0004\n";
    for (unsigned length = random() % 2000; length > 0; --length) bytes += char(random());
    EXPECT_FALSE(reads(bytes));
  }
}

}  // namespace
}  // namespace quincunx
