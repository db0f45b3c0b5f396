// The flags that choose a skipping structure.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

#include "accel/skip_config.h"

namespace quincunx {

struct SkipFlags {
  SkipConfig config;
  bool clustering_given = false, max_cluster_given = false, kd_given = false, hybrid_given = false, least_leaf_given = false,
       max_segments_given = false;
};

/// --skip, --block, --cell-test, --cluster, --max-cluster, --kd, --hybrid, --least-leaf, --max-segments, --range-query.
void add_skip_flags(CLI::App& app, SkipFlags& flags, const std::string& group);

/// Throws InputError naming the flag where one was given that the structure of --skip does not have.
void check_skip_flags(const SkipFlags& flags);

/// "none", "cubes", "boxes".
std::string_view clustering_name(Clustering clustering);
/// "shallow", "deep".
std::string_view kd_name(KdDepth kd);
/// "mm", "pc".
std::string_view hybrid_name(HybridGrid grid);
/// Whether SkipConfig::least_leaf means something to the structure.
bool has_large_leaves(const SkipConfig& config);

}  // namespace quincunx
