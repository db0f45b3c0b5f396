#include "spline/linear_program.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <tuple>

namespace quincunx {
namespace {

/// Two nodes (left < right) and the proportion of their coefficients in lowest terms, left_factor > 0.
using Pair = std::tuple<int, int, int, int>;

Pair pair_of(const std::pair<const int, int>& left, const std::pair<const int, int>& right) {
  int divisor = std::gcd(left.second, right.second);
  if (left.second < 0) divisor = -divisor;
  return {left.first, right.first, left.second / divisor, right.second / divisor};
}

/// The pairs that stand in the most forms, at least two.
std::vector<Pair> commonest_pairs(const std::vector<LinearForm>& forms) {
  std::map<Pair, int> counts;
  for (const LinearForm& form : forms)
    for (auto left = form.begin(); left != form.end(); ++left)
      for (auto right = std::next(left); right != form.end(); ++right) ++counts[pair_of(*left, *right)];
  int most = 2;
  std::vector<Pair> commonest;
  for (const auto& [pair, count] : counts) {
    if (count > most) commonest.clear();
    most = std::max(most, count);
    if (count == most) commonest.push_back(pair);
  }
  return commonest;
}

/// Replaces the pair by `node` wherever it stands.
void substitute(std::vector<LinearForm>& forms, const Pair& pair, int node) {
  const auto [left, right, left_factor, right_factor] = pair;
  for (LinearForm& form : forms) {
    const auto l = form.find(left), r = form.find(right);
    if (l == form.end() || r == form.end() || pair_of(*l, *r) != pair) continue;
    const int factor = l->second / left_factor;
    form.erase(l);
    form.erase(r);
    form.emplace(node, factor);
  }
}

/// A small generator whose numbers are the same everywhere (xorshift; G. Marsaglia, Xorshift RNGs, 2003).
struct Random {
  std::uint32_t state;
  std::size_t below(std::size_t n) {
    state ^= state << 13, state ^= state >> 17, state ^= state << 5;
    return state % n;
  }
};

LinearProgram share_once(int inputs, std::vector<LinearForm> forms, Random random) {
  LinearProgram program{inputs, {}, std::move(forms)};
  for (;;) {
    const std::vector<Pair> pairs = commonest_pairs(program.outputs);
    if (pairs.empty()) return program;
    const Pair pair = pairs[random.below(pairs.size())];
    substitute(program.outputs, pair, inputs + int(program.sums.size()));
    const auto [left, right, left_factor, right_factor] = pair;
    program.sums.push_back({left, right, left_factor, right_factor});
  }
}

/// A form as its greatest common divisor, negative where no coefficient is positive, times the nodes of each absolute
/// coefficient.
struct Grouped {
  int content = 0;
  std::map<int, std::vector<std::pair<int, int>>> groups;  // |coefficient| -> (node, sign)
};

Grouped group(const LinearForm& form) {
  Grouped g;
  bool positive = false;
  for (const auto& [node, coefficient] : form) {
    g.content = std::gcd(g.content, coefficient);
    positive = positive || coefficient > 0;
  }
  if (!positive) g.content = -g.content;
  for (const auto& [node, coefficient] : form) {
    const int rest = coefficient / g.content;
    g.groups[std::abs(rest)].emplace_back(node, rest > 0 ? 1 : -1);
  }
  return g;
}

std::string number_text(int numerator, int denominator, const std::string& decimal) {
  const std::string top = std::to_string(std::abs(numerator)) + decimal;
  if (denominator == 1) return top;
  if (denominator == 2 && std::abs(numerator) == 1) return "0.5";
  return "(" + top + " / " + std::to_string(denominator) + decimal + ")";
}

/// Nodes of one absolute coefficient as a sum that starts with a plus where one is positive.
std::string sum_text(const std::vector<std::pair<int, int>>& terms, const std::vector<std::string>& names) {
  std::string text;
  for (const int sign : {1, -1})
    for (const auto& [node, s] : terms)
      if (s == sign) text += (text.empty() ? (s > 0 ? "" : "-") : (s > 0 ? " + " : " - ")) + names[node];
  return text;
}

}  // namespace

int form_operations(const LinearForm& form, int numerator, int denominator) {
  const Grouped g = group(form);
  int operations = int(form.size()) - 1;
  for (const auto& [coefficient, terms] : g.groups) operations += coefficient != 1;
  const int scale = std::abs(g.content * numerator);
  return operations + (scale != denominator ? 1 : 0) + (scale == denominator && g.content * numerator < 0 ? 1 : 0);
}

std::string form_text(const LinearForm& form, const std::vector<std::string>& names, const std::string& decimal,
                      int numerator, int denominator) {
  const Grouped g = group(form);
  // Terms: each group as a factor times a sum; groups that begin with a plus come first.
  std::vector<std::string> plus, minus;
  for (const auto& [coefficient, terms] : g.groups) {
    if (coefficient == 1) {
      for (const auto& [node, sign] : terms) (sign > 0 ? plus : minus).push_back(names[node]);
      continue;
    }
    bool positive = false;
    for (const auto& [node, sign] : terms) positive = positive || sign > 0;
    std::vector<std::pair<int, int>> turned = terms;
    if (!positive)
      for (auto& [node, sign] : turned) sign = -sign;
    const std::string sum = sum_text(turned, names);
    const std::string factor = number_text(coefficient, 1, decimal);
    (positive ? plus : minus).push_back(factor + " * " + (terms.size() > 1 ? "(" + sum + ")" : sum));
  }
  std::string text;
  for (const std::string& term : plus) text += (text.empty() ? "" : " + ") + term;
  for (const std::string& term : minus) text += (text.empty() ? "-" : " - ") + term;

  const int divisor = std::gcd(g.content * numerator, denominator);
  const int top = g.content * numerator / divisor, bottom = denominator / divisor;
  if (top == 1 && bottom == 1) return text;
  const bool atom = form.size() == 1;
  const std::string body = atom ? text : "(" + text + ")";
  const std::string sign = top < 0 ? "-" : "";
  return std::abs(top) == 1 && bottom == 1 ? sign + body : sign + number_text(top, bottom, decimal) + " * " + body;
}

int LinearProgram::operations() const {
  int count = 0;
  for (const SharedSum& s : sums) count += 1 + (std::abs(s.left_factor) != 1) + (std::abs(s.right_factor) != 1);
  for (const LinearForm& form : outputs) count += form_operations(form);
  return count;
}

LinearProgram share_sums(int inputs, const std::vector<LinearForm>& forms, int restarts) {
  assert(restarts >= 1);
  LinearProgram best = share_once(inputs, forms, Random{1});
  for (int n = 2; n <= restarts; ++n) {
    LinearProgram program = share_once(inputs, forms, Random{std::uint32_t(n) * 2654435761u});
    if (program.operations() < best.operations()) best = std::move(program);
  }
  return best;
}

}  // namespace quincunx
