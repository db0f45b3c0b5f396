#include "app/skip_flags.h"

#include <fmt/format.h>

#include <array>

#include "accel/structure.h"
#include "app/flags.h"
#include "app/values.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr std::array<std::pair<std::string_view, Clustering>, 3> kClusterings{
    {{"none", Clustering::none}, {"cubes", Clustering::cubes}, {"boxes", Clustering::boxes}}};
constexpr std::array<std::pair<std::string_view, KdDepth>, 2> kKdDepths{
    {{"shallow", KdDepth::shallow}, {"deep", KdDepth::deep}}};

constexpr std::array<std::pair<std::string_view, HybridGrid>, 2> kHybridGrids{{{"mm", HybridGrid::mm}, {"pc", HybridGrid::pc}}};

template <class Enum, std::size_t N>
std::string_view name_of(const std::array<std::pair<std::string_view, Enum>, N>& names, Enum wanted) {
  for (const auto& [name, value] : names)
    if (value == wanted) return name;
  return "";
}
template <class Enum, std::size_t N>
Enum named(const std::array<std::pair<std::string_view, Enum>, N>& names, std::string_view text, std::string_view flag) {
  std::vector<std::string> choices;
  for (const auto& [name, value] : names) choices.emplace_back(name);
  check_choice(text, flag, choices);
  for (const auto& [name, value] : names)
    if (name == text) return value;
  return names.front().second;
}

void check_given(bool given, std::string_view flag, std::string_view structure, const SkipConfig& config) {
  if (given && config.structure != structure)
    throw InputError(fmt::format("{}: found with --skip {}, expected --skip {}", flag, config.structure, structure));
}

}  // namespace

std::string_view clustering_name(Clustering clustering) { return name_of(kClusterings, clustering); }
std::string_view kd_name(KdDepth kd) { return name_of(kKdDepths, kd); }
std::string_view hybrid_name(HybridGrid grid) { return name_of(kHybridGrids, grid); }

bool has_large_leaves(const SkipConfig& config) {
  return config.structure == "hybrid" || (config.structure == "kdtree" && config.kd == KdDepth::shallow);
}

void add_skip_flags(CLI::App& app, SkipFlags& flags, const std::string& group) {
  std::vector<std::string> structures{"auto"};
  structures.insert(structures.end(), structure_names().begin(), structure_names().end());
  add_choice_name(app, "--skip", flags.config.structure, structures,
                  "How empty space is skipped; changes no pixel. auto: what fits the scene (--explain says why)")
      ->group(group);
  add_block(app, flags.config.block)->group(group);
  add_choice(app, "--cell-test", flags.config.cell_test, {{"on", true}, {"off", false}}, "Test single cells too")
      ->group(group);
  const auto cluster = [&flags](const std::vector<std::string>& texts) {
    flags.config.clustering = texts.empty() || texts[0].empty() ? Clustering::cubes : named(kClusterings, texts[0], "--cluster");
    flags.clustering_given = true;
  };
  app.add_option_function<std::vector<std::string>>(
         "--cluster", cluster, "Of bvh: merge active blocks, to cubes (the published way; if nothing is named) or boxes")
      ->type_name("{none,cubes,boxes}=none")  // not default_str, which the parser takes for the flag by itself
      ->expected(0, 1)
      ->group(group);
  const auto edge = [&flags](const std::string& text) {
    flags.config.max_cluster = int(parse_integer(text, "--max-cluster", 1, 256));
    flags.max_cluster_given = true;
  };
  add_parsed(app, "--max-cluster", edge, "N", fmt::format("{}", flags.config.max_cluster), "Of cubes: the largest edge, in blocks")
      ->group(group);
  const auto kd = [&flags](const std::string& text) {
    flags.config.kd = named(kKdDepths, text, "--kd");
    flags.kd_given = true;
  };
  add_parsed(app, "--kd", kd, "{shallow,deep}", std::string(kd_name(flags.config.kd)),
             "Of kdtree: a few large leaves, sorted for each picture, or small ones that each ray looks for")
      ->group(group);
  const auto hybrid = [&flags](const std::string& text) {
    flags.config.hybrid = named(kHybridGrids, text, "--hybrid");
    flags.hybrid_given = true;
  };
  add_parsed(app, "--hybrid", hybrid, "{mm,pc}", std::string(hybrid_name(flags.config.hybrid)),
             "Of hybrid: its grid holds minima and maxima, compared with what can be seen at each block, or whether they meet it")
      ->group(group);
  const auto leaf = [&flags](const std::string& text) {
    flags.config.least_leaf = parse_number(text, "--least-leaf");
    if (!(flags.config.least_leaf > 0.0 && flags.config.least_leaf <= 1.0))
      throw InputError(fmt::format("--least-leaf: found '{}', expected a number above 0, at most 1", text));
    flags.least_leaf_given = true;
  };
  add_parsed(app, "--least-leaf", leaf, "X", fmt::format("{}", flags.config.least_leaf),
             "Of hybrid and shallow k-d trees: no leaf is smaller than this part of the box around all that is active")
      ->group(group);
  const auto segments = [&flags](const std::string& text) {
    flags.config.max_segments = int(parse_integer(text, "--max-segments", 1, 64));
    flags.max_segments_given = true;
  };
  add_parsed(app, "--max-segments", segments, "N", fmt::format("{}", flags.config.max_segments), "Of segments: the most that a ray's list holds")
      ->group(group);
  add_choice(app, "--range-query", flags.config.range_query,
             {{"intervals", RangeQueryKind::intervals}, {"table", RangeQueryKind::table}, {"irt", RangeQueryKind::irt}},
             "How blocks and cells are compared with what can be seen: exactly, or by a table or tree over 4096 entries. Not of the blocks of octree and hybrid mm")
      ->group(group);
}

void check_skip_flags(const SkipFlags& flags) {
  check_given(flags.clustering_given, "--cluster", "bvh", flags.config);
  check_given(flags.kd_given, "--kd", "kdtree", flags.config);
  check_given(flags.hybrid_given, "--hybrid", "hybrid", flags.config);
  if (flags.least_leaf_given && !has_large_leaves(flags.config))
    throw InputError(fmt::format("--least-leaf: found with --skip {}, expected --skip hybrid or --skip kdtree --kd shallow", flags.config.structure));
  check_given(flags.max_segments_given, "--max-segments", "segments", flags.config);
  if (flags.max_cluster_given && flags.config.clustering != Clustering::cubes)
    throw InputError(fmt::format("--max-cluster: found with --cluster {}, expected --cluster cubes",
                                 clustering_name(flags.config.clustering)));
}

}  // namespace quincunx
