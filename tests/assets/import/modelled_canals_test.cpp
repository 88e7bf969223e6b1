#include "assets/import/modelled_canals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "assets/import/root_course.h"
#include "assets/load_error.h"
#include "assets/synthetic/built_in_teeth.h"

namespace assets::canals_of_a_scan {
namespace {

constexpr int kFdi = 48;

/// The built-in jaw as a scan of 0.3 mm: its third molar has enamel, dentine and pulp.
const CtVolume& scan() {
  static const Patient kPatient = syntheticJaw({.spacing_mm = 0.3});
  return kPatient.ct;
}
const ToothCanals& modelled() {
  static const ToothCanals kCanals = modelledCanals(scan(), kFdi);
  return kCanals;
}

std::string refusal(const CtVolume& ct, int fdi) {
  try {
    (void)modelledCanals(ct, fdi);
  } catch (const LoadError& error) {
    return error.what();
  }
  return "";
}

TEST(ModelledCanals, AScannedThirdMolarHasTwoRootsAndThreeCanals) {
  const std::vector<RootCourse> roots = rootCourses(scan(), kFdi, toothFrame(scan(), kFdi));
  ASSERT_EQ(roots.size(), 2U);
  EXPECT_GT(roots[0].slices.back().middle_mm.x, roots[1].slices.back().middle_mm.x) << "from mesial to distal";
  EXPECT_TRUE(modelled().is_modelled);
  ASSERT_EQ(modelled().canals.size(), 3U);
  EXPECT_EQ(modelled().canals[0].name, "mesiobuccal");
  EXPECT_EQ(modelled().canals[1].name, "mesiolingual");
  EXPECT_EQ(modelled().canals[2].name, "distal");
}

// The shape that was scanned is known: its axes, and dentine around every canal.
TEST(ModelledCanals, LieInTheRootsOfTheShapeThatWasScanned) {
  const BuiltInTooth truth = builtInTooth({}, kFdi);
  const ToothCanals& found = modelled();
  EXPECT_GT(glm::dot(found.frame.axes_P[2], truth.frame.axes_P[2]), std::cos(8.0 * std::numbers::pi / 180.0));
  EXPECT_GT(glm::dot(found.frame.axes_P[0], truth.frame.axes_P[0]), 0.85);
  EXPECT_GT(glm::dot(found.frame.axes_P[1], truth.frame.axes_P[1]), 0.85);
  for (const ToothCanal& canal : found.canals) {
    for (const CanalPlace& place : canal.places) {
      const double wall_mm = -truth.placed.shape.outer_mm(truth.frame.local(place.p_P_mm)) - place.narrow_mm;
      if (place.along_mm < canal.length_mm() - 2.0) {
        EXPECT_GT(wall_mm, 0.35) << canal.name << " at " << place.along_mm;
      }
      EXPECT_GE(2.0 * place.narrow_mm, 0.2) << canal.name;
      EXPECT_GE(place.wide_mm, place.narrow_mm) << canal.name;
    }
    EXPECT_NEAR(truth.placed.shape.outer_mm(truth.frame.local(canal.foramen_P_mm())), 0.0, 0.3) << canal.name;
    EXPECT_LT(glm::distance(canal.foramen_P_mm(), canal.apex_P_mm), 2.0) << canal.name;
    EXPECT_GT(canal.length_mm(), 6.0) << canal.name;
    EXPECT_LT(canal.length_mm(), 14.0) << canal.name;
    EXPECT_LT(canal.schneider_rad * 180.0 / std::numbers::pi, 60.0) << canal.name;
    EXPECT_GT(canal.workingLength_mm(), canal.length_mm() + 3.0) << canal.name;
  }
  // Their apices are those of the shape.
  const ToothCanals own = canalsOf(truth);
  EXPECT_LT(glm::distance(found.canals[0].apex_P_mm, own.canals[0].apex_P_mm), 0.8);
  EXPECT_LT(glm::distance(found.canals[2].apex_P_mm, own.canals[2].apex_P_mm), 0.8);
}

TEST(ModelledCanals, AreOpenInTheFineField) {
  const auto tooth = fineScannedTooth(scan(), modelled(), 0.06);
  std::array<std::uint8_t, ToothSampler::kVoxels> solid{}, label{};
  const auto solid_at = [&](const glm::dvec3& p_P) {
    const glm::ivec3 ijk(glm::round(tooth->grid().indexFromPoint(p_P)));
    tooth->block(ijk / 4, solid, label);
    return solid[static_cast<std::size_t>((ijk.z & 3) * 16 + (ijk.y & 3) * 4 + (ijk.x & 3))];
  };
  for (const ToothCanal& canal : modelled().canals)
    for (double mm = 0.0; mm <= canal.length_mm(); mm += 0.2)
      EXPECT_LT(solid_at(canal.at(mm).p_P_mm), 100) << canal.name << " at " << mm;
  // What the scan shows as pulp above the floor is open too, and dentine is not.
  int pulp_solid = 0, pulp = 0, dentine_open = 0, dentine = 0;
  forVoxels(scan().grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (scan().tooth[v] != kFdi) return;
    const bool is_pulp = Tissue{scan().label[v]} == Tissue::pulp;
    const bool open = solid_at(scan().grid.centre_P_mm(ijk)) < 128;
    const bool is_chamber =
        is_pulp && modelled().frame.local(scan().grid.centre_P_mm(ijk)).z > modelled().chamber.floor_mm + 0.2;
    if (is_chamber) ++pulp, pulp_solid += open ? 0 : 1;
    if (!is_pulp) ++dentine, dentine_open += open ? 1 : 0;
  });
  EXPECT_GT(pulp, 100);
  EXPECT_EQ(pulp_solid, 0);
  EXPECT_LT(dentine_open, dentine / 20);
}

/// A crown over round roots at `roots_mm`, upside down as an upper tooth stands, with a pulp chamber.
CtVolume upperTooth(int fdi, const std::vector<glm::dvec2>& roots_mm) {
  CtVolume ct;
  ct.grid = {{50, 50, 80}, 0.3, {-7.5, -7.5, -8.0}};
  ct.label.resize(ct.grid.voxelCount());
  ct.tooth.resize(ct.grid.voxelCount());
  ct.hounsfield.assign(ct.grid.voxelCount(), 0);
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    const double aside = std::hypot(p.x, p.y);
    bool is_root = false;
    for (const glm::dvec2& at : roots_mm)
      is_root = is_root || (p.z >= 0.0 && p.z < 13.0 && glm::distance(glm::dvec2(p), at) < 1.9 - 0.08 * p.z);
    const bool is_crown = p.z > -7.0 && p.z < 3.0 && aside < 4.5;
    if (!is_crown && !is_root) return;
    ct.tooth[v] = static_cast<std::uint8_t>(fdi);
    Tissue tissue = is_crown && p.z < 0.0 && (aside > 3.3 || p.z < -5.0) ? Tissue::enamel : Tissue::dentine;
    if (aside < 2.0 && p.z > -0.5 && p.z < 1.2) tissue = Tissue::pulp;
    ct.label[v] = static_cast<std::uint8_t>(tissue);
  });
  return ct;
}

TEST(ModelledCanals, AnUpperMolarHasThreeRootsAndFourCanals) {
  // 26: the patient's left; cheek to +x, mesial to -y.
  const ToothCanals found = modelledCanals(upperTooth(26, {{2.2, -2.2}, {2.2, 2.2}, {-2.6, 0.0}}), 26);
  ASSERT_EQ(found.canals.size(), 4U);
  const auto canal = [&](std::string_view name) -> const ToothCanal& {
    for (const ToothCanal& one : found.canals)
      if (one.name == name) return one;
    ADD_FAILURE() << "no canal " << name;
    return found.canals[0];
  };
  EXPECT_LT(canal("mesiobuccal").apex_P_mm.y, -1.5);
  EXPECT_GT(canal("second mesiobuccal").apex_P_mm.x, 1.0);
  EXPECT_GT(canal("distobuccal").apex_P_mm.y, 1.5);
  EXPECT_LT(canal("palatal").apex_P_mm.x, -1.5);
  for (const ToothCanal& one : found.canals) EXPECT_GT(one.foramen_P_mm().z, one.orifice_P_mm().z + 8.0) << one.name;
}

TEST(ModelledCanals, AnUpperPremolarOfOneRootHasTwoCanals) {
  const ToothCanals found = modelledCanals(upperTooth(24, {{0.0, 0.0}}), 24);
  ASSERT_EQ(found.canals.size(), 2U);
  EXPECT_EQ(found.canals[0].name, "buccal");
  EXPECT_EQ(found.canals[1].name, "palatal");
}

TEST(ModelledCanals, AToothWithoutPulpIsRefusedInOneLine) {
  EXPECT_NE(refusal(scan(), 47).find("no pulp is labelled"), std::string::npos);
  EXPECT_NE(refusal(scan(), 36).find("no voxel"), std::string::npos);
  CtVolume none = scan();
  none.tooth.clear();
  EXPECT_NE(refusal(none, kFdi).find("no voxel"), std::string::npos);
  // Its pulp in the roots alone.
  CtVolume deep = scan();
  const ToothFrame frame = toothFrame(scan(), kFdi);
  forVoxels(deep.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (Tissue{deep.label[v]} == Tissue::pulp && frame.local(deep.grid.centre_P_mm(ijk)).z > -6.0)
      deep.label[v] = static_cast<std::uint8_t>(Tissue::dentine);
  });
  EXPECT_NE(refusal(deep, kFdi).find("above its roots"), std::string::npos);
}

}  // namespace
}  // namespace assets::canals_of_a_scan
