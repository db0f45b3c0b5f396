// Polynomials in three variables with named coefficients, written out as expressions of C or GLSL.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace quincunx {

/// `factor` times the variable `name`.
struct Term {
  int factor;
  std::string name;
};

/// Exponents of x, y, z -> coefficient.
using Polynomial = std::map<std::array<int, 3>, Term>;

/// The derivative by variable `axis`.
Polynomial derivative(const Polynomial& p, int axis);

/// An expression and how many additions and multiplications it is.
struct Expression {
  std::string text;
  int operations = 0;
};

/// Nested Horner form; variable order[0] is the outermost.
Expression horner_text(const Polynomial& p, const std::array<std::string, 3>& variables,
                       const std::array<int, 3>& order);

/// Statements and how many additions and multiplications they are.
struct Statements {
  std::vector<std::string> lines;
  int operations = 0;
};

/// A block that assigns to b0..b<degree> the Bernstein coefficients of a polynomial of that degree with unit factors along
/// start + t step, 0 <= t <= 1: Horner's scheme on polynomials in t, then differences. Locals are of `type`, named
/// after `prefix`.
Statements restriction_text(const Polynomial& p, int degree, const std::array<std::string, 3>& start,
                            const std::array<std::string, 3>& step, const std::array<int, 3>& order,
                            const std::string& type, const std::string& prefix);

}  // namespace quincunx
