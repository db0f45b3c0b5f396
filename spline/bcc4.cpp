#include "spline/bcc4.h"

#include "spline/bcc4_net.h"
#include "spline/kuhn_spline_bodies.h"

namespace quincunx {

struct Bcc4Shape {
  static constexpr const auto& net = kBcc4Net;
  static constexpr int samples = 4;
  static constexpr int apron = 1;
  static constexpr BccMask mask = kIdentityMask;
};

template class KuhnSpline<1, Bcc4Shape>;

}  // namespace quincunx
