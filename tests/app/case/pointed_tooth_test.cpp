// A pointer at every tooth of the built-in arch, and past it.
#include "app/case/pointed_tooth.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "app/case/patient_source.h"
#include "app/case/root_canals.h"

namespace app {
namespace {

TEST(PointedTooth, IsTheToothOnWhichTheRayFallsTwentyTimesATooth) {
  assets::JawParameters jaw;
  jaw.spacing_mm = 0.5;
  const assets::Patient patient = builtInPatient(jaw);
  const assets::CtVolume& ct = patient.ct;
  // What is seen straight from above: the highest solid of each column, found without a ray.
  std::map<int, std::vector<glm::dvec3>> seen;
  for (int j = 0; j < ct.grid.size.y; ++j)
    for (int i = 0; i < ct.grid.size.x; ++i)
      for (int k = ct.grid.size.z - 1; k >= 0; --k) {
        const std::size_t v = ct.grid.index({i, j, k});
        if (ct.solid[v] < assets::kHalfSolid) continue;
        if (ct.tooth[v] != 0) seen[ct.tooth[v]].push_back(ct.grid.centre_P_mm({i, j, k}));
        break;
      }
  std::mt19937 random(5);
  const glm::dvec3 down(0.0, 0.0, -1.0);
  int teeth = 0;
  for (const CanalTooth& tooth : canalTeeth(jaw)) {
    const std::vector<glm::dvec3>& places = seen[tooth.fdi];
    if (!tooth.remark.empty()) continue;  // impacted: not seen from above
    ASSERT_FALSE(places.empty()) << tooth.fdi;
    ++teeth;
    for (int n = 0; n < 20; ++n) {
      const glm::dvec3& p = places[random() % places.size()];
      const auto pointed = pointedTooth(ct, p - 80.0 * down, down);
      ASSERT_TRUE(pointed) << tooth.fdi;
      EXPECT_EQ(*pointed, tooth.fdi);
    }
    EXPECT_GT(markedVoxels_P_mm(ct, tooth.fdi).size(), 20u);
  }
  EXPECT_EQ(teeth, 4) << "44 to 47; 48 is impacted";
  EXPECT_FALSE(pointedTooth(ct, {0.0, 0.0, 500.0}, -down)) << "away from the patient";
  EXPECT_FALSE(pointedTooth(ct, {1e4, 0.0, 0.0}, down)) << "past it";
}

}  // namespace
}  // namespace app
