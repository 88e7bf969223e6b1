#include "assets/synthetic/mandibular_canal_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace assets {
namespace {

TEST(MandibularCanalPath, IsAsFarFromAStretchAsFromTheWhole) {
  const DentalArch arch;
  const MandibularCanalPath path(arch, 48.0, 2.0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(5.0, 50.0), y(10.0, 80.0), z(-45.0, 15.0), radius(0.0, 6.0), part(-1.0, 1.0);
  std::size_t segments = 0;
  for (int n = 0; n < 20'000; ++n) {
    const glm::dvec3 centre(x(random), y(random), z(random)), offset(part(random), part(random), part(random));
    const double radius_mm = radius(random);
    const MandibularCanalPath::Stretch stretch = path.stretchNear(centre, radius_mm);
    segments += stretch.end - stretch.first;
    const glm::dvec3 p = centre + radius_mm * offset / std::max(1.0, glm::length(offset));
    ASSERT_EQ(path.lumen_mm(p, stretch), path.lumen_mm(p)) << p.x << ' ' << p.y << ' ' << p.z;
  }
  EXPECT_LT(segments, 20'000 * path.points_J_mm().size() / 2) << "most of it is left out";
}

}  // namespace
}  // namespace assets
