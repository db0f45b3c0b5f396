#include "spline/linear_program.h"

#include <gtest/gtest.h>

#include "spline/polynomial_text.h"

namespace quincunx {
namespace {

/// A form over the inputs alone: its nodes written out.
LinearForm expand(const LinearProgram& program, const LinearForm& form) {
  LinearForm sum;
  const auto add = [&](const LinearForm& terms, int factor) {
    for (const auto& [node, coefficient] : terms)
      if ((sum[node] += factor * coefficient) == 0) sum.erase(node);
  };
  for (const auto& [node, coefficient] : form) {
    if (node < program.inputs) {
      add({{node, 1}}, coefficient);
      continue;
    }
    const SharedSum& s = program.sums[std::size_t(node - program.inputs)];
    add(expand(program, {{s.left, s.left_factor}, {s.right, s.right_factor}}), coefficient);
  }
  return sum;
}

TEST(LinearProgram, ComputesTheFormsItWasMadeOfWithSharedSumsInAnyProportion) {
  const std::vector<LinearForm> forms = {
      {{0, 1}, {1, 2}, {2, 1}}, {{0, -2}, {1, -4}, {3, 1}}, {{0, 3}, {1, 6}, {2, -1}, {3, 5}}};
  const LinearProgram program = share_sums(4, forms, 5);
  EXPECT_EQ(program.sums.size(), 1u);  // node 0 + 2 node 1
  ASSERT_EQ(program.outputs.size(), forms.size());
  for (std::size_t n = 0; n < forms.size(); ++n) EXPECT_EQ(expand(program, program.outputs[n]), forms[n]);
}

TEST(LinearProgram, CountsWhatItWrites) {
  const std::vector<std::string> names = {"a", "b", "c"};
  EXPECT_EQ(form_text({{0, 1}, {1, -1}}, names, ".0"), "a - b");
  EXPECT_EQ(form_operations({{0, 1}, {1, -1}}), 1);
  EXPECT_EQ(form_text({{0, -2}, {1, 4}, {2, -2}}, names, ".0"), "2.0 * (2.0 * b - a - c)");
  EXPECT_EQ(form_operations({{0, -2}, {1, 4}, {2, -2}}), 4);
  EXPECT_EQ(form_text({{0, -1}, {1, -1}}, names, ""), "-(a + b)");
  EXPECT_EQ(form_operations({{0, -1}, {1, -1}}), 2);
  EXPECT_EQ(form_text({{0, 2}, {1, 2}}, names, ".0", 1, 4), "0.5 * (a + b)");
  EXPECT_EQ(form_text({{0, 4}, {1, 4}}, names, ".0", 1, 4), "a + b");
}

TEST(PolynomialText, IsNestedHornerWithTheFirstVariableOutermost) {
  const Polynomial p = {{{0, 0, 0}, {1, "k"}}, {{1, 0, 0}, {1, "l"}}, {{2, 0, 0}, {3, "m"}}, {{0, 1, 1}, {1, "n"}}};
  const Expression text = horner_text(p, {"x", "y", "z"}, {0, 1, 2});
  EXPECT_EQ(text.text, "k + y * (z * n) + x * (l + x * (3.0 * m))");
  EXPECT_EQ(text.operations, 8);
  EXPECT_EQ(horner_text(derivative(p, 0), {"x", "y", "z"}, {0, 1, 2}).text, "l + x * (6.0 * m)");
}

}  // namespace
}  // namespace quincunx
