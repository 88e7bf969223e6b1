#include "app/procedure/jaw_stress.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assets/tissue.h"

namespace app {
namespace {

constexpr auto kCortical = static_cast<std::uint8_t>(assets::Tissue::cortical);

/// A straight bar of bone along y, 12.5 mm wide and 24.5 mm high, and three teeth on it.
struct Bar {
  assets::Patient patient;

  explicit Bar(std::uint8_t label = kCortical) {
    assets::CtVolume& ct = patient.ct;
    ct.grid = {{80, 80, 80}, 0.5, {-20.0, -20.0, -30.0}};
    ct.solid.assign(ct.grid.voxelCount(), 0);
    ct.label.assign(ct.grid.voxelCount(), 0);
    ct.tooth.assign(ct.grid.voxelCount(), 0);
    assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
      if (std::abs(p.x) < 6.1 && std::abs(p.z + 12.0) < 12.1) ct.solid[v] = 255, ct.label[v] = label;
      // Teeth 46, 47, 48 along the bar.
      for (const int place : {0, 1, 2})
        if (p.z > 0.0 && p.z < 4.0 && std::hypot(p.x, p.y - 8.0 * (place - 1)) < 2.0)
          ct.tooth[v] = static_cast<std::uint8_t>(46 + place);
    });
  }
  double modulus_mm3(const glm::dvec3& at_mm, const glm::dvec2& along) const {
    return sectionModulus_mm3(patient.ct.grid, patient.ct.solid, patient.ct.label, at_mm, along);
  }
};

TEST(JawStress, ABarHasTheSectionModulusOfTheTextbook) {
  // b h2 / 6, about the weaker axis.
  constexpr double kSquare_mm3 = 24.5 * 12.5 * 12.5 / 6.0;
  EXPECT_NEAR(Bar().modulus_mm3({0.0, 0.0, 0.0}, {0.0, 1.0}), kSquare_mm3, 0.02 * kSquare_mm3);
  // At 45 degrees the section is wider by the root of two.
  EXPECT_NEAR(Bar().modulus_mm3({0.0, 0.0, 0.0}, {1.0, 1.0}), 2.0 * kSquare_mm3, 0.1 * kSquare_mm3);
  EXPECT_NEAR(Bar(static_cast<std::uint8_t>(assets::Tissue::trabecular)).modulus_mm3({0.0, 0.0, 0.0}, {0.0, 1.0}),
              0.1 * kSquare_mm3, 0.002 * kSquare_mm3);
  EXPECT_EQ(Bar(static_cast<std::uint8_t>(assets::Tissue::other_teeth)).modulus_mm3({0.0, 0.0, 0.0}, {0.0, 1.0}), 0.0);
}

TEST(JawStress, IsForceTimesLeverOverWhatIsLeft) {
  Bar bar;
  JawStress stress(bar.patient);
  haptics::Tick tick;
  std::vector<std::uint8_t> solid = bar.patient.ct.solid;
  const auto jaw = [&] { return solid; };
  stress.follow(tick, jaw);
  EXPECT_FALSE(stress.now_N_per_mm2());
  tick.lever.on_bone_N = 200.0;
  stress.follow(tick, jaw);
  ASSERT_TRUE(stress.now_N_per_mm2());
  const double whole_N_per_mm2 = *stress.now_N_per_mm2();
  EXPECT_NEAR(whole_N_per_mm2, 200.0 * 30.0 / 638.0, 0.2);
  // Half the height is drilled away: measured again elsewhere, or some seconds later.
  assets::forVoxels(bar.patient.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (bar.patient.ct.grid.centre_P_mm(ijk).z > -12.1) solid[v] = 0;
  });
  tick.t_s = 1.0;
  stress.follow(tick, jaw);
  EXPECT_EQ(*stress.now_N_per_mm2(), whole_N_per_mm2);
  tick.lever.fulcrum_P_mm = {0.0, 3.0, 0.0};
  stress.follow(tick, jaw);
  // 12.5 x 12 mm are left.
  EXPECT_NEAR(*stress.now_N_per_mm2(), 200.0 * 30.0 / 300.0, 0.5);
  tick.lever.on_bone_N = 0.0;
  stress.follow(tick, jaw);
  EXPECT_FALSE(stress.now_N_per_mm2());
  EXPECT_NEAR(stress.most_N_per_mm2(), 20.0, 0.5);
}

}  // namespace
}  // namespace app
