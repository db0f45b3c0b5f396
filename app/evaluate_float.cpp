#include "app/evaluate_float.h"

namespace quincunx {

Jet evaluate_float(const Spline& spline, const Coefficients<float>& c, const glm::dvec3& u) {
  // A sample that reaches the domain's border is at most `apron` samples outside it: no weight is wider than that.
  const int step = lattice_step(c.lattice), reach = step * (c.apron + 1);
  float value = 0.0f;
  glm::vec3 gradient(0.0f);
  for (int coset = 0; coset < coset_count(c.lattice); ++coset) {
    const glm::dvec3 at = (u - double(coset)) / double(step);
    const glm::i64vec3 low = glm::max(glm::i64vec3(glm::ceil(at - double(reach) / step)), glm::i64vec3(-c.apron));
    const glm::i64vec3 high =
        glm::min(glm::i64vec3(glm::floor(at + double(reach) / step)), c.extents + std::int64_t(c.apron - 1));
    for (std::int64_t k = low.z; k <= high.z; ++k) {
      for (std::int64_t j = low.y; j <= high.y; ++j) {
        for (std::int64_t i = low.x; i <= high.x; ++i) {
          const glm::i64vec3 index(i, j, k);
          const Jet weight = spline.generator(u - (double(step) * glm::dvec3(index) + double(coset)));
          const float coefficient = c.data[c.number(coset, index)];
          value += coefficient * float(weight.value);
          gradient += coefficient * glm::vec3(weight.gradient);
        }
      }
    }
  }
  return {c.unit.value(double(value)), c.unit.scale * glm::dvec3(gradient)};
}

}  // namespace quincunx
