#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "io/nrrd_header.h"
#include "io/sample_file.h"
#include "io/volume_file.h"
#include "tests/fuzz/expect.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/targets.h"

namespace quincunx::fuzz {
namespace {

bool same_samples(const Volume& a, const Volume& b) {
  return std::visit(
      [&](const auto& samples) {
        const auto* others = std::get_if<std::decay_t<decltype(samples)>>(&b.samples);
        // As bytes: NaN is equal to itself.
        return others != nullptr && others->size() == samples.size() &&
               std::memcmp(samples.data(), others->data(), samples.size() * sizeof(samples[0])) == 0;
      },
      a.samples);
}

/// Refusing notes that a header of lines cannot hold is all that writing may do but write what can be read.
void expect_written(const Volume& volume, const std::string& path) {
  accepts(path, [&] {
    const NrrdHeader again = interpret_nrrd(parse_nrrd_text(format_nrrd(volume, "raw", path), path));
    expect(again.lattice == volume.lattice && again.extents == volume.extents && again.type == volume.type(), "the header that was written");
  });
}

}  // namespace

void feed_volume(std::string_view input) {
  static MemoryFile file(900), data(901);
  file.write(input);
  const std::size_t header = input.find("\n\n");
  data.write(header == std::string_view::npos ? input : input.substr(header + 2));

  // A detached file that cannot be read is named instead; both are in this folder, unless the header leads out of it.
  std::optional<Volume> whole;
  const bool read = accepts("", [&] { whole = read_volume(file.path()); });
  std::optional<Volume> box;
  const bool read_in_boxes = accepts("", [&] {
    const SampleFile source(file.path(), {});
    box = source.read_box(glm::i64vec3(0), source.header().extents);
    if (source.header().extents.z > 1) {
      const Volume upper = source.read_box(glm::i64vec3(0, 0, 1), source.header().extents);
      expect(upper.extents.z == box->extents.z - 1, "the box that was asked for");
    }
  });
  expect(read == read_in_boxes, "a file that is read, or refused, whole and in boxes alike");
  if (!read) return;
  expect(same_samples(*whole, *box), "the same samples whole and in boxes");
  expect_written(*whole, file.path());
}

}  // namespace quincunx::fuzz
