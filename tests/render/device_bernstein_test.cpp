// The kernels' root finders on polynomials whose roots are known.
#include <gtest/gtest.h>

#include <array>

#include "render/device_probe.h"
#include "render/roots.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

using Polynomial = std::vector<float>;  // Bernstein coefficients on [0,1], the first one positive

/// The degrees along a ray: bcc4, trilinear, bcc7, bcc8, triquadratic, and cubics along the axes.
class DeviceBernsteinTest : public DeviceTest, public ::testing::WithParamInterface<int> {
 protected:
  std::vector<float> device_roots(const std::vector<Polynomial>& polynomials) const {
    std::vector<float> all;
    for (const Polynomial& b : polynomials) all.insert(all.end(), b.begin(), b.end());
    return probe_roots(test_kernels()->device(), GetParam(), all);
  }

  void expect_right(const std::vector<Polynomial>& polynomials) const;
};

double value_at(const Polynomial& b, double x) {
  std::vector<double> c(b.begin(), b.end());
  for (std::size_t n = c.size() - 1; n > 0; --n)
    for (std::size_t i = 0; i < n; ++i) c[i] += x * (c[i + 1] - c[i]);
  return c[0];
}

/// A product of polynomials in Bernstein form.
std::vector<double> product(const std::vector<double>& a, const std::vector<double>& b) {
  const auto binomial = [](std::size_t n, std::size_t k) {
    double c = 1.0;
    for (std::size_t i = 1; i <= k; ++i) c = c * double(n - k + i) / double(i);
    return c;
  };
  const std::size_t m = a.size() - 1, n = b.size() - 1;
  std::vector<double> c(m + n + 1, 0.0);
  for (std::size_t i = 0; i <= m; ++i)
    for (std::size_t j = 0; j <= n; ++j) c[i + j] += a[i] * b[j] * binomial(m, i) * binomial(n, j) / binomial(m + n, i + j);
  return c;
}
Polynomial narrow(const std::vector<double>& b, double scale) {
  Polynomial p;
  for (const double c : b) p.push_back(float(scale * c));
  return p;
}

/// What is wrong with `root`, or nothing. A value within 1e-6 of the largest coefficient may count as either side, and at
/// a root 2e-5 may be left to the Newton step that ends every hit.
std::string complaint(const Polynomial& b, float root) {
  double largest = 0.0;
  for (const float c : b) largest = std::max(largest, std::abs(double(c)));
  const double doubt = 1e-6 * largest;
  const double end = root >= 0.0f ? std::min(1.0, double(root)) : 1.0;
  // Nothing before the root (or anywhere, where none was found) may be on the far side beyond doubt.
  for (int k = 0; k <= 1000; ++k)
    if (const double x = end * k / 1000.0; value_at(b, x) < -doubt && x < end - 1e-5) return "passed a root before " + std::to_string(x);
  if (root >= 0.0f && std::abs(value_at(b, end)) > 2e-5 * largest) return "stopped where the value is " + std::to_string(value_at(b, end));
  // Where the first crossing is a clear one, it is the root.
  std::vector<double> crossings;
  append_crossings(std::vector<double>(b.begin(), b.end()), crossings);
  if (crossings.empty()) return "";
  const double x = crossings.front(), slope = (value_at(b, x + 1e-4) - value_at(b, x - 1e-4)) / 2e-4;
  if (slope < -0.1 * largest && std::abs(root - x) > 2e-5) return "not at the crossing " + std::to_string(x);
  return "";
}

void DeviceBernsteinTest::expect_right(const std::vector<Polynomial>& polynomials) const {
  const std::vector<float> roots = device_roots(polynomials);
  int found = 0;
  for (std::size_t i = 0; i < polynomials.size(); ++i) {
    found += roots[i] >= 0.0f;
    ASSERT_EQ(complaint(polynomials[i], roots[i]), "") << ::testing::PrintToString(polynomials[i]) << " root " << roots[i];
  }
  EXPECT_GT(found, int(polynomials.size()) / 8);
}

TEST_P(DeviceBernsteinTest, FindsTheFirstRootOfRandomPolynomials) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<Polynomial> polynomials(3000, Polynomial(GetParam() + 1));
  for (Polynomial& b : polynomials) {
    for (float& c : b) c = normal(random);
    b[0] = std::abs(b[0]) + 1e-3f;
  }
  expect_right(polynomials);
}

TEST_P(DeviceBernsteinTest, FindsTheFirstOfAsManyRootsAsThereCanBe) {
  // prod (x - r_i) with all roots in (0,1), the first one positive at 0.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.02, 0.98);
  std::vector<Polynomial> polynomials;
  for (int k = 0; k < 2000; ++k) {
    std::vector<double> p{1.0};
    for (int i = 0; i < GetParam(); ++i) {
      const double r = uniform(random);
      p = product(p, {r, r - 1.0});
    }
    double largest = 0.0;
    for (const double c : p) largest = std::max(largest, std::abs(c));
    polynomials.push_back(narrow(p, 1.0 / largest));
  }
  expect_right(polynomials);
}

TEST_P(DeviceBernsteinTest, FindsADipBelowZeroHoweverShallow) {
  if (GetParam() == 1) GTEST_SKIP() << "a line does not turn back";
  // (x - r)^2 - e, between steep walls or gentle ones, the far end positive: two roots close together.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform;
  std::vector<Polynomial> polynomials;
  for (int k = 0; k < 3000; ++k) {
    const double r = 0.1 + 0.8 * uniform(random), e = std::pow(10.0, -6.0 * uniform(random)) * 0.01, tilt = 0.9 * uniform(random);
    // Raised to the degree by the positive factor (1 - tilt x)^(n-2).
    std::vector<double> p{r * r - e, r * r - r - e, (1 - r) * (1 - r) - e};
    for (int i = 2; i < GetParam(); ++i) p = product(p, {1.0, 1.0 - tilt});
    polynomials.push_back(narrow(p, 1000.0));
    if (polynomials.back()[0] <= 0.0f) polynomials.back()[0] = 1e-3f;
  }
  expect_right(polynomials);
}

TEST_P(DeviceBernsteinTest, FindsTheRootBeforeAnEndAtWhichTheValueIsAlmostZero) {
  if (GetParam() == 1) GTEST_SKIP() << "a line does not turn back";
  // (r - x)(1 + e - x) with the second root just behind the end: there the value is 0 but for a few roundings, and is no root.
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform;
  std::vector<Polynomial> polynomials;
  for (int k = 0; k < 3000; ++k) {
    const double r = 0.1 + 0.8 * uniform(random), e = std::pow(10.0, -8.0 + 3.0 * uniform(random)), tilt = 0.9 * uniform(random);
    std::vector<double> p = product({r, r - 1.0}, {1.0 + e, e});
    for (int i = 2; i < GetParam(); ++i) p = product(p, {1.0, 1.0 - tilt});
    polynomials.push_back(narrow(p, 1.0));
  }
  expect_right(polynomials);
  const std::vector<float> roots = device_roots(polynomials);
  for (const float root : roots) EXPECT_LT(root, 0.91f);
}

TEST_P(DeviceBernsteinTest, SeesNoRootWhereOneIsJustMissed) {
  if (GetParam() == 1) GTEST_SKIP() << "a line does not turn back";
  // (x - r)^2 + e with e beyond doubt.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform;
  std::vector<Polynomial> polynomials;
  for (int k = 0; k < 2000; ++k) {
    const double r = uniform(random), e = std::pow(10.0, -4.0 * uniform(random)) * 0.1;
    std::vector<double> p{r * r + e, r * r - r + e, (1 - r) * (1 - r) + e};
    while (int(p.size()) <= GetParam()) p = product(p, {1.0, 1.0});
    polynomials.push_back(narrow(p, 1000.0));
  }
  for (const float root : device_roots(polynomials)) ASSERT_EQ(root, -1.0f);
}

using DeviceQuarticTest = DeviceBernsteinTest;
TEST_P(DeviceQuarticTest, FindsTheRootsThatAnImageLost) {
  expect_right({{2100.33f, 70.3226f, -692.753f, -220.221f, 1282.43f}, {0.873265f, -12.2934f, -33.2884f, -26.9711f, 48.1246f}});
}

INSTANTIATE_TEST_SUITE_P(Degrees, DeviceBernsteinTest, ::testing::Values(1, 3, 4, 5, 6, 9));
INSTANTIATE_TEST_SUITE_P(Degrees, DeviceQuarticTest, ::testing::Values(4));

}  // namespace
}  // namespace quincunx
