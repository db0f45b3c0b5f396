#include "lattice/lattice.h"

#include <fmt/format.h>

#include "lattice/error.h"
#include "lattice/quote.h"

namespace quincunx {

std::string_view lattice_name(LatticeKind kind) { return kind == LatticeKind::bcc ? "bcc" : "cartesian"; }

LatticeKind parse_lattice(std::string_view name, std::string_view what) {
  for (const LatticeKind kind : {LatticeKind::bcc, LatticeKind::cartesian}) {
    if (name == lattice_name(kind)) return kind;
  }
  throw InputError(fmt::format("{}: unknown lattice {}, expected bcc or cartesian", what, in_quotes(name)));
}

int coset_count(LatticeKind kind) { return kind == LatticeKind::bcc ? 2 : 1; }

int lattice_step(LatticeKind kind) { return kind == LatticeKind::bcc ? 2 : 1; }

glm::i64vec3 domain_max(LatticeKind kind, const Extents& extents) {
  return std::int64_t(lattice_step(kind)) * extents - std::int64_t(1);
}

glm::i64vec3 cell_count(LatticeKind kind, const Extents& extents) {
  return glm::max(domain_max(kind, extents), glm::i64vec3(1));
}

}  // namespace quincunx
