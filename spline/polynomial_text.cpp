#include "spline/polynomial_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace quincunx {
namespace {

/// The polynomials in the other variables that multiply the powers of variable `axis`.
std::vector<Polynomial> by_power(const Polynomial& p, int axis) {
  std::vector<Polynomial> parts;
  for (const auto& [exponents, term] : p) {
    const std::size_t power = std::size_t(exponents[axis]);
    if (parts.size() <= power) parts.resize(power + 1);
    auto rest = exponents;
    rest[axis] = 0;
    parts[power].emplace(rest, term);
  }
  return parts;
}

Expression term_text(const Term& term) {
  if (term.factor == 1) return {term.name, 0};
  return {std::to_string(term.factor) + ".0 * " + term.name, 1};
}

Expression horner(const Polynomial& p, const std::array<std::string, 3>& variables, const std::array<int, 3>& order,
                  std::size_t depth) {
  if (depth == 3) {
    assert(p.size() == 1);
    return term_text(p.begin()->second);
  }
  const int axis = order[depth];
  const std::vector<Polynomial> parts = by_power(p, axis);
  Expression sum = horner(parts.back(), variables, order, depth + 1);
  for (std::size_t n = parts.size() - 1; n-- > 0;) {
    const bool atom = sum.text.find(' ') == std::string::npos;
    sum.text = variables[axis] + " * " + (atom ? sum.text : "(" + sum.text + ")");
    ++sum.operations;
    if (parts[n].empty()) continue;
    const Expression lower = horner(parts[n], variables, order, depth + 1);
    sum.text = lower.text + " + " + sum.text;
    sum.operations += lower.operations + 1;
  }
  return sum;
}

/// Horner's scheme on polynomials in t; a polynomial is the names of its coefficients, the constant first.
class LineRestriction {
 public:
  LineRestriction(const std::array<std::string, 3>& start, const std::array<std::string, 3>& step,
                  const std::array<int, 3>& order, std::string type, std::string prefix)
      : start_(start), step_(step), order_(order), type_(std::move(type)), prefix_(std::move(prefix)) {}

  std::vector<std::string> restricted(const Polynomial& p, std::size_t depth) {
    if (depth == 3) {
      assert(p.size() == 1 && p.begin()->second.factor == 1);
      return {p.begin()->second.name};
    }
    const int axis = order_[depth];
    const std::vector<Polynomial> parts = by_power(p, axis);
    std::vector<std::string> sum = restricted(parts.back(), depth + 1);
    for (std::size_t n = parts.size() - 1; n-- > 0;)
      sum = multiply_add(sum, axis, parts[n].empty() ? std::vector<std::string>{} : restricted(parts[n], depth + 1));
    return sum;
  }

  std::string define(const std::string& text, int operations) {
    const std::string name = prefix_ + std::to_string(next_++);
    statements_.lines.push_back("  " + type_ + " " + name + " = " + text + ";");
    statements_.operations += operations;
    return name;
  }
  void assign(const std::string& to, const std::string& text, int operations) {
    statements_.lines.push_back("  " + to + " = " + text + ";");
    statements_.operations += operations;
  }
  const Statements& statements() const { return statements_; }

 private:
  /// (start + t step) * p + q.
  std::vector<std::string> multiply_add(const std::vector<std::string>& p, int axis,
                                        const std::vector<std::string>& q) {
    std::vector<std::string> product;
    for (std::size_t n = 0; n < std::max(p.size() + 1, q.size()); ++n) {
      std::string text = n < p.size() ? p[n] + " * " + start_[axis] : "";
      int operations = n < p.size() ? 1 : 0;
      const auto add = [&](const std::string& term, int cost) {
        operations += cost + (text.empty() ? 0 : 1);
        text += (text.empty() ? "" : " + ") + term;
      };
      if (n > 0 && n <= p.size()) add(p[n - 1] + " * " + step_[axis], 1);
      if (n < q.size()) add(q[n], 0);
      product.push_back(define(text, operations));
    }
    return product;
  }

  const std::array<std::string, 3>&start_, &step_;
  const std::array<int, 3>& order_;
  const std::string type_, prefix_;
  int next_ = 0;
  Statements statements_;
};

}  // namespace

Polynomial derivative(const Polynomial& p, int axis) {
  Polynomial slope;
  for (const auto& [exponents, term] : p) {
    if (exponents[axis] == 0) continue;
    auto lower = exponents;
    --lower[axis];
    slope.emplace(lower, Term{term.factor * exponents[axis], term.name});
  }
  return slope;
}

Expression horner_text(const Polynomial& p, const std::array<std::string, 3>& variables,
                       const std::array<int, 3>& order) {
  return horner(p, variables, order, 0);
}

Statements restriction_text(const Polynomial& p, int degree, const std::array<std::string, 3>& start,
                            const std::array<std::string, 3>& step, const std::array<int, 3>& order,
                            const std::string& type, const std::string& prefix) {
  LineRestriction line(start, step, order, type, prefix);
  const std::vector<std::string> a = line.restricted(p, 0);
  const std::size_t n = std::size_t(degree);
  assert(a.size() == n + 1);
  // The differences of Bernstein coefficients at t = 0 are a_k / binomial(n, k); sum them up.
  std::vector<std::string> d = a, b = {a[0]};
  int binomial = 1;
  for (std::size_t k = 1; k < n; ++k) {
    binomial = binomial * int(n - k + 1) / int(k);
    d[k] = line.define(fmt::format("{} * {}", binomial == 4 ? "0.25" : fmt::format("(1.0 / {}.0)", binomial), a[k]), 1);
  }
  const auto sum = [](const std::string& left, const std::string& right) { return left + " + " + right; };
  for (std::size_t m = 1; m <= n; ++m) {
    for (std::size_t k = m - 1; k > 0; --k) d[k] = line.define(sum(d[k], d[k + 1]), 1);
    b.push_back(m < n ? line.define(sum(b.back(), d[1]), 1) : sum(b.back(), d[1]));
  }
  for (std::size_t m = 0; m <= n; ++m) line.assign(fmt::format("b{}", m), b[m], m == n ? 1 : 0);
  Statements statements = line.statements();
  statements.lines.insert(statements.lines.begin(), "{");
  statements.lines.push_back("}");
  return statements;
}

}  // namespace quincunx
