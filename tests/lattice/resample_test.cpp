#include "lattice/resample.h"

#include <gtest/gtest.h>

#include "lattice/error.h"

namespace quincunx {
namespace {

const World sheared{{1.5, -2.0, 8.0},
                    glm::dmat3(glm::dvec3(0.5, 0.25, 0.0), glm::dvec3(0.0, -2.0, 0.5), glm::dvec3(1.0, 0.0, 4.0))};

/// A Cartesian volume whose sample at (i,j,k) is its own number.
template <class T>
Volume numbered(const Extents& size) {
  Volume volume{LatticeKind::cartesian, size, sheared, std::vector<T>{}, {{"license", "none"}}};
  auto& samples = std::get<std::vector<T>>(volume.samples);
  for (std::int64_t n = 0; n < size.x * size.y * size.z; ++n) samples.push_back(T(n));
  return volume;
}

template <class T>
class Subset : public testing::Test {};
using Types = testing::Types<std::uint8_t, std::int16_t, std::uint16_t, float>;
TYPED_TEST_SUITE(Subset, Types);

TYPED_TEST(Subset, EverySampleOfTheBccSubsetKeepsItsValueTypeAndPlace) {
  // Odd sizes lose their last layer, even ones nothing: floor(size/2) for either coset.
  for (const Extents size : {Extents(4, 6, 8), Extents(5, 7, 3), Extents(2, 2, 2), Extents(3, 2, 5)}) {
    const Volume cartesian = numbered<TypeParam>(size);
    const Volume bcc = bcc_subset(cartesian);
    EXPECT_EQ(bcc.lattice, LatticeKind::bcc);
    EXPECT_EQ(bcc.extents, size / std::int64_t(2));
    EXPECT_EQ(bcc.type(), cartesian.type());
    EXPECT_EQ(bcc.notes, cartesian.notes);
    EXPECT_NO_THROW(check_volume(bcc, "bcc"));
    for (int c = 0; c < 2; ++c)
      for (std::int64_t k = 0; k < bcc.extents.z; ++k)
        for (std::int64_t j = 0; j < bcc.extents.y; ++j)
          for (std::int64_t i = 0; i < bcc.extents.x; ++i) {
            const glm::i64vec3 u = glm::i64vec3(2 * i, 2 * j, 2 * k) + std::int64_t(c);
            EXPECT_EQ(bcc.sample(c, {i, j, k}), cartesian.sample(0, u));
            EXPECT_EQ(bcc.world.to_world(glm::dvec3(u)), cartesian.world.to_world(glm::dvec3(u)));
          }
  }
}

TYPED_TEST(Subset, TheEvenCosetOfABccVolumeKeepsItsValuesAndPlaces) {
  const Volume cartesian = numbered<TypeParam>({6, 5, 4});
  const Volume bcc = bcc_subset(cartesian);
  const Volume even = cartesian_subset(bcc);
  EXPECT_EQ(even.lattice, LatticeKind::cartesian);
  EXPECT_EQ(even.extents, Extents(3, 2, 2));
  EXPECT_EQ(even.type(), cartesian.type());
  EXPECT_EQ(even.notes, cartesian.notes);
  EXPECT_NO_THROW(check_volume(even, "even"));
  for (std::int64_t k = 0; k < 2; ++k)
    for (std::int64_t j = 0; j < 2; ++j)
      for (std::int64_t i = 0; i < 3; ++i) {
        EXPECT_EQ(even.sample(0, {i, j, k}), cartesian.sample(0, {2 * i, 2 * j, 2 * k}));
        EXPECT_EQ(even.world.to_world(glm::dvec3(i, j, k)), cartesian.world.to_world(glm::dvec3(2 * i, 2 * j, 2 * k)));
      }
}

TEST(SubsetErrors, AnAxisOfOneSampleHasNoOddPoints) {
  EXPECT_THROW(bcc_subset(numbered<float>({4, 1, 4})), InputError);
  EXPECT_THROW(bcc_subset(numbered<float>({4, 4, 1})), InputError);
}

TEST(SubsetErrors, TheWrongLatticeIsRefused) {
  const Volume cartesian = numbered<float>({4, 4, 4});
  EXPECT_THROW(cartesian_subset(cartesian), InputError);
  EXPECT_THROW(bcc_subset(bcc_subset(cartesian)), InputError);
}

}  // namespace
}  // namespace quincunx
