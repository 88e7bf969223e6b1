// Which cone of gutta-percha a canal takes.
#include "app/case/fitting_cone.h"

#include <gtest/gtest.h>

#include "assets/synthetic/built_in_teeth.h"

namespace app {
namespace {

/// 12 mm, as wide as that at its orifice and its foramen.
assets::ToothCanal canalOf(double orifice_mm, double foramen_mm) {
  assets::ToothCanal canal;
  for (int n = 0; n <= 60; ++n) {
    const double radius_mm = 0.5 * (orifice_mm + (foramen_mm - orifice_mm) * n / 60.0);
    canal.places.push_back({{0.0, 0.0, -0.2 * n}, 0.2 * n, radius_mm, 1.5 * radius_mm});
  }
  return canal;
}

TEST(FittingCone, IsTheThickestThatReachesTheWorkingLength) {
  // At 11.5 mm they are 0.343, 0.349 and 0.363 mm wide.
  EXPECT_EQ(orderOf(fittingCone(canalOf(0.72, 0.327))), "gp-cone:30,2") << "4 % would bind above";
  EXPECT_EQ(orderOf(fittingCone(canalOf(0.85, 0.327))), "gp-cone:30,4");
  EXPECT_EQ(orderOf(fittingCone(canalOf(1.2, 0.327))), "gp-cone:35,6");
  EXPECT_EQ(orderOf(fittingCone(canalOf(0.3, 0.1))), "gp-cone:15,2") << "none fits: the thinnest";
}

TEST(FittingCone, OfTheBuiltInTeethIsMade) {
  for (const int fdi : {45, 46}) {
    const assets::ToothCanals tooth = assets::canalsOf(assets::builtInTooth({}, fdi));
    for (const assets::ToothCanal& canal : tooth.canals) {
      const assets::GuttaPerchaCone cone = fittingCone(canal);
      EXPECT_TRUE(assets::guttaPerchaCone(cone.size, cone.taper, cone.length_mm)) << orderOf(cone);
      EXPECT_GE(cone.size, 20) << canal.name;
    }
  }
}

}  // namespace
}  // namespace app
