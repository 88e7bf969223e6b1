#include "app/procedure/flap/flap.h"

#include <gtest/gtest.h>

#include "app/procedure/flap/flap_mesh.h"
#include "tests/app/procedure/flap/ridge.h"

namespace app {
namespace {

/// A flat strip along +y, held at its far end.
FlapSheet strip(int columns, int rows, double edge_mm) {
  std::vector<SheetVertex> vertices;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      SheetVertex v;
      v.home_P_mm = {edge_mm * c, edge_mm * r, 0.0}, v.normal_P = {0.0, 0.0, 1.0};
      v.bone_P_mm = v.home_P_mm - glm::dvec3(0.0, 0.0, 1.2);
      v.is_attached = r + 1 == rows;
      v.is_cut = r == 0;
      vertices.push_back(v);
    }
  return FlapSheet(columns, rows, std::move(vertices));
}

const FlapSheet::GroundAt kNoGround = [](const glm::dvec3&) { return FlapSheet::Ground{10.0, {}}; };

void free(FlapSheet& sheet) {
  for (int pass = 0; pass < 400; ++pass)
    for (int r = 0; r < sheet.rows(); ++r)
      for (int c = 0; c < sheet.columns(); c += 3) sheet.peel(sheet.vertices()[sheet.index(c, r)].bone_P_mm);
}

TEST(FlapSheet, StretchesAsItsModulusSays) {
  constexpr int kColumns = 11, kRows = 31;
  constexpr double kEdge_mm = 0.6, kForce_N = 0.15;
  FlapSheet sheet = strip(kColumns, kRows, kEdge_mm);
  free(sheet);
  for (int frame = 0; frame < 900; ++frame)
    sheet.step({kNoGround, nullptr, glm::dvec3(0.0), glm::dvec3(0.0, -kForce_N, 0.0)});
  const double wide_mm = kEdge_mm * (kColumns - 1), long_mm = kEdge_mm * (kRows - 1);
  double moved_mm = 0.0;
  for (int c = 0; c < kColumns; ++c)
    moved_mm +=
        (sheet.vertices()[sheet.index(c, 0)].home_P_mm.y - sheet.vertices()[sheet.index(c, 0)].at_P_mm.y) / kColumns;
  const double expected = kForce_N / (FlapSheet::kE_N_per_mm2 * FlapSheet::kMembrane_mm * wide_mm);
  EXPECT_NEAR(moved_mm / long_mm, expected, 0.1 * expected);
}

TEST(FlapSheet, PeelsFromTheIncisionOn) {
  FlapSheet sheet = strip(20, 20, 0.6);
  const auto under = [&](int c, int r) { return sheet.vertices()[sheet.index(c, r)].bone_P_mm; };
  for (int n = 0; n < 50; ++n) EXPECT_EQ(sheet.peel(under(10, 12)), 0) << "nothing near is free or cut";
  EXPECT_FALSE(sheet.isOpenAt(under(10, 12)));
  int freed = 0;
  for (int n = 0; n < 3; ++n) freed += sheet.peel(under(10, 0));
  EXPECT_GT(freed, 0);
  EXPECT_TRUE(sheet.anyFree());
  // Ring by ring, each after a contact of 25 ms.
  for (int n = 0; n < 3; ++n) EXPECT_FALSE(sheet.vertices()[sheet.index(10, 3)].isFree()), sheet.peel(under(10, 0));
  for (int n = 0; n < 10; ++n) sheet.peel(under(10, 0));
  EXPECT_TRUE(sheet.vertices()[sheet.index(10, 3)].isFree());
  EXPECT_FALSE(sheet.vertices()[sheet.index(10, 8)].isFree()) << "out of the elevator's reach";
}

TEST(Flap, IsRaisedHeldAndClearOfTheBone) {
  WorkedRidge worked;
  worked.incise();
  EXPECT_FALSE(worked.flap.sheet());
  worked.raise();
  EXPECT_GE(worked.flap.record().raised_share, 0.95);
  EXPECT_EQ(worked.flap.record().tears, 0);
  EXPECT_FALSE(worked.flap.isAside()) << "nobody holds it";
  worked.command.assistant_holds = true;
  worked.rest(6.0);
  EXPECT_TRUE(worked.flap.isAside());
  EXPECT_EQ(worked.flap.record().slips, 0);
  EXPECT_LE(worked.flap.sheet()->held_N(), FlapSheet::kSlip_N);
  // Let go it sinks back, and never into the bone.
  worked.command.assistant_holds = false;
  worked.rest(3.0);
  EXPECT_FALSE(worked.flap.isAside());
  for (const SheetVertex& v : worked.flap.sheet()->vertices()) {
    const glm::dvec3 p = v.at_P_mm;
    EXPECT_GT(std::hypot(p.x, p.z), Ridge::kBone_mm + 0.2);
  }
}

TEST(Flap, SlipsFromTheRetractorWhereTooLittleIsRaised) {
  WorkedRidge worked;
  worked.incise();
  worked.raise(0.5);
  worked.command.assistant_holds = true;
  worked.rest(5.0);
  EXPECT_EQ(worked.flap.record().slips, 1);
  EXPECT_FALSE(worked.flap.record().is_held);
  for (const SheetVertex& v : worked.flap.sheet()->vertices())
    EXPECT_GT(std::hypot(v.at_P_mm.x, v.at_P_mm.z), Ridge::kBone_mm + 0.2);
}

TEST(Flap, TearsUnderGumThatIsNotCut) {
  WorkedRidge worked;
  worked.take(haptics::HandInstrument::periosteal);
  for (double m = -3.0; m < 3.0; m += 0.012) worked.tick(worked.at({m, 0.0}, 0.6), true);
  EXPECT_EQ(worked.flap.record().tears, 1);
  EXPECT_TRUE(worked.flap.news());
}

TEST(Flap, IsTornByABurThatTouchesIt) {
  WorkedRidge worked;
  worked.incise();
  worked.raise();
  worked.command.tool = {};
  worked.command.tool.head.radius_mm = 1.5;
  const SheetVertex& v = worked.flap.sheet()->vertices()[worked.flap.sheet()->index(10, 6)];
  const glm::dvec3 beside = v.at_P_mm + 3.0 * v.normal_P;
  for (int n = 0; n < 20; ++n) worked.tick(beside, false, true);
  EXPECT_EQ(worked.flap.record().bur_touches, 0);
  for (int n = 0; n < 20; ++n) worked.tick(v.at_P_mm, false, true);
  EXPECT_EQ(worked.flap.record().bur_touches, 1);
}

TEST(Flap, IsTheSameForTheSameTicks) {
  const auto digest = [] {
    WorkedRidge worked;
    worked.incise(0.3, true, 0.1);
    worked.raise();
    worked.command.assistant_holds = true;
    worked.rest(2.0);
    return worked.flap.record();
  };
  const FlapRecord one = digest();
  EXPECT_NE(one.digest, 0u);
  EXPECT_EQ(one, digest());
}

TEST(FlapMesh, CutsTheGumOpenWhereTheSheetLies) {
  WorkedRidge worked;
  EXPECT_TRUE(flapMesh(worked.flap).parts.empty());
  worked.incise();
  EXPECT_EQ(flapMesh(worked.flap).parts.size(), 1u) << "a line";
  worked.raise();
  const assets::MeshModel drawn = flapMesh(worked.flap);
  EXPECT_EQ(drawn.parts.front().name, "Gum flap");
  const assets::MeshModel gum = gumAround(worked.ridge.gum, worked.flap.chart(), *worked.flap.sheet());
  // No gum is left over the middle of what was raised.
  const FlapSheet& sheet = *worked.flap.sheet();
  const glm::dvec3 middle = sheet.vertices()[sheet.index(sheet.columns() / 2, sheet.rows() / 2)].home_P_mm;
  for (const glm::vec3& p : gum.parts.front().position_mm) EXPECT_GT(glm::distance(glm::dvec3(p), middle), 2.0);
  EXPECT_EQ(gum.parts.front().position_mm.size(), gum.parts.front().normal.size());
}

}  // namespace
}  // namespace app
