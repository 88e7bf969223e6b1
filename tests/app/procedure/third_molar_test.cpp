// A tooth with two roots between a neighbour and a canal, in a block of bone: what is planned to take it out.

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "app/procedure/third_molar/clearing_plan.h"
#include "app/procedure/third_molar/delivery_path.h"
#include "app/procedure/third_molar/demonstration.h"
#include "app/procedure/third_molar/operation_planner.h"
#include "app/procedure/third_molar/section_plan.h"
#include "app/text/usage_error.h"
#include "haptics/body/components.h"
#include "haptics/device/simulated/trough_path.h"

namespace app {
namespace {

constexpr double kSpacing_mm = 0.4, kBur_mm = 1.0;
constexpr int kFdi = 48, kNeighbour = 47;

/// Crown above z = 0, a root on either side in y below it; distal is +y, the cheek -x, up +z.
bool isInTooth(const glm::dvec3& p) {
  if (std::abs(p.x) > 3.6) return false;
  if (p.z >= 0.0 && p.z < 6.0) return std::abs(p.y) < 4.0;
  return p.z < 0.0 && p.z > -7.0 && std::abs(std::abs(p.y) - 2.6) < 1.3;
}
bool isInNeighbour(const glm::dvec3& p) {
  return std::abs(p.x) < 4.0 && p.y > -13.0 && p.y < -5.2 && p.z > -9.0 && p.z < 7.0;
}

/// Bone up to `bone_top_mm`.
assets::Patient phantom(double bone_top_mm) {
  assets::Patient patient;
  assets::CtVolume& ct = patient.ct;
  ct.grid = {glm::ivec3(50, 70, 70), kSpacing_mm, glm::dvec3(-10.0, -16.0, -14.0)};
  const std::size_t voxels = ct.grid.voxelCount();
  ct.label.assign(voxels, 0);
  ct.solid.assign(voxels, 0);
  ct.tooth.assign(voxels, 0);
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    const bool tooth = isInTooth(p), neighbour = isInNeighbour(p);
    if (!tooth && !neighbour && p.z > bone_top_mm) return;
    ct.solid[v] = 255;
    ct.tooth[v] = static_cast<std::uint8_t>(tooth ? kFdi : neighbour ? kNeighbour : 0);
    const assets::Tissue tissue = tooth       ? (p.z > 0.5 ? assets::Tissue::enamel : assets::Tissue::dentine)
                                  : neighbour ? assets::Tissue::dentine
                                              : assets::Tissue::trabecular;
    ct.label[v] = static_cast<std::uint8_t>(tissue);
  });
  patient.site = assets::OperativeSite{};
  patient.site->fdi = kFdi;
  patient.site->axis_P = {0.0, 0.0, 1.0};
  patient.site->centre_P_mm = {0.0, 0.0, 2.0};
  for (double x = -8.0; x <= 8.0; x += 0.5) patient.mandibular_canal_P_mm.push_back({x, 0.0, -11.0});
  patient.mandibular_canal_radius_mm = 1.2;
  return patient;
}

/// What a ball of the plan's radius sweeps.
void sweep(assets::CtVolume& ct, const assets::PlannedCut& cut) {
  const double r_mm = cut.bur_radius_mm;
  const auto take = [&](const glm::dvec3& p) {
    const glm::ivec3 low(glm::floor(ct.grid.indexFromPoint(p - r_mm))),
        high(glm::ceil(ct.grid.indexFromPoint(p + r_mm)));
    assets::forVoxels(glm::max(low, glm::ivec3(0)), glm::min(high + 1, ct.grid.size), [&](glm::ivec3 ijk) {
      if (glm::distance(ct.grid.centre_P_mm(ijk), p) < r_mm) ct.solid[ct.grid.index(ijk)] = 0;
    });
  };
  for (const auto& stroke : cut.strokes_P_mm)
    for (std::size_t n = 0; n < stroke.size(); ++n) {
      const glm::dvec3 to = n + 1 < stroke.size() ? stroke[n + 1] : stroke[n];
      const int steps = 1 + static_cast<int>(glm::distance(stroke[n], to) / 0.2);
      for (int k = 0; k < steps; ++k) take(glm::mix(stroke[n], to, double(k) / steps));
    }
}

std::size_t solidOf(const assets::CtVolume& ct, int fdi) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < ct.solid.size(); ++v) count += ct.tooth[v] == fdi && ct.solid[v] != 0 ? 1 : 0;
  return count;
}

std::size_t piecesOf(const assets::CtVolume& ct) {
  std::vector<std::uint8_t> tooth(ct.solid.size());
  for (std::size_t v = 0; v < tooth.size(); ++v) tooth[v] = ct.tooth[v] == kFdi ? ct.solid[v] : std::uint8_t{0};
  const haptics::Components components(ct.grid, tooth);
  return static_cast<std::size_t>(
      std::ranges::count_if(components.pieces(), [](const auto& piece) { return piece.volume_mm3 > 5.0; }));
}

double nearestCanal_mm(const assets::Patient& patient, const assets::PlannedCut& cut) {
  double least_mm = 1e9;
  for (const auto& stroke : cut.strokes_P_mm)
    for (const glm::dvec3& p : stroke)
      for (const glm::dvec3& c : patient.mandibular_canal_P_mm) least_mm = std::min(least_mm, glm::distance(p, c));
  return least_mm - cut.bur_radius_mm - patient.mandibular_canal_radius_mm;
}

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

TEST(ClearingPlan, TakesAwayALidAndSparesToothNeighbourAndCanal) {
  assets::Patient patient = phantom(8.0);
  std::vector<glm::dvec3> lid;
  assets::forVoxels(patient.ct.grid, [&](glm::ivec3 ijk, std::size_t) {
    const glm::dvec3 p = patient.ct.grid.centre_P_mm(ijk);
    if (std::abs(p.x) < 2.5 && std::abs(p.y) < 3.0 && p.z > 6.0 && p.z < 8.0) lid.push_back(p);
  });
  const auto cut = planClearing(SiteSolid(patient), lid, kBur_mm, 0.1);
  ASSERT_TRUE(cut);
  const std::size_t neighbour = solidOf(patient.ct, kNeighbour), tooth = solidOf(patient.ct, kFdi);
  sweep(patient.ct, *cut);
  const auto left = std::ranges::count_if(lid, [&](const glm::dvec3& p) {
    return patient.ct.solid[patient.ct.grid.index(glm::ivec3(glm::round(patient.ct.grid.indexFromPoint(p))))] != 0;
  });
  EXPECT_LT(static_cast<double>(left), 0.3 * static_cast<double>(lid.size()));
  EXPECT_EQ(solidOf(patient.ct, kNeighbour), neighbour);
  EXPECT_EQ(solidOf(patient.ct, kFdi), tooth);
}

TEST(ClearingPlan, SparesTheNeighbourAndGoesOverItFromStrokeToStroke) {
  assets::Patient patient = phantom(3.0);
  // Bone to the cheek and to the tongue of it.
  std::vector<glm::dvec3> beside;
  for (double side : {-1.0, 1.0})
    for (double x = 4.2; x < 6.5; x += 0.4)
      for (double y = -10.0; y < -6.0; y += 0.4)
        for (double z : {1.0, 1.5, 2.0, 2.5}) beside.push_back({side * x, y, z});
  const auto cut = planClearing(SiteSolid(patient), beside, kBur_mm, 0.1);
  ASSERT_TRUE(cut);
  double top_mm = -1e9, least_x_mm = 1e9, most_x_mm = -1e9;
  for (const auto& stroke : cut->strokes_P_mm)
    for (const glm::dvec3& p : stroke) {
      top_mm = std::max(top_mm, glm::dot(p, cut->outward_P));
      least_x_mm = std::min(least_x_mm, p.x);
      most_x_mm = std::max(most_x_mm, p.x);
    }
  EXPECT_LT(least_x_mm, -5.0);
  EXPECT_GT(most_x_mm, 5.0);
  const double neighbour_mm = glm::dot(glm::dvec3(0.0, -9.0, 7.0), cut->outward_P);
  EXPECT_GT(top_mm + cut->over_mm, neighbour_mm + kBur_mm);
  const std::size_t neighbour = solidOf(patient.ct, kNeighbour);
  sweep(patient.ct, *cut);
  EXPECT_EQ(solidOf(patient.ct, kNeighbour), neighbour);
}

TEST(ClearingPlan, KeepsOffTheCanal) {
  const assets::Patient patient = phantom(3.0);
  std::vector<glm::dvec3> deep;
  for (double x = 5.2; x < 6.8; x += 0.4)
    for (double y = -1.0; y < 1.1; y += 0.4)
      for (double z = -10.5; z < -5.0; z += 0.4) deep.push_back({x, y, z});
  const auto cut = planClearing(SiteSolid(patient), deep, kBur_mm, 0.1);
  ASSERT_TRUE(cut);
  EXPECT_GT(nearestCanal_mm(patient, *cut), 1.4);
}

TEST(ClearingPlan, LeavesTheWallTowardsTheTongue) {
  const assets::Patient patient = phantom(3.0);
  // The jaw ends at x = 6.4; bone up to there is in the way.
  constexpr double kEnd_mm = 6.4;
  std::vector<glm::dvec3> surface, beside;
  for (double y = -16.0; y < 12.0; y += 0.4)
    for (double z = -14.0; z < 3.0; z += 0.4) surface.push_back({kEnd_mm, y, z});
  for (double x = 4.0; x < kEnd_mm; x += 0.4)
    for (double y = -3.0; y < 3.1; y += 0.4)
      for (double z : {-1.0, 0.0, 1.0, 2.0}) beside.push_back({x, y, z});
  const auto nearest_mm = [&](std::span<const glm::dvec3> tongue_P_mm) {
    const auto cut = planClearing(SiteSolid(patient, tongue_P_mm), beside, kBur_mm, 0.1, {.tongue_mm = 0.45});
    double least_mm = 1e9;
    for (const auto& stroke : cut.value().strokes_P_mm)
      for (const glm::dvec3& p : stroke)
        for (const glm::dvec3& q : surface) least_mm = std::min(least_mm, glm::distance(p, q));
    return least_mm - kBur_mm;
  };
  EXPECT_LT(nearest_mm({}), 0.0);
  EXPECT_GT(nearest_mm(surface), 0.3);
}

TEST(ClearingPlan, GoesFromStrokeToStrokeNoHigherThanItHasTo) {
  assets::Patient patient = phantom(3.0);
  // Low bone to the cheek, the neighbour between its two ends.
  std::vector<glm::dvec3> low;
  for (double x = -6.0; x < 6.1; x += 0.4)
    for (double y = -9.0; y < -4.0; y += 0.4)
      for (double z : {1.0, 2.0})
        if (std::abs(x) > 4.4) low.push_back({x, y, z});
  auto cut = planClearing(SiteSolid(patient), low, kBur_mm, 0.1);
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->hop_mm.size(), cut->strokes_P_mm.size());
  cut->shaft_P = cut->outward_P;
  const auto path_of = [&](const assets::PlannedCut& plan) {
    return haptics::TroughPath(plan, {.shaft_P = plan.shaft_P});
  };
  const haptics::TroughPath path = path_of(*cut);
  assets::PlannedCut way = *cut, high = *cut;
  high.hop_mm.clear();
  EXPECT_LT(path.duration_s(), 0.98 * path_of(high).duration_s());
  // Wherever it goes it meets no neighbour.
  way.strokes_P_mm = {{}};
  for (double t_s = 0.0; t_s < path.duration_s(); t_s += 0.005)
    way.strokes_P_mm.front().push_back(path.at(t_s).position_mm);
  const std::size_t neighbour = solidOf(patient.ct, kNeighbour);
  sweep(patient.ct, way);
  EXPECT_EQ(solidOf(patient.ct, kNeighbour), neighbour);
}

TEST(ClearingPlan, LeavesWhatNoBurReaches) {
  const assets::Patient patient = phantom(3.0);
  // Under the neighbour.
  const std::vector<glm::dvec3> hidden(40, glm::dvec3(0.0, -9.0, -11.0));
  EXPECT_FALSE(planClearing(SiteSolid(patient), hidden, kBur_mm, 0.1));
}

/// The phantom as the servo would have it.
struct Operation {
  assets::Patient patient;
  bool is_any_out = false;
  BodiesCopy copy() const {
    BodiesCopy bodies;
    bodies.jaw = patient.ct.solid;
    bodies.is_any_out = is_any_out;
    bodies.piece[0].assign(patient.ct.solid.size(), 0);
    for (std::size_t v = 0; v < bodies.jaw.size(); ++v)
      if (patient.ct.tooth[v] == kFdi) std::swap(bodies.jaw[v], bodies.piece[0][v]);
    return bodies;
  }
};

TEST(OperationPlanner, PartsTheToothThenTakesItOutPieceByPiece) {
  Operation operation{phantom(-6.5)};  // nothing but the tips of the roots is held
  OperationPlanner planner(operation.patient, kBur_mm);
  assets::CtVolume& ct = operation.patient.ct;
  OperationStep step = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
  const CutStep* section = std::get_if<CutStep>(&step.what);
  ASSERT_NE(section, nullptr);
  EXPECT_EQ(step.words, "part the tooth");
  sweep(ct, section->cut);
  ASSERT_EQ(piecesOf(ct), 2U);

  for (int piece = 0; piece < 2; ++piece) {
    step = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
    const DeliveryStep* delivery = std::get_if<DeliveryStep>(&step.what);
    ASSERT_NE(delivery, nullptr) << step.words;
    EXPECT_EQ(delivery->piece, 0U) << "both are in one body here";
    EXPECT_TRUE(isInTooth(delivery->grip_P_mm));
    ASSERT_FALSE(delivery->path_X_PQ.empty());
    EXPECT_GT(delivery->path_X_PQ.back().translation_mm.z, 6.0);
    // Out with the one that was gripped.
    operation.is_any_out = true;
    std::vector<std::uint8_t> tooth(ct.solid.size());
    for (std::size_t v = 0; v < tooth.size(); ++v) tooth[v] = ct.tooth[v] == kFdi ? ct.solid[v] : std::uint8_t{0};
    const haptics::Components components(ct.grid, tooth);
    const int gripped = components.pieceAt(glm::ivec3(glm::round(ct.grid.indexFromPoint(delivery->grip_P_mm))));
    ASSERT_GE(gripped, 0);
    assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (components.pieceAt(ijk) == gripped) ct.solid[v] = 0;
    });
  }
  step = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
  const EndStep* end = std::get_if<EndStep>(&step.what);
  ASSERT_NE(end, nullptr);
  EXPECT_EQ(end->why_not, "");
}

// The servo's tooth fades into the bone around it: what it has beyond its labels is to be parted, too.
TEST(OperationPlanner, PartsTheToothAsBroadAsTheServoHasIt) {
  Operation operation{phantom(-6.5)};
  assets::CtVolume& ct = operation.patient.ct;
  OperationPlanner planner(operation.patient, kBur_mm);
  const std::vector<std::uint8_t> narrow = ct.tooth;
  constexpr int kBeyond = 3;  // voxels
  assets::forVoxels(glm::ivec3(kBeyond), ct.grid.size - kBeyond, [&](glm::ivec3 ijk) {
    const std::size_t v = ct.grid.index(ijk);
    for (int x = -kBeyond; x <= kBeyond && narrow[v] == 0; ++x)
      if (narrow[ct.grid.index(ijk + glm::ivec3(x, 0, 0))] == kFdi) ct.tooth[v] = kFdi, ct.solid[v] = 255;
  });
  const OperationStep step = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
  const CutStep* const section = std::get_if<CutStep>(&step.what);
  ASSERT_NE(section, nullptr) << step.words;
  sweep(ct, section->cut);
  EXPECT_EQ(piecesOf(ct), 2U) << "the first section goes through all of it";
}

TEST(OperationPlanner, GivesUpOnAToothThatStaysWhole) {
  const Operation operation{phantom(3.0)};
  OperationPlanner planner(operation.patient, kBur_mm);
  int cuts = 0;
  for (;; ++cuts) {
    ASSERT_LT(cuts, 10);
    const OperationStep step = planner.next(operation.copy(), operation.patient.ct.grid, glm::ivec3(0));
    if (std::holds_alternative<CutStep>(step.what)) continue;
    const EndStep* end = std::get_if<EndStep>(&step.what);
    ASSERT_NE(end, nullptr);
    EXPECT_FALSE(end->why_not.empty());
    break;
  }
  EXPECT_EQ(cuts, 4);
}

TEST(OperationPlanner, TakesPiecesThatTouchAlongABreakForPieces) {
  const Operation operation{phantom(-6.5)};
  const assets::VolumeGrid& grid = operation.patient.ct.grid;
  OperationPlanner planner(operation.patient, kBur_mm, true);
  ASSERT_TRUE(std::holds_alternative<CutStep>(planner.next(operation.copy(), grid, glm::ivec3(0)).what));
  BodiesCopy halves = operation.copy();
  halves.piece[1].assign(halves.piece[0].size(), 0);
  const double middle_y_mm = operation.patient.site->centre_P_mm.y;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (grid.centre_P_mm(ijk).y > middle_y_mm) std::swap(halves.piece[0][v], halves.piece[1][v]);
  });
  const OperationStep next = planner.next(halves, grid, glm::ivec3(0));
  EXPECT_TRUE(std::holds_alternative<DeliveryStep>(next.what)) << next.words;
}

TEST(OperationPlanner, TwistsTheLastSlotOpenWhereTheBurDidNotPartTheTooth) {
  const Operation operation{phantom(3.0)};
  const assets::VolumeGrid& grid = operation.patient.ct.grid;
  OperationPlanner planner(operation.patient, kBur_mm, true);
  assets::PlannedCut cut;
  for (int section = 0; section < 4; ++section) {
    const OperationStep step = planner.next(operation.copy(), grid, glm::ivec3(0));
    ASSERT_TRUE(std::holds_alternative<CutStep>(step.what)) << step.words;
    cut = std::get<CutStep>(step.what).cut;
  }
  const OperationStep next = planner.next(operation.copy(), grid, glm::ivec3(0));
  const SplitStep* const split = std::get_if<SplitStep>(&next.what);
  ASSERT_NE(split, nullptr) << next.words;
  EXPECT_NEAR(glm::length(split->along_P), 1.0, 1e-9);
  EXPECT_NEAR(glm::dot(split->along_P, split->out_P), 0.0, 1e-9);
  // Where the bur was, over the slot's floor.
  double nearest_mm = 1e9, deepest_mm = 1e9;
  for (const auto& stroke : cut.strokes_P_mm)
    for (std::size_t n = 0; n + 1 < stroke.size(); ++n) {
      nearest_mm = std::min(nearest_mm, glm::distance(split->tip_P_mm, 0.5 * (stroke[n] + stroke[n + 1])));
      deepest_mm = std::min(deepest_mm, glm::dot(stroke[n], split->out_P));
    }
  EXPECT_LT(nearest_mm, 1e-9);
  EXPECT_LT(glm::dot(split->tip_P_mm, split->out_P) - deepest_mm, 1.5);
  // It stayed whole: the slots before are tried too.
  for (int section = 1; section < 4; ++section)
    EXPECT_TRUE(std::holds_alternative<SplitStep>(planner.next(operation.copy(), grid, glm::ivec3(0)).what));
  EXPECT_TRUE(std::holds_alternative<EndStep>(planner.next(operation.copy(), grid, glm::ivec3(0)).what));
}

TEST(OperationPlanner, TakesAwayWhatBlocksAPieceBeforeItIsGripped) {
  Operation operation{phantom(8.0)};
  assets::CtVolume& ct = operation.patient.ct;
  OperationPlanner planner(operation.patient, kBur_mm);
  const OperationStep first = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
  ASSERT_TRUE(std::holds_alternative<CutStep>(first.what));
  sweep(ct, std::get<CutStep>(first.what).cut);
  ASSERT_EQ(piecesOf(ct), 2U);
  const OperationStep next = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
  const CutStep* cut = std::get_if<CutStep>(&next.what);
  ASSERT_NE(cut, nullptr) << next.words;
  EXPECT_NE(next.words.find("blocks"), std::string::npos);
}

TEST(OperationPlanner, PartsAToothOfWhichACornerHasBrokenOff) {
  Operation operation{phantom(-6.5)};
  OperationPlanner planner(operation.patient, kBur_mm);
  assets::CtVolume& ct = operation.patient.ct;
  EXPECT_EQ(planner.next(operation.copy(), ct.grid, glm::ivec3(0)).words, "part the tooth");
  // A plane cut through one corner of the crown.
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    if (ct.tooth[v] == kFdi && std::abs(p.y - 2.2) < 0.5 && p.x < -0.4 && p.z > 2.6) ct.solid[v] = 0;
    if (ct.tooth[v] == kFdi && std::abs(p.z - 2.8) < 0.5 && p.x < -0.4 && p.y > 1.8) ct.solid[v] = 0;
    if (ct.tooth[v] == kFdi && std::abs(p.x + 0.6) < 0.5 && p.z > 2.6 && p.y > 1.8) ct.solid[v] = 0;
  });
  ASSERT_EQ(piecesOf(ct), 2U);
  EXPECT_EQ(planner.next(operation.copy(), ct.grid, glm::ivec3(0)).words, "part the tooth");
}

TEST(OperationPlanner, LeadsAMovedPieceFromWhereItLies) {
  Operation operation{phantom(-6.5)};
  operation.is_any_out = true;
  assets::CtVolume& ct = operation.patient.ct;
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] == kFdi && ct.grid.centre_P_mm(ijk).y < 0.0) ct.solid[v] = 0;
  });
  OperationPlanner planner(operation.patient, kBur_mm);
  // A whole tooth was seen first, so that what is left is a part of it.
  (void)planner.next(Operation{phantom(-6.5)}.copy(), ct.grid, glm::ivec3(0));
  BodiesCopy bodies = operation.copy();
  bodies.X_PQ[0] = {glm::angleAxis(0.2, glm::dvec3(0.0, 0.0, 1.0)), {0.4, 0.0, 0.8}};
  const OperationStep step = planner.next(bodies, ct.grid, glm::ivec3(0));
  const DeliveryStep* delivery = std::get_if<DeliveryStep>(&step.what);
  ASSERT_NE(delivery, nullptr) << step.words;
  EXPECT_LT(glm::distance(delivery->path_X_PQ.front().translation_mm, bodies.X_PQ[0].translation_mm), 1.0);
  EXPECT_GT(std::abs(glm::dot(delivery->path_X_PQ.front().rotation, bodies.X_PQ[0].rotation)), 0.999);
}

/// The phantom's operation at its first cut.
struct Shown {
  assets::Patient patient = phantom(3.0);
  haptics::Bodies bodies{patient.ct.grid, patient.ct.solid, patient.ct.label, assets::voxelsOfTooth(patient.ct, kFdi)};
  std::vector<haptics::Tool> tray{{{haptics::ShapeKind::sphere, 1.5, 0.0}, {}},
                                  {{haptics::ShapeKind::capsule, 1.0, 8.0}, {}},
                                  haptics::forcepsTool()};
  assets::PlannedCut gutter = assets::plannedAlong({{-5.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}});
  haptics::LedHand hand{{}};
  Demonstration demonstration{Demonstration::Site{patient, gutter, tray, bodies, hand}};

  Demonstration::Frame frame() const {
    Demonstration::Frame one;
    one.newest.dt_s = 1e-3;
    one.newest.state = haptics::SafetyState::active;
    one.in_hand = tray[0];
    one.is_applied = true;
    return one;
  }
};

TEST(Demonstration, SaysWhatInterruptedIt) {
  const auto after = [](const auto& change) {
    Shown shown;
    Demonstration::Frame frame = shown.frame();
    EXPECT_FALSE(shown.demonstration.follow(frame));
    EXPECT_FALSE(shown.demonstration.isOver());
    change(frame);
    EXPECT_FALSE(shown.demonstration.follow(frame));
    EXPECT_EQ(shown.demonstration.isOver(), !shown.demonstration.failure().empty());
    return shown.demonstration.failure();
  };
  EXPECT_EQ(after([](Demonstration::Frame&) {}), "");
  EXPECT_EQ(after([](Demonstration::Frame& frame) { frame.in_hand = haptics::forcepsTool(); }),
            "another tool was taken");
  EXPECT_EQ(after([](Demonstration::Frame& frame) { frame.drill_enabled = false; }), "the drill was locked");
  EXPECT_EQ(after([](Demonstration::Frame& frame) { frame.newest.state = haptics::SafetyState::fault; }),
            "the motors are off");
}

TEST(Demonstration, NeedsALongBurAndForceps) {
  const haptics::Tool ball{{haptics::ShapeKind::sphere, 1.5, 0.0}, {}},
      stub{{haptics::ShapeKind::capsule, 1.0, 0.1}, {}}, bur{{haptics::ShapeKind::capsule, 1.0, 8.0}, {}};
  EXPECT_THROW(operationTray({ball, haptics::forcepsTool()}), UsageError);
  EXPECT_THROW(operationTray({ball, stub, haptics::forcepsTool()}), UsageError);
  EXPECT_THROW(operationTray({ball, bur}), UsageError);
  EXPECT_EQ(operationTray({ball, bur, haptics::forcepsTool()}).forceps, 2U);
  EXPECT_FALSE(operationTray({ball, bur, haptics::forcepsTool()}).elevator);
  const haptics::Tool cryer = haptics::elevatorTool(haptics::ElevatorKind::cryer_left),
                      straight = haptics::elevatorTool(haptics::ElevatorKind::straight_301);
  EXPECT_EQ(operationTray({ball, bur, cryer, straight, haptics::forcepsTool()}).elevator, 3U);
}

TEST(DeliveryPath, LeadsTheToolAsThePieceGoesAndOpensAtTheEnd) {
  DeliveryStep step;
  step.out_P = {0.0, 0.0, 1.0};
  for (int n = 0; n <= 4; ++n)
    step.path_X_PQ.push_back({glm::angleAxis(0.1 * n, glm::dvec3(1.0, 0.0, 0.0)), {0.0, 0.5 * n, 3.0 * n}});
  const HandPose hand{glm::angleAxis(0.3, glm::dvec3(0.0, 1.0, 0.0)), {1.0, 2.0, 3.0}};
  const haptics::LedPath path = takeOut(hand, {}, step);
  const haptics::HandTarget first = path.script(0.0), end = path.script(path.duration_s);
  EXPECT_LT(glm::distance(first.position_mm, hand.translation_mm), 1e-9);
  EXPECT_TRUE(first.pedal);
  EXPECT_FALSE(end.pedal);
  const HandPose out = step.path_X_PQ.back() * (haptics::PiecePose{}.inverse() * hand);
  EXPECT_GT(glm::dot(end.position_mm - out.translation_mm, step.out_P), 8.0) << "beyond the end of the way";
  double fastest_mm_per_s = 0.0;
  for (double t_s = 0.0; t_s < path.duration_s; t_s += 0.001)
    fastest_mm_per_s = std::max(
        fastest_mm_per_s, glm::distance(path.script(t_s).position_mm, path.script(t_s + 0.001).position_mm) / 0.001);
  EXPECT_LT(fastest_mm_per_s, 30.0);
}

TEST(DeliveryPath, TwistsAnElevatorToBothSidesInTheSlot) {
  SplitStep step;
  step.tip_P_mm = {1.0, 2.0, 3.0};
  step.along_P = {0.0, 1.0, 0.0};
  const haptics::LedPath path = twistInSlot({{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 30.0}}, {0.0, 0.0, 60.0}, step);
  const glm::dquat straight = path.script(path.duration_s).rotation;
  EXPECT_LT(glm::distance(straight * glm::dvec3(1.0, 0.0, 0.0), step.along_P), 1e-9) << "the blade's width";
  EXPECT_LT(glm::distance(straight * glm::dvec3(0.0, 0.0, 1.0), step.out_P), 1e-9) << "the shaft";
  EXPECT_GT(path.script(path.duration_s).position_mm.z, 15.0) << "up again";
  double least_rad = 0.0, most_rad = 0.0;
  for (double t_s = 0.0; t_s < path.duration_s; t_s += 0.01) {
    const haptics::HandTarget target = path.script(t_s);
    EXPECT_FALSE(target.pedal);
    if (glm::distance(target.position_mm, step.tip_P_mm) > 1e-6) continue;
    const glm::dquat turn = glm::conjugate(straight) * target.rotation;
    EXPECT_LT(std::hypot(turn.x, turn.y), 1e-9) << "about the shaft";
    const double twist_rad = 2.0 * std::atan2(turn.z, turn.w);
    least_rad = std::min(least_rad, twist_rad);
    most_rad = std::max(most_rad, twist_rad);
  }
  EXPECT_NEAR(most_rad, 1.0, 0.01);
  EXPECT_NEAR(least_rad, -1.0, 0.01);
}

TEST(DeliveryPath, GripsBeforeItRocksAndRocksToBothSides) {
  DeliveryStep step;
  step.grip_P_mm = {0.0, 0.0, 5.0};
  step.rock_axis_P = {0.0, 1.0, 0.0};
  const glm::dquat held(1.0, 0.0, 0.0, 0.0);
  const haptics::LedPath path = gripAndRock({held, {0.0, 0.0, 40.0}}, {0.0, 0.0, 60.0}, step, held);
  const double rocks_from_s = path.duration_s - kRocks_s;
  EXPECT_FALSE(path.script(0.5 * rocks_from_s).pedal);
  EXPECT_TRUE(path.script(rocks_from_s - 0.1).pedal);
  EXPECT_TRUE(path.script(rocks_from_s).pedal);
  EXPECT_LT(glm::distance(path.script(rocks_from_s).position_mm, step.grip_P_mm), 1e-6);
  double least = 1.0, most = -1.0;
  for (double t_s = rocks_from_s; t_s < path.duration_s; t_s += 0.01) {
    least = std::min(least, path.script(t_s).rotation.y);
    most = std::max(most, path.script(t_s).rotation.y);
  }
  EXPECT_NEAR(most, -least, 0.02);
  EXPECT_GT(most, 0.15);
}

}  // namespace
}  // namespace app
