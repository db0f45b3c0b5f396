// What kernels are told of a picture.
#include "render/trace_frame.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quincunx {
namespace {

TEST(TraceFrame, TellsNumbersInTwoFloatsThatAddUpToThem) {
  Scene scene;
  scene.width = 300, scene.height = 200;
  scene.step = 0.1, scene.delta = 0.7;
  Coefficients<float> coefficients;
  coefficients.extents = {12, 13, 14};
  coefficients.world.axes = glm::dmat3(0.8, 0.1, 0.03, -0.2, 0.7, 0.07, 0.11, -0.3, 1.3);
  scene.camera = framing_camera(coefficients.lattice, coefficients.extents, coefficients.world, {30.0, 75.0, 1.0}, 300, 200);
  const TraceParameters p = trace_parameters(scene, coefficients);
  const CameraFrame frame = camera_frame(scene.camera, scene.width, scene.height);
  const glm::dmat3 to_lattice = glm::inverse(coefficients.world.axes);
  const auto expect = [](const vec4& hi, const vec4& lo, const glm::dvec3& x) {
    for (int a = 0; a < 3; ++a) {
      EXPECT_EQ(hi[a], float(x[a]));
      EXPECT_NE(lo[a], 0.0f);
      EXPECT_NEAR(double(hi[a]) + double(lo[a]), x[a], std::ldexp(std::abs(x[a]), -47));
    }
  };
  expect(p.forward_hi, p.forward_lo, to_lattice * frame.forward);
  expect(p.right_hi, p.right_lo, to_lattice * frame.right);
  expect(p.up_hi, p.up_lo, to_lattice * frame.up);
  expect(p.world_up, p.world_up_lo, frame.up);
  expect({p.march.x, p.march.y, p.tangent.x, 0.0f}, {p.march.z, p.march.w, p.tangent.y, 0.0f}, {0.1, 0.7, glm::length(frame.right)});
}

}  // namespace
}  // namespace quincunx
