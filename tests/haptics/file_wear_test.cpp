// What files take from the wall.
#include <gtest/gtest.h>

#include "haptics/file/canal_wear.h"
#include "tests/haptics/file_scene.h"

namespace haptics {
namespace {

TEST(CanalWear, HasTheVolumesOfItsLaws) {
  WearSettings settings;
  const double radius_mm = 0.15, lead_mm = 2.0, helix = std::atan(2.0 * std::numbers::pi * radius_mm / lead_mm);
  const auto worn = [&](const glm::dvec2& slip_mm) {
    return wornVolume_mm3(settings, 2.0, 0.5, slip_mm, radius_mm, lead_mm);
  };
  EXPECT_NEAR(worn({-0.1, 0.0}), 3e-4 * 2.0 * 0.1 * std::sin(helix), 1e-12) << "drawn out";
  EXPECT_NEAR(worn({0.1, 0.0}), 0.5 * 3e-4 * 2.0 * 0.1 * std::sin(helix), 1e-12) << "pushed in";
  EXPECT_NEAR(worn({0.0, 0.1}), 3e-4 * 2.0 * 0.1 * std::cos(helix), 1e-12) << "turned";
  // Along its own thread it cuts nothing.
  EXPECT_NEAR(worn({-0.1 * std::cos(helix), -0.1 * std::sin(helix)}), 0.0, 1e-12);

  // Counters: the rate law at the pressure delta / alpha, for edges across the way.
  settings.law = WearLaw::counters;
  const double pressure_N_per_mm2 = settings.counter / settings.alpha_mm3_per_Nmm;
  EXPECT_NEAR(worn({-0.1, 0.0}), settings.alpha_mm3_per_Nmm * pressure_N_per_mm2 * 0.5 * 0.1, 1e-12);
  EXPECT_EQ(worn({0.0, 0.1}), 0.0) << "numbers along the axis: turning takes nothing";
  settings.law = WearLaw::counters_helical;
  EXPECT_NEAR(worn({0.0, 0.1}), settings.counter * 0.5 * 0.1 * std::cos(helix), 1e-12);
}

struct Filed {
  assets::RootCanal canal;
  assets::CanalField field;
  CarvedBone bone;
  CanalWear wear;
  std::uint64_t ticks = 0;

  Filed(const assets::RootCanal& of, const WearSettings& settings)
      : canal(of), field(assets::canalField(of, 0.04)), bone(field.grid, field.solid, {}), wear(settings) {}

  /// Drawn to and fro near the apex.
  void strokes(const assets::KFile& of, int count) {
    const FileChain chain = fileChain(of, kUsualLinks);
    FilePose hand = phantom::above(chain, 0.05);
    FileInCanal file(chain, {}, {true, 0.0}, hand);
    const auto move = [&](double way_mm) {
      const SolidField wall = bone.field();
      FileScene scene;
      scene.wall = &wall;
      hand.translation_mm.z -= way_mm;
      file.step(hand, scene);
      wear.step(file, bone, nullptr, ticks++);
    };
    for (int n = 0; n < 730; ++n) move(0.02);
    for (int stroke = 0; stroke < count; ++stroke)
      for (const double way_mm : {-0.03, 0.03})
        for (int n = 0; n < 50; ++n) move(way_mm);
    // What is due waits for its section's turn.
    for (int n = 0; n < 20; ++n) move(0.0);
  }
  double volume_mm3() const {
    const SolidField now = bone.field();
    double sum = 0.0;
    assets::forVoxels(field.grid, [&](glm::ivec3 ijk, std::size_t v) {
      EXPECT_LE(now.solidAt(ijk), field.solid[v]);
      sum += (field.solid[v] - now.solidAt(ijk)) / 255.0;
    });
    return sum * field.grid.voxelVolume_mm3();
  }
};

TEST(CanalWear, ClosesItsBooks) {
  Filed filed(phantom::bentCanal(), {});
  filed.strokes(*assets::kFile(20, 21, assets::KFileMetal::steel), 10);
  EXPECT_GT(filed.wear.removed_mm3(), 0.004);
  EXPECT_NEAR(filed.wear.removed_mm3() / filed.wear.due_mm3(), 1.0, 0.01);
  EXPECT_NEAR(filed.volume_mm3() / filed.wear.removed_mm3(), 1.0, 0.01) << "as the bytes have it";
}

/// Steel files the outer wall near the apex and more than nickel-titanium: it bears harder.
TEST(CanalWear, SteelMovesTheCanalOutwardsAndMoreThanNickelTitanium) {
  const auto outwards = [](assets::KFileMetal metal) {
    WearSettings settings;
    settings.alpha_mm3_per_Nmm = 2e-3;
    Filed filed(phantom::bentCanal(), settings);
    filed.strokes(*assets::kFile(20, 21, metal), 6);
    const SolidField now = filed.bone.field();
    // By the side of the centre line, in the last 3 mm of the arc's end.
    double outer_mm3 = 0.0, inner_mm3 = 0.0;
    assets::forVoxels(filed.field.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = filed.field.grid.centre_P_mm(ijk);
      const double along_mm = filed.canal.nearest_mm(p);
      if (along_mm < 12.5) return;
      const assets::RootCanal::Place place = filed.canal.at(along_mm);
      const glm::dvec3 towards_centre(-place.along.z, 0.0, place.along.x);
      const double lost = (filed.field.solid[v] - now.solidAt(ijk)) / 255.0 * filed.field.grid.voxelVolume_mm3();
      (glm::dot(p - place.p_mm, towards_centre) > 0.0 ? inner_mm3 : outer_mm3) += lost;
    });
    return outer_mm3 - inner_mm3;
  };
  const double steel = outwards(assets::KFileMetal::steel), alloy = outwards(assets::KFileMetal::nickel_titanium);
  EXPECT_GT(steel, 0.002);
  EXPECT_GT(steel, 2.0 * alloy);
}

}  // namespace
}  // namespace haptics
