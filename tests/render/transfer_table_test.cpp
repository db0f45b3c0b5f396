#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "lattice/error.h"
#include "render/transfer_table.h"

namespace quincunx {
namespace {

using testing::HasSubstr;

/// Two bumps, one reaching opacity 1, a jump in colour and in opacity, points that lie between entries.
TransferFunction lively() {
  return {.colors = {{-3.0, {1, 0, 0}}, {0.7, {0, 1, 0.5}}, {0.7000001, {0.2, 0, 1}}, {6.1, {1, 1, 0}}},
          .opacities = {{-2.0, 0}, {-1.3, 1}, {-0.4, 0}, {1.9, 0}, {2.0, 0.3}, {2.000001, 0.8}, {4.0, 0.05}, {5.5, 0}},
          .unit = 1.5};
}

double tau(const TransferFunction& f, double value, double unit) {
  return -std::log(std::max(1.0 - f.opacity(value), 0x1p-24)) / unit;
}

template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(TransferFunction, IsLinearBetweenItsPointsAndConstantOutside) {
  const TransferFunction f{.colors = {{1.0, {0, 0.5, 1}}, {3.0, {1, 0.5, 0}}}, .opacities = {{0.0, 0.2}, {4.0, 0.6}}};
  EXPECT_EQ(f.color(-7.0), glm::dvec3(0, 0.5, 1));
  EXPECT_EQ(f.color(2.5), glm::dvec3(0.75, 0.5, 0.25));
  EXPECT_EQ(f.color(3.0), glm::dvec3(1, 0.5, 0));
  EXPECT_DOUBLE_EQ(f.opacity(1.0), 0.3);
  EXPECT_EQ(f.opacity(1e300), 0.6);
  EXPECT_EQ(f.low(), 0.0);
  EXPECT_EQ(f.high(), 4.0);
}

TEST(TransferFunction, NumbersOutOfRangeAreErrorsThatNameThem) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto broken = [](const auto& breaking) {
    TransferFunction f{.colors = {{0, {0, 0, 0}}, {1, {1, 1, 1}}}, .opacities = {{0, 0}, {1, 1}}};
    EXPECT_EQ(error_of([&] { check_transfer_function(f, "f.json"); }), "no error");
    breaking(f);
    return error_of([&] { check_transfer_function(f, "f.json"); });
  };
  using F = TransferFunction;
  EXPECT_THAT(broken([](F& f) { f.colors.clear(); }), HasSubstr("f.json: \"colors\" has no point"));
  EXPECT_THAT(broken([](F& f) { f.opacities.pop_back(); }), HasSubstr("\"opacities\" has 1 points; expected at least two"));
  for (const double x : {nan, inf, -1e38, 1e300}) {
    EXPECT_THAT(broken([&](F& f) { f.colors[1].value = x; }), HasSubstr("point 1 of \"colors\" has the value"));
    EXPECT_THAT(broken([&](F& f) { f.opacities[0].value = x; }), HasSubstr("point 0 of \"opacities\" has the value"));
  }
  for (const double x : {0.0, -1.0}) EXPECT_THAT(broken([&](F& f) { f.opacities[1].value = x; }), HasSubstr("expected ascending values"));
  for (const double x : {nan, inf, -0.1, 1.1}) {
    EXPECT_THAT(broken([&](F& f) { f.colors[1].color.g = x; }), HasSubstr("the colour at 1 is 1"));
    EXPECT_THAT(broken([&](F& f) { f.opacities[1].opacity = x; }), HasSubstr("the opacity at 1 is"));
  }
  for (const double x : {nan, inf, -1.0}) EXPECT_THAT(broken([&](F& f) { f.unit = x; }), HasSubstr("\"unit\" is"));
}

TEST(TransferTable, HoldsWhatAStretchAddsAtEachEntrysValue) {
  const TransferFunction f = lively();
  for (const int entries : {77, 256, 8192}) {
    const TransferTable table = bake(f, entries, 0.4, 99.0);
    ASSERT_EQ(table.entries.size(), std::size_t(entries));
    for (int n = 0; n < entries; ++n) {
      const double value = double(table.low) + (double(table.high) - double(table.low)) * n / (entries - 1);
      const double alpha = 1.0 - std::exp(-tau(f, value, 1.5) * 0.4);
      const glm::vec4 entry = table.entries[std::size_t(n)];
      EXPECT_NEAR(entry.a, alpha, 1e-7) << value;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(entry[c], alpha * f.color(value)[c], 1e-7) << value;
      EXPECT_EQ(entry == glm::vec4(0.0f), f.opacity(value) == 0.0) << value;
    }
  }
}

TEST(TransferTable, TakesTheCallersUnitWhereTheFunctionHasNone) {
  TransferFunction f = lively();
  const TransferTable own = bake(f, 100, 0.4, 99.0);
  f.unit = 0.0;
  EXPECT_EQ(bake(f, 100, 0.4, 1.5).entries, own.entries);
}

TEST(TransferTable, OfTransparentValuesOutsideItIsExactlyTransparentAtItsEnds) {
  // 0.1 and 0.7 as floats lie inside (0.1, 0.7): rounded to the nearest, the first and last entry would have opacity.
  const TransferFunction f{.colors = {{0.3, {1, 1, 1}}}, .opacities = {{0.1, 0}, {0.11, 1}, {0.69, 1}, {0.7, 0}}};
  ASSERT_GT(double(0.1f), 0.1);
  ASSERT_LT(double(0.7f), 0.7);
  const TransferTable table = bake(f, 256, 1.0, 1.0);
  EXPECT_LE(double(table.low), 0.1);
  EXPECT_GE(double(table.high), 0.7);
  EXPECT_EQ(table.entries.front(), glm::vec4(0.0f));
  EXPECT_EQ(table.entries.back(), glm::vec4(0.0f));
  const PreIntegratedTable integrated = pre_integrate(f, 64, 1.0, 1.0);
  EXPECT_EQ(integrated.cells.front(), glm::vec4(0.0f));
  EXPECT_EQ(integrated.cells.back(), glm::vec4(0.0f));
}

TEST(TransferTable, RefusesToMissAStretchAndSaysHowManyEntriesMeetIt) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-50.0, 50.0), logarithm(-3.0, 1.0);
  int refused = 0;
  for (int n = 0; n < 300; ++n) {
    const double middle = at(random), width = std::pow(10.0, logarithm(random));
    const TransferFunction f{.colors = {{0, {1, 1, 1}}},
                             .opacities = {{-100, 0.5}, {-90, 0}, {middle - width, 0}, {middle, 0.8}, {middle + width, 0}, {100, 0}}};
    int met = 0;
    for (int k = 0; k < 256; ++k) met += std::abs(-100.0 + 200.0 * k / 255.0 - middle) < width * (1.0 - 1e-9);
    const std::string error = error_of([&] { bake(f, 256, 1.0, 1.0); });
    EXPECT_EQ(error == "no error", met > 0) << error;
    if (met > 0) continue;
    ++refused;
    EXPECT_THAT(error, HasSubstr("--tf-entries: none of 256 entries"));
    const std::size_t words = error.find("at least ");
    if (words == std::string::npos) {
      EXPECT_THAT(error, HasSubstr("wider stretch"));
      EXPECT_LT(2.0 * width, 200.0 / 8190.0);
    } else {
      const int wanted = std::stoi(error.substr(words + 9));
      EXPECT_LE(wanted, 8192);
      EXPECT_NO_THROW(bake(f, wanted, 1.0, 1.0)) << error;
    }
  }
  EXPECT_GT(refused, 50);
  // 101 entries stand at 0, 1, 2 ...; one more is needed for one to stand between 0 and 1.
  const TransferFunction f{.colors = {{0, {1, 1, 1}}}, .opacities = {{0, 0}, {0.5, 1}, {1, 0}, {100, 0}}};
  EXPECT_THAT(error_of([&] { bake(f, 101, 1.0, 1.0); }), HasSubstr("values 0 and 1; expected at least 102"));
  EXPECT_NO_THROW(bake(f, 102, 1.0, 1.0));
}

TEST(TransferTable, WithoutAnyOpacityIsAllZero) {
  const TransferFunction f{.colors = {{0, {1, 1, 1}}}, .opacities = {{0, 0}, {10, 0}}};
  for (const glm::vec4& entry : bake(f, 64, 1.0, 1.0).entries) EXPECT_EQ(entry, glm::vec4(0.0f));
  for (const glm::vec4& cell : pre_integrate(f, 64, 1.0, 1.0).cells) EXPECT_EQ(cell, glm::vec4(0.0f));
}

/// A stretch from value a to b front to back in thin slices, so many from one point of the function to the next, thinnest there.
glm::dvec4 brute_force(const TransferFunction& f, double a, double b, double length, int slices) {
  std::vector<double> ends{a, b};
  for (const auto& point : f.colors) ends.push_back(point.value);
  for (const auto& point : f.opacities) ends.push_back(point.value);
  std::erase_if(ends, [&](double s) { return s < std::min(a, b) || s > std::max(a, b); });
  std::ranges::sort(ends);
  if (a > b) std::ranges::reverse(ends);
  glm::dvec4 sum(0.0);
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    for (int n = 0; n < slices; ++n) {
      const auto graded = [&](int m) { return double(m) / slices * double(m) / slices * (3.0 - 2.0 * double(m) / slices); };
      const double from = graded(n), to = graded(n + 1), value = ends[k] + (ends[k + 1] - ends[k]) * 0.5 * (from + to);
      const double part = (to - from) * (a == b ? 1.0 : (ends[k + 1] - ends[k]) / (b - a));
      sum += (1.0 - sum.a) * -std::expm1(-tau(f, value, f.unit) * length * part) * glm::dvec4(f.color(value), 1.0);
    }
  return sum;
}

double value_of(const PreIntegratedTable& table, int n) {
  return double(table.low) + (double(table.high) - double(table.low)) * n / (table.entries - 1);
}

TEST(PreIntegration, AgreesWithThinSlicesOfTheStretch) {
  const TransferFunction f = lively();
  std::mt19937 random(3);
  // Short stretches, and such as let next to nothing through.
  for (const double length : {0.01, 0.6, 20.0, 400.0}) {
    const int entries = 61;
    const PreIntegratedTable table = pre_integrate(f, entries, length, 1.0);
    ASSERT_EQ(table.cells.size(), 61u * 61u);
    std::uniform_int_distribution<int> entry(0, entries - 1);
    for (int n = 0; n < 40; ++n) {
      const int front = entry(random), back = n % 4 == 0 ? front : n % 4 == 1 ? std::min(front + 1, entries - 1) : entry(random);
      const glm::dvec4 expected = brute_force(f, value_of(table, front), value_of(table, back), length, 4000);
      const glm::vec4 found = table.cells[std::size_t(back * entries + front)];
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(found[c], expected[c], 1e-6) << front << " " << back << " length " << length;
    }
  }
}

TEST(PreIntegration, OfALinearOpacityIsTheClosedForm) {
  // p = 1 - s from 1 to 0: the mean of -ln p between 1 - a and 1 - b is 1 + (p ln p) differences; colours equal, so C = alpha c.
  const TransferFunction f{.colors = {{0, {0.25, 0.5, 1}}}, .opacities = {{0, 0}, {1, 1}}, .unit = 2.0};
  const int entries = 33;
  const PreIntegratedTable table = pre_integrate(f, entries, 3.0, 1.0);
  const auto term = [](double p) { return p == 0.0 ? 0.0 : p * std::log(p) - p; };
  for (int front = 0; front < entries; ++front)
    for (int back = 0; back < entries; ++back) {
      if (front == back) continue;
      const double pa = 1.0 - front / 32.0, pb = 1.0 - back / 32.0;
      const double alpha = -std::expm1(3.0 / 2.0 * (term(pb) - term(pa)) / (pb - pa));
      const glm::vec4 cell = table.cells[std::size_t(back * entries + front)];
      EXPECT_NEAR(cell.a, alpha, 2e-7) << front << " " << back;
      EXPECT_NEAR(cell.g, 0.5 * alpha, 2e-7);
    }
}

TEST(PreIntegration, IsExactlyZeroWhereNoOpacityLiesBetweenTheValues) {
  const TransferFunction f = lively();
  const int entries = 200;
  const PreIntegratedTable table = pre_integrate(f, entries, 1.0, 1.0);
  const auto opaque = [](double a, double b) {  // open ranges of opacity of lively()
    return (b > -2.0 && a < -0.4) || (b > 1.9 && a < 5.5);
  };
  int clear = 0;
  for (int front = 0; front < entries; ++front)
    for (int back = 0; back < entries; ++back) {
      const double a = value_of(table, std::min(front, back)), b = value_of(table, std::max(front, back));
      const glm::vec4 cell = table.cells[std::size_t(back * entries + front)];
      if (opaque(a, b)) {
        EXPECT_GT(cell.a, 0.0f) << a << " " << b;
      } else {
        EXPECT_EQ(cell, glm::vec4(0.0f)) << a << " " << b;
        ++clear;
      }
    }
  EXPECT_GT(clear, 1000);
}

TEST(PreIntegration, HasTheSameAlphaBothWaysAndSeesTheFrontFirst) {
  // Red below, blue above, opaque throughout: from red to blue shows more red than from blue to red.
  const TransferFunction f{.colors = {{0, {1, 0, 0}}, {1, {0, 0, 1}}}, .opacities = {{0, 0.7}, {1, 0.7}}, .unit = 1.0};
  const PreIntegratedTable table = pre_integrate(f, 16, 2.0, 1.0);
  for (std::size_t front = 0; front < 16; ++front)
    for (std::size_t back = front + 1; back < 16; ++back) {
      const glm::vec4 up = table.cells[back * 16 + front], down = table.cells[front * 16 + back];
      EXPECT_NEAR(up.a, down.a, 1e-6);
      EXPECT_GT(up.r, down.r);
      EXPECT_LT(up.b, down.b);
    }
}

TEST(PreIntegration, MeetsAPeakBetweenTwoEntries) {
  const TransferFunction f{.colors = {{0, {1, 1, 1}}}, .opacities = {{0, 0}, {50.01, 0}, {50.02, 1}, {50.03, 0}, {100, 0}}, .unit = 1.0};
  const PreIntegratedTable table = pre_integrate(f, 16, 5.0, 1.0);
  EXPECT_GT(table.cells[8 * 16 + 7].a, 0.0f);
  const glm::dvec4 expected = brute_force(f, value_of(table, 3), value_of(table, 12), 5.0, 10000);
  EXPECT_NEAR(table.cells[12 * 16 + 3].a, expected.a, 1e-6);
  EXPECT_EQ(table.cells[7 * 16 + 6].a, 0.0f);
}

}  // namespace
}  // namespace quincunx
