// quincunx sample: an analytic field on a lattice.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "app/command.h"
#include "app/flags.h"
#include "app/values.h"
#include "io/atomic_file.h"
#include "io/volume_file.h"
#include "lattice/field.h"
#include "lattice/memory.h"

namespace quincunx {
namespace {

struct SampleFlags {
  std::string field, out, lattice;
  Extents extents{0};
  int seed = 1;
  Encoding encoding = Encoding::gzip;
  Verbosity verbosity = Verbosity::normal;
};

void sample(const SampleFlags& flags) {
  const LatticeKind lattice = parse_lattice(flags.lattice, "--lattice");
  const auto field = make_field(flags.field, unsigned(flags.seed));
  const std::uint64_t count = checked_sample_count(lattice, flags.extents, SampleType::float32, "--dims");
  check_fits_memory(count * sample_type_bytes(SampleType::float32), "--dims");
  check_writable(flags.out);

  ProgressBar bar(flags.verbosity);
  Volume volume = sample_field(*field, lattice, flags.extents, bar.stage("sampling"));
  volume.notes.emplace_back("field", std::string(field->name()));
  if (field->name() == "quartic") volume.notes.emplace_back("seed", std::to_string(flags.seed));
  volume.notes.emplace_back("isovalue", fmt::format("{:.17g}", field->isovalue()));
  write_volume(volume, flags.out, flags.encoding, bar.stage("writing"));
}

}  // namespace

Command sample_command(CLI::App& program) {
  auto flags = std::make_shared<SampleFlags>();
  CLI::App* app = program.add_subcommand("sample", "Sample an analytic field over the cube [-1,1]^3");
  app->add_option("FIELD", flags->field, fmt::format("One of {}", fmt::join(field_names(), ", ")))->required();
  app->add_option("OUT", flags->out, "NRRD file to write (float32)")->required();
  add_choice_name(*app, "--lattice", flags->lattice, {"bcc", "cartesian"}, "Lattice of OUT")->required();
  const auto parse_dims = [flags](const std::vector<std::string>& texts) {
    constexpr std::int64_t most = std::int64_t(1) << 62;
    for (int axis = 0; axis < 3; ++axis) {
      flags->extents[axis] = parse_integer(texts[std::size_t(axis)], "--dims", 1, most);
    }
  };
  app->add_option_function<std::vector<std::string>>("--dims", parse_dims,
                                                     "Samples per axis; on the BCC lattice, of each of the two cosets")
      ->type_name("NX NY NZ")
      ->type_size(3)
      ->expected(1)
      ->required();
  add_integer(*app, "--seed", flags->seed, 0, 2147483647, "Which random quartic");
  add_choice(*app, "--encoding", flags->encoding, {{"gzip", Encoding::gzip}, {"raw", Encoding::raw}},
             "How OUT is packed");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { sample(*flags); }};
}

}  // namespace quincunx
