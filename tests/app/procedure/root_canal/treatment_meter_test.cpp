// What is measured of changes against the same measured at once, over random cuts and what is put back.
#include "app/procedure/root_canal/treatment_meter.h"

#include <gtest/gtest.h>

#include <random>

#include "app/procedure/root_canal/dense_tooth.h"

namespace app {
namespace {

/// Two straight canals under a chamber in a block of dentine with a ligament around.
struct TwoCanals {
  assets::ToothCanals tooth;
  assets::VolumeGrid grid{{72, 48, 132}, 0.1, {-1.6, -2.4, -10.6}};
  std::vector<std::uint8_t> solid, label;

  TwoCanals() {
    tooth.chamber.outline_mm = {{0.0, 0.0}, {4.0, 0.0}};
    tooth.chamber.round_mm = 0.5;
    tooth.chamber.roof_mm = 1.0, tooth.chamber.floor_mm = 0.0;
    for (const double x : {0.0, 4.0}) {
      assets::ToothCanal canal;
      canal.name = x == 0.0 ? "first" : "second";
      for (int n = 0; n <= 10; ++n) canal.places.push_back({{x, 0.0, -1.0 * n}, 1.0 * n, 0.3, 0.3});
      canal.reference_P_mm = {0.0, 0.0, 2.4};
      tooth.canals.push_back(canal);
    }
    solid.assign(grid.voxelCount(), 255);
    label.assign(grid.voxelCount(), static_cast<std::uint8_t>(assets::Tissue::dentine));
    const assets::PulpDistance pulp(tooth);
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      const double mm = pulp.at_mm(grid.centre_P_mm(ijk));
      solid[v] = static_cast<std::uint8_t>(255.0 * std::clamp(0.5 + mm / grid.spacing_mm, 0.0, 1.0) + 0.5);
      if (mm < 0.0) label[v] = static_cast<std::uint8_t>(assets::Tissue::pulp);
      if (ijk.y < 4 || ijk.y >= 44 || ijk.z < 4) label[v] = static_cast<std::uint8_t>(assets::Tissue::ligament);
    });
  }
};

void expectSame(const Treatment& found, const Treatment& due) {
  ASSERT_EQ(found.canals.size(), due.canals.size());
  for (std::size_t n = 0; n < due.canals.size(); ++n) {
    const CanalOutcomes &a = found.canals[n].outcomes, &b = due.canals[n].outcomes;
    EXPECT_NEAR(a.removed_mm3, b.removed_mm3, 1e-9);
    EXPECT_EQ(a.untouched, b.untouched);
    EXPECT_EQ(a.least_wall_mm, b.least_wall_mm);
    EXPECT_EQ(a.thin_share, b.thin_share);
    EXPECT_EQ(a.schneider_after_rad, b.schneider_after_rad);
    EXPECT_EQ(a.apical_long_mm, b.apical_long_mm);
    EXPECT_EQ(a.taper, b.taper);
    EXPECT_EQ(a.foramen_moved_mm, b.foramen_moved_mm);
    EXPECT_EQ(a.axis_after_P_mm, b.axis_after_P_mm);
    for (std::size_t s = 0; s < kSections_mm.size(); ++s) EXPECT_EQ(a.sections[s].after_mm, b.sections[s].after_mm);
    EXPECT_EQ(found.canals[n].straight_line.least_angle_rad, due.canals[n].straight_line.least_angle_rad);
    EXPECT_EQ(found.canals[n].straight_line.blocked_mm3, due.canals[n].straight_line.blocked_mm3);
  }
  EXPECT_NEAR(found.lost.dentine_mm3, due.lost.dentine_mm3, 1e-9);
  EXPECT_NEAR(found.lost.floor_mm3, due.lost.floor_mm3, 1e-9);
  EXPECT_EQ(found.lost.deepest_mm, due.lost.deepest_mm);
  EXPECT_EQ(found.roof.removed, due.roof.removed);
  EXPECT_EQ(found.roof.overhang_mm3, due.roof.overhang_mm3);
  EXPECT_EQ(found.outline.opened_mm2, due.outline.opened_mm2);
  ASSERT_EQ(found.perforations.size(), due.perforations.size());
  for (std::size_t n = 0; n < due.perforations.size(); ++n) {
    EXPECT_EQ(found.perforations[n].kind, due.perforations[n].kind);
    EXPECT_NEAR(found.perforations[n].area_mm2, due.perforations[n].area_mm2, 1e-9);
  }
}

TEST(TreatmentMeter, FindsAfterEveryCutWhatIsFoundAtOnce) {
  const TwoCanals at;
  const ToothBlocks before(DenseTooth(at.grid, at.solid, at.label));
  const FileUse files(at.tooth);
  TreatmentMeter meter(at.tooth, before);
  std::vector<std::uint8_t> now = at.solid;
  std::mt19937 random(7);
  const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  int holes = 0, opened = 0;
  for (int n = 0; n < 24; ++n) {
    // A ball beside a canal, a way through the roof or the wall; now and then what is there is put back.
    const bool is_roof = n % 3 == 1, is_hole = n % 7 == 3, is_back = n % 5 == 4;
    const glm::dvec3 from(any(-0.5, 4.5), any(-0.3, 0.3), is_roof ? any(0.6, 1.2) : any(-9.5, 0.0));
    const glm::dvec3 way = is_roof ? glm::dvec3(0.0, 0.0, 2.0) : glm::dvec3(0.0, is_hole ? 2.4 : 0.0, 0.0);
    const double radius_mm = any(0.3, 0.8);
    std::vector<bool> is_touched(assets::countIn(at.grid.size / 4));
    assets::forVoxels(at.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 to = at.grid.centre_P_mm(ijk) - from;
      const double along = glm::clamp(glm::dot(to, way) / std::max(glm::dot(way, way), 1e-9), 0.0, 1.0);
      if (glm::distance(to, along * way) > radius_mm) return;
      now[v] = is_back ? at.solid[v] : std::uint8_t{0};
      is_touched[assets::indexIn(at.grid.size / 4, ijk / 4)] = true;
    });
    const DenseTooth tooth(at.grid, now, at.label);
    assets::forVoxels(glm::ivec3(0), at.grid.size / 4, [&](glm::ivec3 block) {
      if (!is_touched[assets::indexIn(at.grid.size / 4, block)]) return;
      ToothNow::Bytes bytes, labels;
      tooth.block(block, bytes, labels);
      meter.change(block, bytes);
    });
    const Treatment found = meter.measure(files);
    if (n % 3 != 0 && n != 23) continue;
    const Treatment due = treatmentOf(at.tooth, before, DenseSolid(at.grid, now), files);
    SCOPED_TRACE(n);
    expectSame(found, due);
    holes += !due.perforations.empty();
    opened += due.roof.removed > 0.0;
  }
  EXPECT_GT(holes, 2);
  EXPECT_GT(opened, 2);
}

TEST(ToothNow, KeepsWhatHasChangedAlone) {
  const TwoCanals at;
  const ToothBlocks before(DenseTooth(at.grid, at.solid, at.label));
  ToothNow now(before);
  ToothNow::Bytes cut{};
  cut[5] = 77;
  EXPECT_EQ(now.set({2, 3, 4}, cut), std::optional<std::size_t>(0));
  EXPECT_FALSE(now.set({2, 3, 4}, cut)) << "nothing is new";
  EXPECT_FALSE(now.set({-1, 0, 0}, cut));
  EXPECT_FALSE(now.set(at.grid.size / 4, cut));
  EXPECT_EQ(now.voxel({9, 13, 16}), 77);
  EXPECT_EQ(now.voxel({8, 12, 16}), 0);
  EXPECT_EQ(now.voxel({12, 12, 16}), before.voxel({12, 12, 16}));
  cut[5] = 78;
  EXPECT_EQ(now.set({2, 3, 4}, cut), std::optional<std::size_t>(0));
  EXPECT_EQ(now.told().size(), 1u);
  EXPECT_EQ(changedBlocks(before, now), std::vector<glm::ivec3>{glm::ivec3(2, 3, 4)});
}

}  // namespace
}  // namespace app
