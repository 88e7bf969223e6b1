#include "assets/synthetic/trabecular_texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assets/tissue.h"

namespace assets {
namespace {

TEST(TrabecularTexture, HasTheGreyValueOfCancellousBoneOnAverage) {
  const TrabecularTexture texture(3, 0.15);
  double sum = 0.0;
  int bone = 0, points = 0;
  for (int k = 0; k < 48; ++k)
    for (int j = 0; j < 48; ++j)
      for (int i = 0; i < 48; ++i) {
        const double grey_hu = texture.hounsfield(0.73 * glm::dvec3(i, j, k));
        sum += grey_hu;
        bone += grey_hu > 300.0;
        ++points;
      }
  EXPECT_NEAR(sum / points, properties(static_cast<std::uint8_t>(Tissue::trabecular)).hounsfield, 45.0);
  EXPECT_GT(static_cast<double>(bone) / points, 0.3);
  EXPECT_LT(static_cast<double>(bone) / points, 0.7);
}

TEST(TrabecularTexture, HasPoresOfAMillimetreNotOfAVoxel) {
  // Correlated within a strut, independent after a few pores.
  const TrabecularTexture texture(3, 0.15);
  const auto correlation = [&](double lag_mm) {
    double a_sum = 0.0, b_sum = 0.0, ab = 0.0, aa = 0.0, bb = 0.0;
    constexpr int kPoints = 20000;
    for (int n = 0; n < kPoints; ++n) {
      const glm::dvec3 p(0.91 * (n % 27), 1.07 * (n / 27 % 27), 0.97 * (n / 729));
      const double a = texture.hounsfield(p), b = texture.hounsfield(p + glm::dvec3(lag_mm, 0.0, 0.0));
      a_sum += a;
      b_sum += b;
      ab += a * b;
      aa += a * a;
      bb += b * b;
    }
    const double covariance = ab / kPoints - a_sum / kPoints * b_sum / kPoints;
    return covariance /
           std::sqrt((aa / kPoints - std::pow(a_sum / kPoints, 2)) * (bb / kPoints - std::pow(b_sum / kPoints, 2)));
  };
  EXPECT_GT(correlation(0.1), 0.85);
  EXPECT_LT(correlation(0.6), 0.3);
  EXPECT_NEAR(correlation(9.3), 0.0, 0.15);
}

}  // namespace
}  // namespace assets
