#include "app/volume_flags.h"

#include <fmt/format.h>

#include "app/flags.h"
#include "app/values.h"
#include "lattice/error.h"

namespace quincunx {

void add_volume_flags(CLI::App& app, VolumeFlags& flags) {
  const std::string group = "Volume";
  app.add_option("--tf,--dvr", flags.transfer_function, "Transfer function, ours or ParaView's: show the volume, with --iso together with surfaces")
      ->type_name("TF.json")
      ->group(group);
  // Those that mean something with --tf alone.
  const auto add = [&](CLI::Option* option) {
    option->group(group)->each([&flags, name = option->get_name()](const std::string&) {
      if (flags.first_given.empty()) flags.first_given = name;
    });
  };
  using Classifies = std::vector<std::pair<std::string, Classify>>;
  using Switch = std::vector<std::pair<std::string, bool>>;
  add(add_choice(app, "--classify", flags.look.classify, Classifies{{"post", Classify::post}, {"pre-integrated", Classify::pre_integrated}},
                 "The value of each sample, or the values at both ends of each stretch"));
  const auto entries = [&flags](const std::string& text) {
    flags.look.entries = int(parse_integer(text, "--tf-entries", 2, 65536));
  };
  add(add_parsed(app, "--tf-entries", entries, "N", "4096, 512 pre-integrated", "Entries of the function's table, or of its sides"));
  const auto adaptive = [&flags](const std::string& text) {
    flags.look.adaptive = true;
    flags.look.finest = parse_number(text, "--adaptive");
  };
  add(add_parsed(app, "--adaptive", adaptive, "PART", "", "Finer steps, to an eighth, where the value goes along more than PART of the function's range"));
  add(add_choice(app, "--shade", flags.look.shade, Switch{{"on", true}, {"off", false}}, "A light at the eye, by the gradient"));
  const auto modulate = [&flags](const std::string& text) {
    const std::vector<double> ends = parse_numbers(text, "--modulate");
    if (ends.size() != 2) throw InputError(fmt::format("--modulate: found {}, expected two numbers LOW,HIGH", text));
    flags.look.modulate_from = ends[0], flags.look.modulate_to = ends[1];
    if (!(ends[0] >= 0.0 && ends[0] < ends[1]))
      throw InputError(fmt::format("--modulate: found {}, expected two gradient magnitudes, the second one larger", text));
  };
  add(add_parsed(app, "--modulate", modulate, "LOW,HIGH", "", "Opacities grow from 0 to their own between these gradient magnitudes (world)"));
  add(add_number(app, "--termination", flags.look.termination, {0.0, 0.5}, "A ray ends where it lets less through"));
  const auto jitter = [&flags](const std::string& text) {
    flags.look.jitter = std::uint32_t(parse_integer(text, "--jitter", 0, 4294967295));
  };
  add(add_parsed(app, "--jitter", jitter, "SEED", "", "Shift the steps of each pixel by a random part of one, against rings"));
}

void check_volume_flags(const VolumeFlags& flags) {
  if (flags.transfer_function.empty() && !flags.first_given.empty())
    throw InputError(fmt::format("{}: found without --tf, expected --tf TF.json", flags.first_given));
}

std::optional<DirectVolume> make_direct_volume(const VolumeFlags& flags, double step) {
  if (flags.transfer_function.empty()) return std::nullopt;
  DirectVolume volume = flags.look;
  volume.function = read_transfer_function(flags.transfer_function);
  volume.step = step;
  return volume;
}

}  // namespace quincunx
