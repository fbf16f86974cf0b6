// Combined normals against the displaced surface. The bounds are what was measured, with a fifth to spare.

#include "rig/wrinkles/wrinkle_error.h"

#include <gtest/gtest.h>

namespace blush {
namespace {

NormalError error_of(WrinkleEncoding encoding, double steepest, double weight, float range = 1,
                     bool eight_bits = true) {
    WrinkleErrorCase of;
    of.encoding = encoding;
    of.steepest_degrees = steepest;
    of.weight = weight;
    of.range = range;
    of.eight_bits = eight_bits;
    return wrinkle_normal_error(of);
}

TEST(WrinkleError, DerivativesAddUpAtEveryWeight) {
    for (const double weight : {0.5, 1.0, -0.5}) {
        const NormalError error = error_of(WrinkleEncoding::derivatives, 30, weight);
        EXPECT_LT(error.mean_degrees, 0.4) << weight;
        EXPECT_LT(error.percentile99_degrees, 1.0) << weight;
    }
}

// 8.2.1 does not say so: the path between two normals is not the path of the surface, so differences are right at full
// weight and wrong between, and the more so the steeper the folds.
TEST(WrinkleError, DifferencesAreRightAtFullWeightOnly) {
    EXPECT_LT(error_of(WrinkleEncoding::differences, 30, 1).percentile99_degrees, 1.2);
    const NormalError half = error_of(WrinkleEncoding::differences, 45, 0.5);
    EXPECT_GT(half.mean_degrees, 1.5);
    EXPECT_LT(half.percentile99_degrees, 6);
    EXPECT_LT(error_of(WrinkleEncoding::derivatives, 45, 0.5).percentile99_degrees, 1);
    EXPECT_GT(error_of(WrinkleEncoding::differences, 45, -0.5).percentile99_degrees, 9);
}

// 8.2.1: derivatives "cannot represent anything that falls outside of a 45 degree cone"; a wider range can, at half the
// precision.
TEST(WrinkleError, BeyondFortyFiveDegreesTheRangeDecides) {
    EXPECT_GT(error_of(WrinkleEncoding::derivatives, 60, 1, 1).percentile99_degrees, 13);
    EXPECT_LT(error_of(WrinkleEncoding::derivatives, 60, 1, 2).percentile99_degrees, 1.3);
}

TEST(WrinkleError, EightBitsCostLessThanHalfADegree) {
    const NormalError coarse = error_of(WrinkleEncoding::derivatives, 15, 0.5),
                      fine = error_of(WrinkleEncoding::derivatives, 15, 0.5, 1, false);
    EXPECT_GT(coarse.mean_degrees, fine.mean_degrees);
    EXPECT_LT(coarse.percentile99_degrees, fine.percentile99_degrees + 0.5);
}

}  // namespace
}  // namespace blush
