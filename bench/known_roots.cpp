#include "bench/known_roots.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

#include "bench/open_device.h"
#include "render/device_probe.h"
#include "render/roots.h"

namespace quincunx {
namespace {

constexpr double kEpsilon = 0x1p-24;
constexpr double kPlaceRounding = 2e-6;  // of a root in [0,1]: Newton's last step and its sum
constexpr std::uint64_t kBatch = 50000;

using Roots = std::vector<double>;

/// Bernstein coefficients of a product of linear factors, each positive at 0 where its root is: those with the roots in [0,1] fall.
std::vector<double> product_of(const Roots& roots) {
  std::vector<double> b{1.0};
  for (const double r : roots) {
    // (r - x) for a root ahead, (x - r) for one behind: coefficients r and r - 1, or their negatives.
    const double first = r > 0.0 ? r : -r, last = r > 0.0 ? r - 1.0 : 1.0 - r;
    const std::size_t n = b.size();
    std::vector<double> c(n + 1, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      c[i] += b[i] * first * double(n - i) / double(n);
      c[i + 1] += b[i] * last * double(i + 1) / double(n);
    }
    b = std::move(c);
  }
  return b;
}

Roots spread_roots(std::mt19937_64& random, int degree) {
  std::uniform_real_distribution<double> uniform(-1.0, 2.0);
  Roots roots(static_cast<std::size_t>(degree));
  for (double& r : roots) r = uniform(random);
  return roots;
}
/// Near the first root one or two more.
Roots close_roots(std::mt19937_64& random, int degree) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Roots roots = spread_roots(random, degree);
  roots[0] = uniform(random);
  const int more = degree > 2 && uniform(random) < 0.5 ? 2 : 1;
  for (int n = 1; n <= more; ++n) roots[std::size_t(n)] = roots[0] + std::pow(10.0, -6.0 + 5.0 * uniform(random));
  return roots;
}
Roots clustered_roots(std::mt19937_64& random, int degree) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double middle = uniform(random), width = std::pow(10.0, -6.0 + 6.0 * uniform(random));
  Roots roots(static_cast<std::size_t>(degree));
  for (double& r : roots) r = middle + width * (uniform(random) - 0.5);
  return roots;
}

struct Kind {
  const char* name;
  Roots (*roots)(std::mt19937_64& random, int degree);
};
constexpr Kind kKinds[] = {{"roots spread out", spread_roots}, {"pairs and triples", close_roots}, {"all in one cluster", clustered_roots}};

double value_at(std::span<const double> b, double x, double& slope) {
  std::vector<double> c(b.begin(), b.end());
  const std::size_t degree = c.size() - 1;
  for (std::size_t n = degree; n > 0; --n) {
    if (n == 1) slope = double(degree) * (c[1] - c[0]);
    for (std::size_t i = 0; i < n; ++i) c[i] += x * (c[i + 1] - c[i]);
  }
  return c[0];
}

/// Adds what is wrong with `root` of the polynomial `b`.
void judge(std::span<const double> b, double root, RootsLine& line) {
  double m = 0.0;
  for (const double c : b) m = std::max(m, std::abs(c));
  const double band = 12.0 * double(b.size() - 1) * kEpsilon * m;
  std::vector<double> crossings, low(b.begin(), b.end());
  append_crossings(b, crossings);
  for (double& c : low) c += band;
  std::vector<double> certain;
  append_crossings(low, certain);
  ++line.count;
  const bool found = root >= 0.0;
  if (found != !crossings.empty()) ++line.undecided;
  if (!certain.empty() && (!found || root > certain.front() + kPlaceRounding)) {
    ++line.missed;
    return;
  }
  if (!found) return;
  double slope = 0.0, beside = 0.0;
  const double value = std::abs(value_at(b, root, slope));
  for (const double side : {-kPlaceRounding, kPlaceRounding}) {
    double there = 0.0;
    value_at(b, std::clamp(root + side, 0.0, 1.0), there);
    beside = std::max(beside, std::abs(there));
  }
  const double part = value / (band + kPlaceRounding * std::max(std::abs(slope), beside));
  line.residual = std::max(line.residual, part);
  line.wrong += part > 1.0;
  if (!crossings.empty() && !certain.empty() && certain.front() - crossings.front() < 1e-3 && std::abs(slope) > 0.1 * m) line.off = std::max(line.off, std::abs(root - crossings.front()));
}

void add(RootsLine& line, const RootsLine& more) {
  line.count += more.count;
  line.missed += more.missed;
  line.wrong += more.wrong;
  line.undecided += more.undecided;
  line.residual = std::max(line.residual, more.residual);
  line.off = std::max(line.off, more.off);
}

/// So many polynomials that are positive at 0, rounded to floats.
std::vector<float> polynomials(const Kind& kind, int degree, std::uint64_t count, std::mt19937_64& random) {
  std::vector<float> all;
  const std::size_t each = std::size_t(degree) + 1;
  while (all.size() < count * each) {
    const std::vector<double> b = product_of(kind.roots(random, degree));
    double m = 0.0;
    for (const double c : b) m = std::max(m, std::abs(c));
    if (!(float(b[0] / m) > 0.0f)) continue;
    for (const double c : b) all.push_back(float(c / m));
  }
  return all;
}

}  // namespace

std::vector<RootsLine> measure_roots(const RootsPlan& plan, std::string& device_name, const Progress& progress) {
  const std::shared_ptr<gpu::Device> device = open_device(plan.device);
  device_name = gpu::info(*device).name;
  std::vector<RootsLine> lines;
  const double all = double(plan.degrees.size() * std::size(kKinds));
  for (const int degree : plan.degrees)
    for (const Kind& kind : kKinds) {
      RootsLine line;
      line.degree = degree;
      line.kind = kind.name;
      std::mt19937_64 random(plan.seed);
      while (line.count < plan.count) {
        report(progress, (double(lines.size()) + double(line.count) / double(plan.count)) / all);
        const std::size_t each = std::size_t(degree) + 1;
        const std::vector<float> batch = polynomials(kind, degree, std::min(kBatch, plan.count - line.count), random);
        const std::vector<float> roots = probe_roots(*device, degree, batch);
        constexpr std::size_t kPart = 1000;
        std::vector<RootsLine> parts((roots.size() + kPart - 1) / kPart);
        tbb::parallel_for(std::size_t(0), parts.size(), [&](std::size_t p) {
          std::vector<double> b(each);
          for (std::size_t n = p * kPart; n < std::min(roots.size(), (p + 1) * kPart); ++n) {
            std::copy_n(batch.begin() + std::ptrdiff_t(n * each), each, b.begin());
            judge(b, roots[n], parts[p]);
          }
        });
        for (const RootsLine& part : parts) add(line, part);
      }
      lines.push_back(line);
    }
  report(progress, 1.0);
  return lines;
}

}  // namespace quincunx
