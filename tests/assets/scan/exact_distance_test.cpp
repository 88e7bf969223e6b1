#include "assets/scan/exact_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "assets/volume_grid.h"

namespace {

TEST(ExactDistance, IsThatOfASearchOfAllCells) {
  std::mt19937 random(11);
  const glm::ivec3 size(9, 13, 7);
  const double spacing_mm = 0.4;
  for (const unsigned one_in : {1U, 3U, 40U, 400U, 1'000'000U}) {
    std::vector<std::uint8_t> chosen(assets::countIn(size));
    for (auto& cell : chosen) cell = random() % one_in == 0 ? 1 : 0;
    const std::vector<float> found_mm = assets::exactDistance_mm(size, spacing_mm, chosen);
    for (std::size_t n = 0; n < chosen.size(); ++n) {
      double nearest_mm = std::numeric_limits<double>::infinity();
      for (std::size_t m = 0; m < chosen.size(); ++m)
        if (chosen[m] != 0)
          nearest_mm =
              std::min(nearest_mm,
                       spacing_mm * glm::length(glm::dvec3(assets::elementAt(size, n) - assets::elementAt(size, m))));
      if (chosen[n] != 0)
        ASSERT_LE(found_mm[n], 0.0F) << n;
      else if (std::isinf(nearest_mm))
        ASSERT_EQ(found_mm[n], std::numeric_limits<float>::infinity()) << n;
      else
        ASSERT_NEAR(static_cast<double>(found_mm[n]), nearest_mm, 1e-5) << n;
    }
  }
}

}  // namespace
