#include "spline/spline.h"

#include <stdexcept>
#include <string>

#include "lattice/error.h"
#include "spline/bcc12.h"
#include "spline/bcc4.h"
#include "spline/bcc7.h"
#include "spline/bcc8.h"
#include "spline/catmull_rom.h"
#include "spline/cwlb.h"
#include "spline/tricubic.h"
#include "spline/trilinear.h"
#include "spline/triquadratic.h"

namespace quincunx {
namespace {

/// The one list of splines.
struct Row {
  std::string_view name;
  std::unique_ptr<Spline> (*make)();
};

template <class T>
std::unique_ptr<Spline> make() {
  return std::make_unique<T>();
}

constexpr Row kSplines[] = {
    {"bcc4", make<Bcc4>},
    {"bcc7", make<Bcc7>},
    {"bcc8", make<Bcc8>},
    {"bcc12", make<Bcc12>},
    {"cwlb", make<Cwlb>},
    {"trilinear", make<Trilinear>},
    {"triquadratic", make<Triquadratic>},
    {"tricubic", make<Tricubic>},
    {"catmull-rom", make<CatmullRom>},
};

}  // namespace

const Spline::Filter& Spline::filter(Prefilter wanted) const {
  std::string choices;
  for (const Filter& f : filters()) {
    if (f.kind == wanted || wanted == Prefilter::automatic) return f;
    choices += ", " + std::string(prefilter_name(f.kind));
  }
  throw InputError("--prefilter: found " + std::string(prefilter_name(wanted)) + ", expected one that the spline " + std::string(name()) +
                   " has: auto" + choices);
}

Jet Spline::evaluate_piece(const Coefficients<double>&, const glm::ivec3&, const glm::dvec3&) const {
  throw std::logic_error("pieces of " + std::string(name()) + " are polynomials");
}

double Spline::curvature(const Coefficients<double>&, const glm::ivec3&, const glm::dvec3&) const {
  throw std::logic_error("pieces of " + std::string(name()) + " are polynomials");
}

std::string_view prefilter_name(Spline::Prefilter prefilter) {
  switch (prefilter) {
    case Spline::Prefilter::automatic: return "auto";
    case Spline::Prefilter::none: return "none";
    case Spline::Prefilter::fir: return "fir";
    case Spline::Prefilter::iir: return "iir";
  }
  return "";
}

const std::vector<std::string_view>& spline_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const Row& row : kSplines) list.push_back(row.name);
    return list;
  }();
  return names;
}

const std::vector<std::string_view>& polynomial_spline_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const Row& row : kSplines)
      if (row.make()->polynomial()) list.push_back(row.name);
    return list;
  }();
  return names;
}

std::string_view default_spline(LatticeKind lattice) { return lattice == LatticeKind::bcc ? "bcc7" : "trilinear"; }

std::unique_ptr<Spline> make_spline(std::string_view name) {
  for (const Row& row : kSplines)
    if (row.name == name) return row.make();
  std::string choices;
  for (const std::string_view known : spline_names()) choices += (choices.empty() ? "" : ", ") + std::string(known);
  throw InputError("spline '" + std::string(name) + "' is unknown; expected one of: " + choices);
}

std::unique_ptr<Spline> make_spline(std::string_view name, LatticeKind lattice) {
  std::unique_ptr<Spline> spline = make_spline(name.empty() ? default_spline(lattice) : name);
  if (spline->lattice() == lattice) return spline;
  throw InputError("--spline: found a volume on the " + std::string(lattice_name(lattice)) + " lattice, expected " +
                   std::string(lattice_name(spline->lattice())) + ", the lattice of " + std::string(name));
}

}  // namespace quincunx
