// Incisors and canines set into the front row.
#include "app/case/dentoform_row.h"

#include <gtest/gtest.h>

#include "app/case/prepared_tooth.h"
#include "assets/synthetic/front_row.h"
#include "assets/synthetic/tooth_shape.h"
#include "assets/tooth.h"

namespace app {
namespace {

constexpr double kSpacing_mm = 0.2;

/// Of the row's own form, somewhere else; an upper one turned over.
assets::ToothVolume single(int fdi) {
  const assets::ToothShape& shape = assets::lowerToothShape(assets::positionOf(fdi));
  const glm::dvec3 up = assets::occlusalDirection_P(fdi);
  const glm::dvec3 buccal = glm::normalize(assets::buccalDirection_P(fdi) * glm::dvec3(1.0, 1.0, 0.0));
  // Mesial, whichever side: away from the ear.
  const double side = assets::isRight(fdi) == assets::isUpper(fdi) ? 1.0 : -1.0;
  const glm::dmat3 axes(side * glm::cross(buccal, up), buccal, up);
  assets::VolumeGrid grid{{70, 70, 160}, kSpacing_mm, glm::dvec3(33.0, -27.0, 4.0)};
  const glm::dvec3 neck = grid.centre_P_mm(grid.size / 2) + 3.0 * up;
  std::vector<std::uint8_t> density(grid.voxelCount());
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = glm::transpose(axes) * (grid.centre_P_mm(ijk) - neck);
    const double outer_mm = shape.outer_mm(p);
    if (outer_mm > 0.0) return;
    density[v] = shape.pulp_mm(p) < 0.0 && outer_mm < -0.6 ? std::uint8_t{100}
                 : shape.core_mm(p, outer_mm) > 0.0        ? std::uint8_t{255}
                                                           : std::uint8_t{150};
  });
  return assets::toothVolume(grid, std::move(density), {fdi, assets::kToothLevels, false}, "tooth.nrrd");
}

TEST(DentoformRow, EveryToothOfAdultsHasAPlace) {
  for (const int fdi : {11, 13, 24, 31, 33, 42, 48}) EXPECT_TRUE(isInDentoform(fdi)) << fdi;
  for (const int fdi : {19, 20, 51, 84}) EXPECT_FALSE(isInDentoform(fdi)) << fdi;
}

TEST(DentoformRow, FrontTeethStandBetweenThoseBesideThem) {
  const assets::CtVolume front = assets::frontRow();
  const std::vector<std::pair<int, std::pair<int, int>>> all{
      {41, {31, 42}}, {32, {31, 33}}, {43, {42, 44}}, {11, {21, 12}}, {23, {22, 24}}};
  for (const auto& [fdi, beside] : all) {
    const DentoformTooth made = dentoformTooth(single(fdi), front, fdi, "tooth.nrrd");
    const assets::CtVolume& ct = made.patient.ct;
    std::array<std::size_t, 3> count{};
    double gap_mm = 1e9;
    std::vector<glm::dvec3> own, other;
    assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (ct.solid[v] < 128) return;
      if (ct.tooth[v] == fdi) ++count[0], own.push_back(ct.grid.centre_P_mm(ijk));
      if (ct.tooth[v] == beside.first) ++count[1], other.push_back(ct.grid.centre_P_mm(ijk));
      if (ct.tooth[v] == beside.second) ++count[2];
    });
    EXPECT_GT(count[0], 10000u) << fdi;
    EXPECT_GT(count[1], 5000u) << fdi << ": " << beside.first << " stands mesially";
    EXPECT_GT(count[2], 5000u) << fdi << ": " << beside.second << " stands distally";
    for (std::size_t n = 0; n < own.size(); n += 7)
      for (std::size_t m = 0; m < other.size(); m += 7) gap_mm = std::min(gap_mm, glm::distance(own[n], other[m]));
    EXPECT_LT(gap_mm, 0.8) << fdi << ": they touch";
    ASSERT_TRUE(made.patient.site);
    EXPECT_EQ(made.patient.site->fdi, fdi);
    EXPECT_FALSE(made.patient.gingiva.parts.empty()) << fdi;
  }
}

TEST(DentoformRow, AFrontToothCanBePrepared) {
  const DentoformTooth made = dentoformTooth(single(13), assets::frontRow(), 13, "tooth.nrrd");
  const assets::Patient row = preparedTooth(made.patient, std::nullopt, 13, {"crown:zirconia", ""}, "--tooth");
  ASSERT_TRUE(row.prepared);
  EXPECT_EQ(row.prepared->fdi, 13);
  std::size_t beside = 0;
  for (std::size_t v = 0; v < row.ct.solid.size(); ++v)
    if (assets::Tissue{row.ct.label[v]} == assets::Tissue::other_teeth && row.ct.solid[v] >= 128) ++beside;
  EXPECT_GT(beside, 20'000u);
}

}  // namespace
}  // namespace app
