// The slot that parts a tooth with two roots, and which of two is the better.

#include "app/procedure/third_molar/section_plan.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "app/procedure/third_molar/section_choice.h"
#include "haptics/body/components.h"
#include "tests/app/procedure/third_molar_phantom.h"

namespace app {
namespace {

TEST(SectionPlan, PartsATwoRootedToothBetweenItsRoots) {
  assets::Patient patient = phantom(3.0);
  const auto cut = planSection(SiteSolid(patient), kBur_mm, 0.9);
  ASSERT_TRUE(cut);
  const std::size_t neighbour = solidOf(patient.ct, kNeighbour);
  sweep(patient.ct, cut->cut);
  EXPECT_EQ(piecesOf(patient.ct), 2U);
  EXPECT_EQ(solidOf(patient.ct, kNeighbour), neighbour);
  EXPECT_GT(nearestCanal_mm(patient, cut->cut), 1.4);
}

double largestOf_mm3(const assets::CtVolume& ct) {
  std::vector<std::uint8_t> tooth(ct.solid.size());
  for (std::size_t v = 0; v < tooth.size(); ++v) tooth[v] = ct.tooth[v] == kFdi ? ct.solid[v] : std::uint8_t{0};
  return haptics::Components(ct.grid, tooth).pieces().front().volume_mm3;
}

TEST(SectionPlan, TellsWhatTheToothFallsInto) {
  assets::Patient patient = phantom(3.0);
  const auto whole_mm3 = largestOf_mm3(patient.ct);
  const auto cut = planSection(SiteSolid(patient), kBur_mm, 0.9);
  ASSERT_TRUE(cut);
  sweep(patient.ct, cut->cut);
  EXPECT_LT(cut->largest_mm3, 0.55 * whole_mm3);
  EXPECT_NEAR(cut->largest_mm3, largestOf_mm3(patient.ct), 0.05 * whole_mm3);
}

TEST(SectionPlan, StopsShortOfTheTonguesSideWhereAskedTo) {
  const assets::Patient patient = phantom(3.0);
  // The jaw ends 0.2 mm beyond the tooth.
  constexpr double kEnd_mm = 3.8;
  std::vector<glm::dvec3> surface_P_mm;
  for (double y = -16.0; y < 12.0; y += 0.3)
    for (double z = -14.0; z < 3.0; z += 0.3) surface_P_mm.push_back({kEnd_mm, y, z});
  const SiteSolid site(patient, surface_P_mm);
  const auto through = planSection(site, kBur_mm, 0.9), spares = planSection(site, kBur_mm, 0.9, {.tongue_mm = 0.4});
  ASSERT_TRUE(through && spares);
  EXPECT_LT(through->off_tongue_mm, 0.0);
  EXPECT_GT(spares->off_tongue_mm, 0.3);
  double least_mm = 1e9;
  for (const auto& stroke : spares->cut.strokes_P_mm)
    for (const glm::dvec3& p : stroke)
      for (const glm::dvec3& q : surface_P_mm) least_mm = std::min(least_mm, glm::distance(p, q) - kBur_mm);
  EXPECT_LE(spares->off_tongue_mm, least_mm + 1e-9);
  EXPECT_GT(spares->largest_mm3, 1.3 * through->largest_mm3);
}

TEST(SectionPlan, HasNothingToPartWhereTheToothIsGone) {
  assets::Patient patient = phantom(3.0);
  for (std::size_t v = 0; v < patient.ct.solid.size(); ++v)
    if (patient.ct.tooth[v] == kFdi) patient.ct.solid[v] = 0;
  EXPECT_FALSE(planSection(SiteSolid(patient), kBur_mm, 0.9));
}

/// mm³ in the way of the phantom's halves, once `cut` was made.
std::optional<double> inTheWay_mm3(const assets::Patient& patient, const assets::PlannedCut& cut) {
  const BodiesCopy bodies = Operation{patient}.copy();
  const assets::CtVolume& ct = patient.ct;
  const AroundTooth around{ct.grid, bodies.jaw, ct.label, ct.tooth};
  const WayUp up;
  return inTheWayAfter_mm3({around, ct.grid, bodies.piece[0], up}, cut, cut, 0.65);
}

TEST(SectionChoice, CountsTheBoneAboveThePiecesAndNothingWhereTheyAreFree) {
  const assets::Patient bare = phantom(-6.5), buried = phantom(8.0);
  const auto cut_bare = planSection(SiteSolid(bare), kBur_mm, 0.9),
             cut_buried = planSection(SiteSolid(buried), kBur_mm, 0.9);
  ASSERT_TRUE(cut_bare && cut_buried);
  const auto free_mm3 = inTheWay_mm3(bare, cut_bare->cut), held_mm3 = inTheWay_mm3(buried, cut_buried->cut);
  ASSERT_TRUE(free_mm3 && held_mm3);
  EXPECT_LT(*free_mm3, 3.0) << "nothing but the tips of the roots is held";
  EXPECT_GT(*held_mm3, 20.0) << "two millimetres of bone over the crown, but for the slot";
}

TEST(SectionChoice, AToothThatStaysWholeIsNoChoice) {
  const assets::Patient patient = phantom(-6.5);
  assets::PlannedCut scratch;
  scratch.bur_radius_mm = kBur_mm;
  scratch.outward_P = {0.0, 0.0, 1.0};
  scratch.strokes_P_mm = {{{-3.0, 0.0, 6.0}, {3.0, 0.0, 6.0}}};
  EXPECT_FALSE(inTheWay_mm3(patient, scratch));
}

}  // namespace
}  // namespace app
