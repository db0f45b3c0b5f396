// Straight-line programs for sets of integer linear forms, with their common sums shared.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace quincunx {

/// An integer linear form: node number -> coefficient, none zero.
using LinearForm = std::map<int, int>;

/// left_factor * node left + right_factor * node right.
struct SharedSum {
  int left, right, left_factor, right_factor;
};

/// Nodes 0 .. inputs-1 are the inputs; node inputs + n is sums[n], of earlier nodes; then the outputs, each a form of
/// nodes.
struct LinearProgram {
  int inputs = 0;
  std::vector<SharedSum> sums;
  std::vector<LinearForm> outputs;

  /// Additions, subtractions and multiplications of the whole, as `form_text` writes them.
  int operations() const;
};

/// A program for `forms`: again and again the pair of nodes that stands in the most forms in the same proportion
/// becomes a node of its own. Ties are broken at random, `restarts` times over; the cheapest program is returned. The
/// same arguments give the same program everywhere.
LinearProgram share_sums(int inputs, const std::vector<LinearForm>& forms, int restarts);

/// Additions, subtractions and multiplications of a form times numerator/denominator.
int form_operations(const LinearForm& form, int numerator = 1, int denominator = 1);

/// The form times numerator/denominator as an expression of C or GLSL; names[n] is node n, `decimal` (".0" or "")
/// is appended to integers.
std::string form_text(const LinearForm& form, const std::vector<std::string>& names, const std::string& decimal,
                      int numerator = 1, int denominator = 1);

}  // namespace quincunx
