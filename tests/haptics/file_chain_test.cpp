// Files in the air, against closed forms of the bent beam.
#include <gtest/gtest.h>

#include "haptics/file/rk4_chain.h"
#include "tests/haptics/file_scene.h"

namespace haptics {
namespace {

constexpr double kLength_mm = 16.0, kBending_N_mm2 = 20.0;

FileLaw withoutDrag() {
  FileLaw law;
  law.drag_N_per_mm2 = 0.0;
  return law;
}

/// Clamped at its handle, pulled at nodes until nothing moves; along x across, along -z.
FileInCanal settledUnder(const FileChain& chain, const PerNode<glm::dvec3>& pull_P_N) {
  FileInCanal file(chain, withoutDrag(), {true, 0.0}, phantom::above(chain, 0.0));
  FileScene scene;
  scene.pull_P_N = &pull_P_N;
  for (int n = 0; n < 60; ++n) file.step(phantom::above(chain, 0.0), scene);
  EXPECT_FALSE(file.step(phantom::above(chain, 0.0), scene).unsettled);
  return file;
}

glm::dvec3 tipUnder(const FileChain& chain, const glm::dvec3& tip_N) {
  PerNode<glm::dvec3> pull{};
  pull[chain.links] = tip_N;
  const FileInCanal file = settledUnder(chain, pull);
  return file.state().shape.node_mm[chain.links];
}

FileChain beam(std::size_t links) { return uniformChain(kLength_mm, kBending_N_mm2, 0.2, links); }

/// Deflection over length of a cantilever whose tip bears P across: alpha = P L^2 / EI (exact elliptic integrals).
struct Elastica {
  double alpha, across, along;
};
constexpr Elastica kElastica[] = {
    {1.0, 0.301721, 0.056433}, {2.0, 0.493457, 0.160642}, {5.0, 0.713792, 0.387628}, {10.0, 0.810609, 0.554996}};

TEST(FileChain, BendsAsTheElastica) {
  for (const Elastica& of : kElastica) {
    const double load_N = of.alpha * kBending_N_mm2 / (kLength_mm * kLength_mm);
    const glm::dvec3 fine = tipUnder(beam(32), {load_N, 0.0, 0.0}), coarse = tipUnder(beam(16), {load_N, 0.0, 0.0});
    EXPECT_NEAR(fine.x / kLength_mm / of.across, 1.0, 6e-4) << of.alpha;
    EXPECT_NEAR(coarse.x / kLength_mm / of.across, 1.0, 2.5e-3) << of.alpha;
    EXPECT_NEAR(fine.z / kLength_mm, of.along, 6e-4) << of.alpha;
  }
}

TEST(FileChain, HasTheClosedFormOfASmallLoad) {
  const double load_N = 1e-5, tip_mm = load_N * std::pow(kLength_mm, 3.0) / (3.0 * kBending_N_mm2);
  for (const std::size_t links : {16U, 32U, 64U}) {
    const double expected = tip_mm * (1.0 + 0.5 / static_cast<double>(links * links));
    EXPECT_NEAR(tipUnder(beam(links), {0.0, load_N, 0.0}).y / expected, 1.0, 1e-5) << links;
  }
}

TEST(FileChain, BucklesAtItsClosedForm) {
  for (const std::size_t links : {16U, 32U, 64U}) {
    const double n = static_cast<double>(links);
    const double critical_N =
        2.0 * kBending_N_mm2 * n * n / (kLength_mm * kLength_mm) * (1.0 - std::cos(std::numbers::pi / (2.0 * n)));
    // Southwell: near it the tip gives as 1 / (critical - load).
    const double side_N = 1e-8;
    const auto gives = [&](double share) {
      return side_N / tipUnder(beam(links), {side_N, 0.0, share * critical_N}).x;
    };
    const double near = gives(0.98), nearer = gives(0.99);
    const double found_N = critical_N * (0.98 + 0.01 * near / (near - nearer));
    EXPECT_NEAR(found_N / critical_N, 1.0, 1e-4) << links;
  }
}

TEST(FileChain, AddsUpLoadsOnItsNodesAndTellsThemToTheHand) {
  const FileChain chain = phantom::steelFile(25);
  PerNode<glm::dvec3> pull{};
  pull[10] = {0.02, 0.0, 0.0};
  pull[32] = {0.0, 0.03, -0.01};
  FileInCanal file = settledUnder(chain, pull);
  FileScene scene;
  scene.pull_P_N = &pull;
  const FileTick tick = file.step(phantom::above(chain, 0.0), scene);
  EXPECT_NEAR(tick.on_hand.force_N.xyz.x, 0.02, 1e-9);
  EXPECT_NEAR(tick.on_hand.force_N.xyz.y, 0.03, 1e-9);
  glm::dvec3 moment_Nmm(0.0);
  const ChainShape& shape = file.state().shape;
  for (std::size_t i = 1; i <= chain.links; ++i) moment_Nmm += glm::cross(shape.node_mm[i] - shape.node_mm[0], pull[i]);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(tick.on_hand.torque_Nmm.xyz[axis], moment_Nmm[axis], 2e-4) << axis;
}

TEST(FileChain, HasTheStiffnessOfItsTableAndStepsOfIso) {
  const assets::KFile file = *assets::kFile(25, 21, assets::KFileMetal::steel);
  EXPECT_DOUBLE_EQ(file.diameter_mm(0.0), 0.25);
  EXPECT_DOUBLE_EQ(file.diameter_mm(16.0), 0.57);
  EXPECT_DOUBLE_EQ(file.diameter_mm(20.0), 0.57);
  EXPECT_EQ(file.colour(), "red");
  EXPECT_EQ(assets::kFile(6, 31, assets::KFileMetal::steel)->colour(), "pink");
  EXPECT_EQ(assets::kFile(45, 25, assets::KFileMetal::steel)->colour(), "white");
  EXPECT_EQ(assets::kFile(140, 25, assets::KFileMetal::steel)->colour(), "black");
  EXPECT_FALSE(assets::kFile(27, 25, assets::KFileMetal::steel));
  EXPECT_FALSE(assets::kFile(25, 22, assets::KFileMetal::steel));
  // E I three millimetres from the tip of a #25 (physics 4).
  const double stiffness = 193e3 * fileSection(assets::KFileSection::square, file.diameter_mm(3.0)).bending_mm4;
  EXPECT_NEAR(stiffness, 37.1, 0.1);
  // Breaking torque of a #25 three millimetres from its tip: 30 gf cm (ADA 28) within a tenth.
  EXPECT_NEAR(breakingTorque_Nmm(fileMetal(assets::KFileMetal::steel), file.diameter_mm(3.0)), 30.0 * 0.0981, 0.3);
}

TEST(FileChain, BentBeyondThePlateauNickelTitaniumGivesWay) {
  const FileChain steel = phantom::steelFile(30);
  const FileChain alloy = fileChain(*assets::kFile(30, 21, assets::KFileMetal::nickel_titanium), kUsualLinks);
  const auto tip = [](const FileChain& chain, double load_N) { return tipUnder(chain, {load_N, 0.0, 0.0}).x; };
  EXPECT_NEAR(tip(alloy, 1e-5) / tip(steel, 1e-5), 193.0 / 36.0, 2e-3);
  EXPECT_NEAR(tip(alloy, 2e-5) / tip(alloy, 1e-5), 2.0, 1e-4);
  EXPECT_GT(tip(alloy, 0.4) / tip(uniformChain(21.0, 1e9, 0.2, 32), 0.4), 1.0);
  // Alike until some joint bears the plateau's moment; then softer than the linear file of as much stiffness.
  FileChain linear = alloy;
  for (JointStiffness& joint : linear.bend) joint.plateau_rad = 0.0;
  EXPECT_GT(tip(alloy, 0.3), 1.05 * tip(linear, 0.3));
}

TEST(FileChain, PrebentItLiesAlongItsArcWithoutLoad) {
  const FileChain chain = phantom::steelFile(15);
  FileInCanal file(chain, withoutDrag(), {true, 0.0}, phantom::above(chain, 0.0));
  const double bent_mm = 8.0 * chain.link_mm, angle = 0.6;
  file.prebend(bent_mm, angle, 0.0);
  FileTick tick;
  for (int n = 0; n < 40; ++n) tick = file.step(phantom::above(chain, 0.0), {});
  EXPECT_NEAR(tick.energy_Nmm, 0.0, 1e-9);
  const glm::dvec3 end = file.state().shape.direction[chain.links];
  EXPECT_NEAR(std::atan2(end.x, -end.z), angle, 1e-6);
  EXPECT_NEAR(end.y, 0.0, 1e-9);

  // Turned in the hand it turns with it.
  FilePose turned = phantom::above(chain, 0.0);
  turned.rotation = glm::angleAxis(std::numbers::pi / 2.0, glm::dvec3(0.0, 0.0, -1.0));
  for (int n = 0; n < 200; ++n) tick = file.step(turned, {});
  EXPECT_NEAR(file.state().shape.direction[chain.links].y, -std::sin(angle), 1e-4);
}

TEST(FileChain, SteelBentBeyondThreePercentKeepsWhatIsBeyond) {
  const FileChain chain = phantom::steelFile(40);
  PerNode<glm::dvec3> pull{};
  pull[chain.links] = {4.0, 0.0, 0.0};
  FileInCanal file(chain, withoutDrag(), {true, 0.0}, phantom::above(chain, 0.0));
  FileScene scene;
  scene.pull_P_N = &pull;
  bool set = false;
  for (int n = 0; n < 200; ++n) set = file.step(phantom::above(chain, 0.0), scene).set || set;
  EXPECT_TRUE(set);
  FileTick tick;
  for (int n = 0; n < 60; ++n) tick = file.step(phantom::above(chain, 0.0), {});
  EXPECT_GT(file.state().shape.direction[chain.links].x, 0.02) << "bent without load";
  EXPECT_LT(tick.strain, 0.0301);
}

/// In the plane of its bend the other method comes to the same rest.
TEST(FileChain, TheDampedChainComesToTheSameRest) {
  const FileChain chain = fileChain(*assets::kFile(25, 21, assets::KFileMetal::steel), 16);
  PerNode<glm::dvec3> pull{};
  pull[16] = {0.05, 0.0, -0.02};
  pull[9] = {-0.02, 0.0, 0.0};
  const FileInCanal file = settledUnder(chain, pull);
  Rk4Chain damped(chain, 1e-3, 4);
  PerNode<glm::dvec2> force{};
  for (std::size_t i = 1; i <= 16; ++i) force[i] = {pull[i].x, -pull[i].z};
  for (int n = 0; n < 4000; ++n) damped.step(force);
  const glm::dvec3 tip = file.state().shape.node_mm[16], base = file.state().shape.node_mm[0];
  EXPECT_NEAR(damped.node_mm(16).x, tip.x, 1e-9);
  EXPECT_NEAR(damped.node_mm(16).y, base.z - tip.z, 1e-9);
}

TEST(FileChain, TheDampedChainIsOfFourthOrder) {
  const FileChain chain = uniformChain(kLength_mm, kBending_N_mm2, 0.2, 8);
  // One inertia for all: that of the coarsest.
  const double period_s = 1e-3;
  const auto tipAfter = [&](int substeps) {
    Rk4Chain one(chain, period_s, 1);
    PerNode<glm::dvec2> force{};
    force[8] = {0.01, 0.0};
    one.refine(substeps);
    for (int n = 0; n < 30; ++n) one.step(force);
    return one.node_mm(8).x;
  };
  const double fine = tipAfter(64);
  const double coarse = std::abs(tipAfter(8) - fine), half = std::abs(tipAfter(16) - fine);
  EXPECT_GT(coarse / half, 15.0);
  EXPECT_LT(coarse / half, 18.0);
}

}  // namespace
}  // namespace haptics
