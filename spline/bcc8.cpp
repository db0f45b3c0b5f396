#include "spline/bcc8.h"

#include "spline/bcc8_net.h"
#include "spline/kuhn_spline_bodies.h"

namespace quincunx {

struct Bcc8Shape {
  static constexpr const auto& net = kBcc8Net;
  static constexpr int samples = 32;
  static constexpr int apron = 2;
  static constexpr BccMask mask = kBcc8Mask;
};

template class KuhnSpline<5, Bcc8Shape>;

}  // namespace quincunx
