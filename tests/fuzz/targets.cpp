#include "tests/fuzz/targets.h"

#include <array>

namespace quincunx::fuzz {

std::span<const Target> targets() {
  static constexpr std::array kTargets{Target{"volume", feed_volume}, Target{"transfer_function", feed_transfer_function},
                                       Target{"camera", feed_camera}, Target{"points", feed_points}, Target{"values", feed_values}};
  return kTargets;
}

}  // namespace quincunx::fuzz
