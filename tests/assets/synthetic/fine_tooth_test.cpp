#include "assets/scan/fine_tooth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "assets/load_error.h"
#include "assets/scan/fine_radiograph.h"
#include "assets/synthetic/built_in_teeth.h"
#include "assets/tissue.h"

namespace {

using assets::Tissue;
using assets::ToothSampler;

using Bytes = std::array<std::uint8_t, ToothSampler::kVoxels>;

/// The jaw once, at coarse voxels.
const assets::Patient& coarseJaw() {
  static const assets::Patient kJaw = assets::syntheticJaw({.spacing_mm = 0.4});
  return kJaw;
}

assets::BuiltInTooth firstMolar() { return assets::builtInTooth({}, 46); }

std::uint8_t solidAt(const ToothSampler& tooth, glm::ivec3 ijk, std::uint8_t* label_out = nullptr) {
  Bytes solid, label;
  tooth.block(ijk / 4, solid, label);
  const auto v = static_cast<std::size_t>((ijk.z & 3) * 16 + (ijk.y & 3) * 4 + (ijk.x & 3));
  if (label_out != nullptr) *label_out = label[v];
  return solid[v];
}

glm::ivec3 voxelAt(const ToothSampler& tooth, const glm::dvec3& p_P) {
  return glm::ivec3(glm::round(tooth.grid().indexFromPoint(p_P)));
}

TEST(FineTooth, WhatIsSaidToBeTheSameIsTheSame) {
  const auto tooth = assets::fineBuiltInTooth(firstMolar(), coarseJaw().ct, 0.14);
  int cubes = 0, wrong = 0;
  std::array<int, 2> said{};
  for (const int edge : {4, 16})
    assets::forVoxels(glm::ivec3(0), tooth->grid().size / edge, [&](glm::ivec3 cube) {
      ++cubes;
      const auto same = tooth->same(cube * edge, edge);
      if (!same) return;
      ++said[edge == 4 ? 0 : 1];
      Bytes solid, label;
      assets::forVoxels(cube * (edge / 4), (cube + 1) * (edge / 4), [&](glm::ivec3 block) {
        tooth->block(block, solid, label);
        for (std::size_t v = 0; v < solid.size(); ++v) wrong += solid[v] != same->solid || label[v] != same->label;
      });
    });
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(said[0], cubes / 2) << "most blocks need not be filled";
  EXPECT_GT(said[1], 1);
}

TEST(FineTooth, EveryCanalIsOpenFromTheChamberToItsForamen) {
  for (int position = 4; position <= 8; ++position) {
    const assets::BuiltInTooth built = assets::builtInTooth({}, 40 + position);
    const assets::ToothCanals canals = assets::canalsOf(built);
    const auto tooth = assets::fineBuiltInTooth(built, coarseJaw().ct);
    for (const assets::ToothCanal& canal : canals.canals) {
      for (double along_mm = 0.0; along_mm <= canal.length_mm(); along_mm += 0.1)
        EXPECT_LT(solidAt(*tooth, voxelAt(*tooth, canal.at(along_mm).p_P_mm)), 64)
            << built.fdi << " " << canal.name << " at " << along_mm;
      // Up into the chamber.
      for (double up_mm = 0.0; up_mm < 1.2; up_mm += 0.05)
        EXPECT_LT(solidAt(*tooth, voxelAt(*tooth, canal.orifice_P_mm() + up_mm * canals.frame.axes_P[2])), 64)
            << built.fdi << " " << canal.name << " " << up_mm << " over the orifice";
    }
    // A roof over it.
    const glm::dvec3 over = canals.frame.inP({0.0, 0.0, canals.chamber.roof_mm + 1.0});
    EXPECT_EQ(solidAt(*tooth, voxelAt(*tooth, over)), 255) << built.fdi;
  }
}

// The area of its sections along the way, in a slab of the root where nothing else is air.
TEST(FineTooth, ACanalHoldsTheVolumeOfItsClosedForm) {
  const assets::BuiltInTooth built = firstMolar();
  const assets::ToothCanals canals = assets::canalsOf(built);
  const auto tooth = assets::fineBuiltInTooth(built, coarseJaw().ct);
  for (const assets::ToothCanal& canal : canals.canals) {
    const double from_mm = 4.0, to_mm = 8.0;
    double due_mm3 = 0.0;
    for (double mm = from_mm; mm < to_mm; mm += 0.01) {
      const assets::CanalPlace place = canal.at(mm + 0.005);
      due_mm3 += 0.01 * std::numbers::pi * place.narrow_mm * place.wide_mm;
    }
    // Between the planes across both ends.
    const auto plane = [&](double mm) {
      return std::pair(canal.at(mm).p_P_mm, glm::normalize(canal.at(mm + 0.05).p_P_mm - canal.at(mm - 0.05).p_P_mm));
    };
    const auto first = plane(from_mm), last = plane(to_mm);
    double air_mm3 = 0.0;
    Bytes solid, label;
    assets::forVoxels(
        voxelAt(*tooth, last.first) / 4 - 12, voxelAt(*tooth, first.first) / 4 + 12, [&](glm::ivec3 block) {
          const glm::dvec3 middle = tooth->grid().centre_P_mm(4 * block + 2);
          if (glm::dot(middle - first.first, first.second) < -0.2 || glm::dot(middle - last.first, last.second) > 0.2)
            return;
          double near_mm = 9.0;
          for (double mm = from_mm; mm <= to_mm; mm += 0.25)
            near_mm = std::min(near_mm, glm::distance(middle, canal.at(mm).p_P_mm));
          if (near_mm > 0.9) return;
          tooth->block(block, solid, label);
          std::size_t v = 0;
          assets::forVoxels(4 * block, 4 * block + 4, [&](glm::ivec3 ijk) {
            const glm::dvec3 p = tooth->grid().centre_P_mm(ijk);
            const double air = (255 - solid[v++]) / 255.0;
            if (glm::dot(p - first.first, first.second) >= 0.0 && glm::dot(p - last.first, last.second) <= 0.0)
              air_mm3 += air;
          });
        });
    air_mm3 *= tooth->grid().voxelVolume_mm3();
    EXPECT_NEAR(air_mm3, due_mm3, 0.015 * due_mm3) << canal.name;
  }
}

TEST(FineTooth, TissuesLieInTheirOrder) {
  const assets::BuiltInTooth built = firstMolar();
  const auto tooth = assets::fineBuiltInTooth(built, coarseJaw().ct);
  const auto at = [&](const glm::dvec3& p) {
    std::uint8_t label = 0;
    const std::uint8_t solid = solidAt(*tooth, voxelAt(*tooth, built.frame.inP(p)), &label);
    return std::pair(Tissue{label}, solid);
  };
  EXPECT_EQ(at({0.0, 0.0, 0.0}), std::pair(Tissue::pulp, std::uint8_t{0}));
  EXPECT_EQ(at({0.0, 0.0, 2.5}), std::pair(Tissue::dentine, std::uint8_t{255}));
  // Just below a cusp's tip there is enamel.
  EXPECT_EQ(at({2.65, 2.7, 6.3}), std::pair(Tissue::enamel, std::uint8_t{255}));
  // Off the root: ligament, then bone.
  double out_mm = 0.0;
  while (built.placed.shape.outer_mm({2.35 + out_mm, 0.0, -7.0}) < 0.0) out_mm += 0.01;
  EXPECT_EQ(at({2.35 + out_mm + 0.1, 0.0, -7.0}), std::pair(Tissue::ligament, std::uint8_t{0}));
  EXPECT_TRUE(assets::isHard(static_cast<std::uint8_t>(at({2.35 + out_mm + 0.8, 0.0, -7.0}).first)));
}

TEST(FineTooth, ACanalThinnerThanAVoxelIsRefused) {
  try {
    (void)assets::fineBuiltInTooth(firstMolar(), {}, 0.3);
    FAIL();
  } catch (const assets::LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("thinner than a voxel"), std::string::npos);
  }
}

// Where the beam goes along a canal it is weakened less than 0.6 mm beside it, and far from the tooth as in the scan.
TEST(FineTooth, ARadiographShowsItsCanals) {
  const assets::BuiltInTooth built = firstMolar();
  const assets::ToothCanals canals = assets::canalsOf(built);
  const assets::CtVolume& ct = coarseJaw().ct;
  const auto view = assets::periapicalViewOf(ct, 46, 0.0);
  ASSERT_TRUE(view);
  const std::vector<float> coarse = assets::radiographOf(ct.grid, ct.solid, ct.label, *view);
  const std::vector<float> fine = assets::fineRadiographOf(ct, 46, *assets::fineBuiltInTooth(built, ct, 0.1), *view);
  const auto at = [&](const std::vector<float>& film, const glm::dvec3& p_P, double aside_mm) {
    const glm::dvec3 ray = p_P - view->source_P_mm, n = glm::cross(view->right_P, view->down_P);
    const glm::dvec3 shadow = view->source_P_mm +
                              ray * (glm::dot(view->corner_P_mm - view->source_P_mm, n) / glm::dot(ray, n)) -
                              view->corner_P_mm;
    const glm::ivec2 px(glm::round(
        glm::dvec2(glm::dot(shadow, view->right_P) + aside_mm, glm::dot(shadow, view->down_P)) / view->pixel_mm));
    return static_cast<double>(film[static_cast<std::size_t>(px.y * view->size_px.x + px.x)]);
  };
  const assets::ToothCanal& distal = canals.canals[2];
  double less_mm = 0.0;
  for (double mm = 3.0; mm < 7.0; mm += 0.5) {
    const glm::dvec3 p = distal.at(mm).p_P_mm;
    less_mm += 0.5 * (at(fine, p, -0.6) + at(fine, p, 0.6)) - at(fine, p, 0.0);
  }
  // A width of 1.2 to 0.7 mm through which 0.3 instead of 1.4 is weakened, less what the taper of the root adds.
  EXPECT_GT(less_mm / 8.0, 0.4);
  EXPECT_LT(less_mm / 8.0, 1.5);
  int same = 0;
  for (std::size_t n = 0; n < fine.size(); ++n) same += std::abs(fine[n] - coarse[n]) < 0.02F;
  EXPECT_GT(same, static_cast<int>(fine.size() / 4)) << "the rest of the jaw is as it was";
}

}  // namespace
