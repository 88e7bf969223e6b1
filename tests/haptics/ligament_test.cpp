#include "haptics/ligament/hold_kernels.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "assets/instruction_set.h"
#include "haptics/ligament/ligament_law.h"
#include "tests/haptics/ligament_scene.h"
#include "tests/haptics/ligament_twin.h"

namespace haptics {
namespace {

constexpr double kTick_s = 1e-3;

/// Linear about rest, and alike for pulling and pressing.
LigamentLaw linearLaw() {
  LigamentLaw law;
  law.wall_N_per_mm2 = law.fibre_N_per_mm2;
  law.fluid_N_per_mm2 = 0.0;
  law.shear_weight = 0.4;
  law.drag_Ns_per_mm = 1e-4;
  return law;
}

struct Cylinder {
  static constexpr double kRadius_mm = 3.0, kLength_mm = 12.0, kWidth_mm = 0.2;
  PieceHold hold{arranged(phantom::cylinder(kRadius_mm, kLength_mm, 0.25, kWidth_mm)), linearLaw()};
  double area_mm2 = 2.0 * std::numbers::pi * kRadius_mm * kLength_mm;
  double normal = hold.law().fibre_N_per_mm2 / kWidth_mm, shear = normal * hold.law().shear_weight;
  double lateral = area_mm2 * (normal + shear) / 2.0;
  double tilt =
      area_mm2 * ((normal + shear) / 2.0 * kLength_mm * kLength_mm / 12.0 + shear * kRadius_mm * kRadius_mm / 2.0);

  double hessian(std::size_t n) const {
    PiecePose by;
    by.translation_mm.x = 1e-5;
    const HoldSums sums = phantom::sumsAt(hold, by);
    return sums.hessian[SymmetricSix::at(n, n)];
  }
};

TEST(Ligament, LawHasTheClosedFormsOfItsReference) {
  const LigamentLaw law;
  EXPECT_NEAR(law.peakStress_N_per_mm2(), 2.436, 1e-3);
  EXPECT_NEAR(law.tearEnergy_Nmm_per_mm2(0.2), 0.367, 1e-3);
}

TEST(Ligament, LawBringsWhatItCannotBearWithinBounds) {
  LigamentLaw law;
  law.fibre_N_per_mm2 = std::nan("");
  law.wall_stiffening = 1e9;
  law.peak_stretch = -3.0;
  law.torn_stretch = 0.0;
  const LigamentLaw tamed = law.sanitised();
  EXPECT_EQ(tamed.fibre_N_per_mm2, LigamentLaw{}.fibre_N_per_mm2);
  EXPECT_LE(tamed.wall_stiffening, 8.0);
  EXPECT_GT(tamed.torn_stretch, tamed.peak_stretch);
  EXPECT_EQ(LigamentLaw{}.sanitised(), LigamentLaw{}) << "the defaults are within";
}

TEST(Ligament, CylinderIsAsStiffAsItsClosedForm) {
  const Cylinder cylinder;
  EXPECT_NEAR(cylinder.hessian(0) / cylinder.lateral, 1.0, 1e-3);
  EXPECT_NEAR(cylinder.hessian(1) / cylinder.lateral, 1.0, 1e-3);
  EXPECT_NEAR(cylinder.hessian(2) / (cylinder.area_mm2 * cylinder.shear), 1.0, 1e-3);
}

TEST(Ligament, CylinderTurnsAsItsClosedForm) {
  const Cylinder cylinder;
  EXPECT_NEAR(cylinder.hessian(3) / cylinder.tilt, 1.0, 1e-3);
  EXPECT_NEAR(cylinder.hessian(4) / cylinder.tilt, 1.0, 1e-3);
  EXPECT_NEAR(cylinder.hessian(5) / (cylinder.area_mm2 * cylinder.shear * 9.0), 1.0, 1e-3);
}

TEST(Ligament, ForceAboveTheCentroidTurnsAboutAPointBelowIt) {
  Cylinder cylinder;
  constexpr double kHeight_mm = 10.0;
  PieceDrive drive;
  drive.force_N.xyz.x = 0.04;
  drive.load_at_P.mm.z = kHeight_mm;
  for (int n = 0; n < 200; ++n) cylinder.hold.step(drive, nullptr, kTick_s);
  const PiecePose& X_PQ = cylinder.hold.state().X_PQ;
  const double angle_rad = 2.0 * X_PQ.rotation.y, way_mm = (X_PQ * calibration::Point<calibration::Piece>{}).mm.x;
  EXPECT_NEAR(way_mm / angle_rad, cylinder.tilt / (cylinder.lateral * kHeight_mm), 2e-3 * 1.457);
}

/// Worn roots somewhere off rest.
PieceHold wornRoots(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> share(0.0F, 0.7F), small(-0.02F, 0.02F);
  PieceHold hold(arranged(phantom::twoRoots(0.6)), LigamentLaw{});
  PieceState state = hold.state();
  for (float& torn : state.ligament.torn) torn = share(random);
  for (float& fluid : state.ligament.fluid_N_per_mm2) fluid = small(random);
  for (float& strain : state.ligament.strain) strain = small(random);
  for (float& widened : state.ligament.widened_mm) widened = std::abs(small(random));
  hold.restore(state);
  return hold;
}

PiecePose somewhere(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> way(-0.12, 0.12), turn(-0.012, 0.012);
  const glm::dquat rotation(1.0, turn(random), turn(random), turn(random));
  return {glm::normalize(rotation), {way(random), way(random), way(random)}};
}

TEST(Ligament, KernelIsItsSlowTwin) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const PieceHold hold = wornRoots(seed);
    const PiecePose at = somewhere(seed);
    const HoldSums fast = phantom::sumsAt(hold, at);
    const phantom::TwinSums slow = phantom::twinSums(hold, at, nullptr, kTick_s);
    EXPECT_NEAR(fast.energy / slow.energy, 1.0, 1e-5);
    double force = 0.0, stiffness = 0.0;
    for (std::size_t n = 0; n < 6; ++n) {
      force = std::max(force, std::abs(slow.gradient[n]));
      stiffness = std::max(stiffness, slow.hessian[n][n]);
    }
    for (std::size_t row = 0; row < 6; ++row) {
      EXPECT_NEAR(fast.gradient[row], slow.gradient[row], 1e-5 * force) << row;
      for (std::size_t column = row; column < 6; ++column)
        EXPECT_NEAR(fast.hessian[SymmetricSix::at(row, column)], slow.hessian[row][column], 1e-5 * stiffness)
            << row << ' ' << column;
    }
  }
}

/// Turned about the samples' centre, then moved.
PiecePose beside(const PieceHold& hold, const PiecePose& X_PQ, std::size_t axis, double by) {
  const int part = static_cast<int>(axis % 3);
  glm::dvec3 turn(0.0), way(0.0);
  (axis < 3 ? way : turn)[part] = by;
  const glm::dvec3 centre = X_PQ.rotation * hold.samples().centre_Q_mm + X_PQ.translation_mm + way;
  const glm::dquat rotation =
      glm::normalize(glm::dquat(std::cos(by / 2.0), std::sin(by / 2.0) * turn / by)) * X_PQ.rotation;
  const glm::dquat kept = axis < 3 ? X_PQ.rotation : rotation;
  return {kept, centre - kept * hold.samples().centre_Q_mm};
}

TEST(Ligament, GradientIsTheDifferenceOfTheEnergy) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const PieceHold hold = wornRoots(seed);
    const PiecePose at = somewhere(seed + 100);
    const HoldSums sums = phantom::sumsAt(hold, at);
    double largest = 0.0;
    for (const double slope : sums.gradient) largest = std::max(largest, std::abs(slope));
    for (std::size_t axis = 0; axis < 6; ++axis) {
      const double h = axis < 3 ? 1e-4 : 2e-5;
      const auto energy = [&](double by) {
        return phantom::twinSums(hold, beside(hold, at, axis, by), nullptr, kTick_s).energy;
      };
      EXPECT_NEAR((energy(h) - energy(-h)) / (2.0 * h), sums.gradient[axis], 1e-4 * largest) << axis;
    }
  }
}

TEST(Ligament, HalfTheSpacingHoldsTheSame) {
  std::array<double, 2> pull{}, tilt{};
  for (std::size_t n = 0; n < 2; ++n) {
    const double spacing_mm = n == 0 ? 0.5 : 0.25;
    PieceHold pulled(arranged(phantom::twoRoots(spacing_mm)), LigamentLaw{}), tilted = pulled;
    for (int tick = 0; tick < 400; ++tick) {
      const HoldTick up = pulled.step(phantom::pulledUp(5e-4 * tick * 2.0), nullptr, kTick_s);
      pull[n] = std::max(pull[n], -up.on_hand.force_N.xyz.z);
      PieceDrive drive;
      drive.spring.stiffness_Nmm_per_rad = 3e5;
      const double angle_rad = 2e-4 * tick;
      drive.spring.target_X_PQ.rotation = glm::dquat(std::cos(angle_rad / 2.0), std::sin(angle_rad / 2.0), 0.0, 0.0);
      tilt[n] = std::max(tilt[n], -tilted.step(drive, nullptr, kTick_s).on_hand.torque_Nmm.xyz.x);
    }
  }
  EXPECT_NEAR(pull[1] / pull[0], 1.0, 0.02);
  EXPECT_NEAR(tilt[1] / tilt[0], 1.0, 0.025);
  EXPECT_NEAR(tilt[0], 4250.0, 200.0) << "as the reference has it";
}

/// Sums and what a tick leaves, as bytes.
template <class Sum, class Age>
std::vector<char> bytesOf(Sum sum, Age age, const PieceHold& hold, const PiecePose& at,
                          const DistanceField* obstacles) {
  const auto [law, samples, place] = hold.inputAt(at, obstacles, kTick_s);
  LigamentMemory memory = hold.state().ligament;
  const HoldSums sums = sum(law, samples, place);
  const HoldAge aged =
      age(law, samples, place,
          {memory.torn.data(), memory.fluid_N_per_mm2.data(), memory.strain.data(), memory.widened_mm.data()});
  std::vector<char> bytes(sizeof sums + sizeof aged);
  std::memcpy(bytes.data(), &sums, sizeof sums);
  std::memcpy(bytes.data() + sizeof sums, &aged, sizeof aged);
  for (const auto* values : {&memory.torn, &memory.fluid_N_per_mm2, &memory.strain, &memory.widened_mm}) {
    const char* first = static_cast<const char*>(static_cast<const void*>(values->data()));
    bytes.insert(bytes.end(), first, first + values->size() * sizeof(float));
  }
  return bytes;
}

TEST(Ligament, EveryInstructionSetHasTheSameBits) {
  const phantom::SocketScene scene = phantom::rootInSocket();
  const DistanceField bone(scene.bone.grid, scene.bone.solid, 1.6);
  PieceHold in_bone = scene.hold(bone);
  for (unsigned seed = 0; seed < 12; ++seed) {
    const PieceHold roots = wornRoots(seed);
    const bool has_field = seed % 2 == 1;
    const PieceHold& hold = has_field ? in_bone : roots;
    const DistanceField* obstacles = has_field ? &bone : nullptr;
    const PiecePose at = somewhere(seed);
    const std::vector<char> bytes = bytesOf(&portable::sumHold, &portable::ageHold, hold, at, obstacles);
#if defined(__x86_64__)
    if (assets::available(assets::InstructionSet::avx2)) {
      EXPECT_TRUE(bytesOf(&avx2::sumHold, &avx2::ageHold, hold, at, obstacles) == bytes) << seed;
    }
    if (assets::available(assets::InstructionSet::avx512)) {
      EXPECT_TRUE(bytesOf(&avx512::sumHold, &avx512::ageHold, hold, at, obstacles) == bytes) << seed;
    }
#endif
  }
}

}  // namespace
}  // namespace haptics
