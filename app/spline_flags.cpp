#include "app/spline_flags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "app/flags.h"

namespace quincunx {
namespace {

/// The splines of a lattice, its default one first.
std::string splines_of(LatticeKind lattice) {
  std::vector<std::string_view> names{default_spline(lattice)};
  for (const std::string_view name : spline_names())
    if (name != names.front() && make_spline(name)->lattice() == lattice) names.push_back(name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

CLI::Option* add_spline(CLI::App& app, std::string& spline) {
  const std::string help = fmt::format("Reconstruction, of BCC volumes: {}; of Cartesian ones: {}", splines_of(LatticeKind::bcc), splines_of(LatticeKind::cartesian));
  const auto set = [&spline](const std::string& text) { spline = make_spline(text)->name(); };
  return add_parsed(app, "--spline", set, "SPLINE", "", help);
}

CLI::Option* add_prefilter(CLI::App& app, Spline::Prefilter& prefilter) {
  std::vector<std::pair<std::string, Spline::Prefilter>> choices;
  for (const auto kind : {Spline::Prefilter::automatic, Spline::Prefilter::none, Spline::Prefilter::fir, Spline::Prefilter::iir})
    choices.emplace_back(prefilter_name(kind), kind);
  return add_choice(app, "--prefilter", prefilter, choices,
                    "From samples to coefficients: the spline's own of full order, none, a short mask (fir), or interpolation (iir)");
}

CLI::Option* add_storage(CLI::App& app, Storage& storage) {
  std::vector<std::pair<std::string, Storage>> choices;
  for (const Storage kind : kStorages) choices.emplace_back(storage_name(kind), kind);
  return add_choice(app, "--storage", storage, choices, "Of coefficients on the device: 32-bit floats, or rounded to 16 or 8 bits");
}

}  // namespace quincunx
