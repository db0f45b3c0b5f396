// quincunx convert: from one lattice to the other.
#include <fmt/format.h>

#include <memory>

#include "app/command.h"
#include "app/flags.h"
#include "io/atomic_file.h"
#include "io/volume_file.h"
#include "lattice/error.h"
#include "lattice/resample.h"

namespace quincunx {
namespace {

struct ConvertFlags {
  std::string in, out, lattice, method = "subset";
  Encoding encoding = Encoding::gzip;
  Verbosity verbosity = Verbosity::normal;
};

/// Adds `line` to the note `history`, after what stands there already.
void add_history(Volume& volume, const std::string& line) {
  for (auto& [key, value] : volume.notes) {
    if (key != "history") continue;
    value += "; " + line;
    return;
  }
  volume.notes.emplace_back("history", line);
}

void convert(const ConvertFlags& flags) {
  const LatticeKind target = parse_lattice(flags.lattice, "--lattice");
  check_writable(flags.out);
  ProgressBar bar(flags.verbosity);
  const Volume volume = read_volume(flags.in, bar.stage("reading"));
  if (volume.lattice == target) {
    throw InputError(fmt::format("{}: found a {} volume already, expected one of the other lattice for --lattice {}",
                                 flags.in, lattice_name(target), lattice_name(target)));
  }
  Volume converted = target == LatticeKind::bcc ? bcc_subset(volume, flags.in) : cartesian_subset(volume);
  add_history(converted, target == LatticeKind::bcc ? "the even and the odd points of a Cartesian volume"
                                                    : "the even coset of a BCC volume");
  write_volume(converted, flags.out, flags.encoding, bar.stage("writing"));
}

}  // namespace

Command convert_command(CLI::App& program) {
  auto flags = std::make_shared<ConvertFlags>();
  CLI::App* app = program.add_subcommand("convert", "Turn a volume into one on the other lattice");
  app->footer(
      "To bcc: the points whose coordinates are all even or all odd, a quarter of the samples.\n"
      "To cartesian: the even coset, half of the samples. Values, types and places stay as they are.");
  app->add_option("IN", flags->in, "NRRD file to read")->required();
  app->add_option("OUT", flags->out, "NRRD file to write")->required();
  add_choice_name(*app, "--lattice", flags->lattice, {"bcc", "cartesian"}, "Lattice of OUT")->required();
  add_choice_name(*app, "--method", flags->method, {"subset"}, "Which samples OUT has");
  add_choice(*app, "--encoding", flags->encoding, {{"gzip", Encoding::gzip}, {"raw", Encoding::raw}},
             "How OUT is packed");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { convert(*flags); }};
}

}  // namespace quincunx
