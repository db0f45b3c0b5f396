// Prefilters by name, and splines by lattice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "lattice/error.h"
#include "spline/spline.h"

namespace quincunx {
namespace {

using Prefilter = Spline::Prefilter;

TEST(Filters, OfEverySplineEndInNoneAndAutomaticIsTheFirst) {
  for (const std::string_view name : spline_names()) {
    const auto spline = make_spline(name);
    ASSERT_FALSE(spline->filters().empty()) << name;
    EXPECT_EQ(&spline->filter(Prefilter::automatic), &spline->filters().front()) << name;
    const Spline::Filter& none = spline->filters().back();
    EXPECT_TRUE(none.kind == Prefilter::none && none.reach == 0 && none.gain == 1.0) << name;
  }
}

TEST(Filters, ThatASplineDoesNotHaveAreRefusedNamingThoseItHas) {
  try {
    make_spline("bcc7")->filter(Prefilter::iir);
    FAIL() << "bcc7 has no iir";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--prefilter: found iir, expected one that the spline bcc7 has: auto, fir, none");
  }
  EXPECT_THROW(make_spline("trilinear")->filter(Prefilter::fir), InputError);
}

TEST(Splines, OfTheOtherLatticeAreRefused) {
  EXPECT_EQ(make_spline("", LatticeKind::bcc)->name(), "bcc7");
  EXPECT_EQ(make_spline("tricubic", LatticeKind::cartesian)->name(), "tricubic");
  try {
    make_spline("tricubic", LatticeKind::bcc);
    FAIL() << "tricubic is Cartesian";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("--spline: found a volume on the bcc"), testing::HasSubstr("tricubic")));
  }
}

}  // namespace
}  // namespace quincunx
