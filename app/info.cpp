// quincunx info: what a volume file holds.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/flags.h"
#include "app/values.h"
#include "app/vector_json.h"
#include "io/volume_file.h"
#include "spline/spline.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

// Shown as p1, p5, ...
constexpr std::array quantile_fractions{0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};

struct InfoFlags {
  std::string volume;
  bool json = false;
  Verbosity verbosity = Verbosity::normal;
};

struct Box {
  glm::dvec3 low, high;
};

/// The world's bounding box of the domain, from its eight corners.
Box world_box(const Volume& volume) {
  const glm::dvec3 far(domain_max(volume.lattice, volume.extents));
  Box box{volume.world.to_world(glm::dvec3(0.0)), volume.world.to_world(glm::dvec3(0.0))};
  for (int corner = 1; corner < 8; ++corner) {
    const glm::dvec3 x = volume.world.to_world(far * glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2));
    box = {glm::min(box.low, x), glm::max(box.high, x)};
  }
  return box;
}

/// Distances between neighbouring samples along the axes of one coset grid, world units.
glm::dvec3 grid_spacing(const Volume& volume) {
  const glm::dmat3& e = volume.world.axes;
  return double(lattice_step(volume.lattice)) * glm::dvec3(glm::length(e[0]), glm::length(e[1]), glm::length(e[2]));
}

/// Bytes of the coefficients of the lattice's default spline in 32-bit floats.
std::uint64_t coefficient_bytes(const Volume& volume) {
  return coefficient_count(volume.lattice, volume.extents, make_spline("", volume.lattice)->apron()) * sizeof(float);
}

Json describe(const InfoFlags& flags, const Volume& volume) {
  const SampleRange range = sample_range(volume);
  const Box box = world_box(volume);
  const glm::i64vec3 n = volume.extents, far = domain_max(volume.lattice, n);
  const glm::dmat3& e = volume.world.axes;
  Json json{{"file", flags.volume},
            {"lattice", lattice_name(volume.lattice)},
            {"extents", {n.x, n.y, n.z}},
            {"cosets", coset_count(volume.lattice)},
            {"samples", volume.sample_count()},
            {"type", sample_type_name(volume.type())},
            {"domain", {far.x, far.y, far.z}},
            {"spacing", vector_json(grid_spacing(volume))},
            {"origin", vector_json(volume.world.origin)},
            {"axes", {vector_json(e[0]), vector_json(e[1]), vector_json(e[2])}},
            {"world_box", {{"min", vector_json(box.low)}, {"max", vector_json(box.high)}}},
            {"range", {range.min, range.max}},
            {"not_finite", range.not_finite}};
  const std::vector<double> quantiles = sample_quantiles(volume, quantile_fractions);
  for (std::size_t q = 0; q < quantiles.size(); ++q) {
    json["quantiles"][fmt::format("p{:.0f}", 100.0 * quantile_fractions[q])] = quantiles[q];
  }
  json["memory"] = {{"samples_bytes", volume.sample_count() * sample_type_bytes(volume.type())},
                    {"coefficients_bytes", coefficient_bytes(volume)}};
  json["notes"] = Json::object();
  for (const auto& [key, value] : volume.notes) json["notes"][key] = value;
  return json;
}

std::string vector_text(const Json& v) {
  return fmt::format("({:g}, {:g}, {:g})", v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
}

void print_text(const Json& json) {
  const auto row = [](std::string_view name, const std::string& text) { fmt::print("{:<13} {}\n", name, text); };
  const auto integers = [](const Json& v) {
    return fmt::format("{} x {} x {}", v[0].get<std::int64_t>(), v[1].get<std::int64_t>(), v[2].get<std::int64_t>());
  };
  const bool bcc = json["lattice"] == "bcc";
  row("file", json["file"].get<std::string>());
  row("lattice", json["lattice"].get<std::string>());
  row("extents", fmt::format("{}{} = {} samples", integers(json["extents"]), bcc ? " x 2 cosets" : "",
                             json["samples"].get<std::uint64_t>()));
  row("type", json["type"].get<std::string>());
  row("domain", integers(json["domain"]) + " cells");
  row("spacing", vector_text(json["spacing"]) + (bcc ? " of one coset; a cell is half as wide" : ""));
  for (int a = 0; a < 3; ++a) row(a == 0 ? "cell's edges" : "", vector_text(json["axes"][std::size_t(a)]));
  row("world", vector_text(json["world_box"]["min"]) + " to " + vector_text(json["world_box"]["max"]));
  row("range", fmt::format("{:g} to {:g}", json["range"][0].get<double>(), json["range"][1].get<double>()));
  std::vector<std::string> quantiles;
  for (const auto& [name, value] : json["quantiles"].items()) {
    quantiles.push_back(fmt::format("{} % {:g}", name.substr(1), value.get<double>()));
  }
  row("quantiles", fmt::format("{}", fmt::join(quantiles, ", ")));
  row("not finite", fmt::format("{} samples", json["not_finite"].get<std::uint64_t>()));
  const double coefficients = json["memory"]["coefficients_bytes"].get<double>();
  row("memory", readable_bytes(json["memory"]["samples_bytes"].get<double>()) + " of samples" +
                    (bcc ? ", " + readable_bytes(coefficients) + " of coefficients on the device" : ""));
  for (const auto& [key, value] : json["notes"].items()) row("note", key + ": " + value.get<std::string>());
}

void info(const InfoFlags& flags) {
  ProgressBar bar(flags.verbosity);
  const Volume volume = read_volume(flags.volume, bar.stage("reading"));
  const Json json = describe(flags, volume);
  bar.erase();
  if (flags.json) {
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_text(json);
  }
}

}  // namespace

Command info_command(CLI::App& program) {
  auto flags = std::make_shared<InfoFlags>();
  CLI::App* app = program.add_subcommand("info", "Tell what a volume file holds");
  app->add_option("VOLUME", flags->volume, "NRRD file")->required();
  app->add_flag("--json", flags->json, "Print JSON");
  add_quiet(*app, flags->verbosity);
  return {app, [flags] { info(*flags); }};
}

}  // namespace quincunx
