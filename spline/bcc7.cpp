#include "spline/bcc7.h"

#include "spline/bcc7_net.h"
#include "spline/kuhn_spline_bodies.h"

namespace quincunx {

struct Bcc7Shape {
  static constexpr const auto& net = kBcc7Net;
  static constexpr int samples = 30;
  static constexpr int apron = 1;
  static constexpr BccMask mask = kBcc7Mask;
};

template class KuhnSpline<4, Bcc7Shape>;

}  // namespace quincunx
