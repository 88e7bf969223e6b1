// A piece in its socket: one sum of its hold per instruction set beside the slow twin, and whole ticks while it is
// attached, tears and lies loose. Two roots with 438, 968 and 1444 samples of ligament and some 900 of a crown, in
// bone. MOLAR_INSTRUCTIONS=portable or avx2 selects the set of the ticks.
#include <cstdio>

#include "assets/instruction_set.h"
#include "tests/bench/extraction_parts.h"
#include "tests/haptics/ligament_scene.h"
#include "tests/haptics/ligament_twin.h"

namespace bench {
namespace {

using haptics::DistanceField;
using haptics::PieceHold;
using haptics::SamplePoint;

double rootsDistance_mm(const glm::dvec3& p) {
  const double depth_mm = std::clamp(-p.z, 0.0, 11.0), radius = 2.5 - 1.6 * depth_mm / 11.0;
  const double one = std::hypot(p.x - 2.6, p.y, p.z + depth_mm), other = std::hypot(p.x + 2.6, p.y, p.z + depth_mm);
  return std::min(one, other) - radius;
}

PieceHold holdIn(const DistanceField& bone, double spacing_mm) {
  std::vector<SamplePoint> points = haptics::phantom::twoRoots(spacing_mm);
  for (SamplePoint& point : points) point.rest_gap_mm = bone.at_mm(point.p_Q_mm);
  // Rows about a crown, which meets nothing at rest.
  for (int row = 0; row < 12; ++row)
    haptics::phantom::addRing(points, {0.0, 0.0, 0.5 + 0.5 * row}, 5.6, 19.0, 0.47, 0.0, 0.0, 0.2);
  for (SamplePoint& point : points) point.has_ligament = point.p_Q_mm.z < 0.0;
  return {arranged(points), haptics::LigamentLaw{}};
}

void printTicks(PieceHold hold, const DistanceField& bone) {
  constexpr int kAttached = 1500, kLoose = 1500, kMost = 6000;
  std::array<std::vector<double>, 3> us;
  std::array<double, 3> evaluations{};
  haptics::PieceDrive drive;
  drive.spring.stiffness_N_per_mm = 2e3;
  drive.spring.stiffness_Nmm_per_rad = 1e5;
  double torn = 0.0;
  for (int n = 0; n < kMost && us[2].size() < kLoose; ++n) {
    // Sways, then is pulled up.
    const double sway = std::sin(n * 0.012), up_mm = n < kAttached ? 0.0 : 5e-4 * (n - kAttached);
    drive.spring.target_X_PQ.translation_mm = {0.03 * sway, 0.03 * std::cos(n * 0.017), up_mm};
    drive.spring.target_X_PQ.rotation = glm::normalize(glm::dquat(1.0, 0.005 * sway, 0.004 * std::cos(n * 0.02), 0.0));
    const std::size_t phase = torn < 0.001 ? 0 : torn < 1.0 ? 1 : 2;
    const double began_us = threadTime_us();
    const haptics::HoldTick tick = hold.step(drive, &bone, 1e-3);
    us[phase].push_back(threadTime_us() - began_us);
    evaluations[phase] += tick.evaluations;
    torn = tick.torn_share;
  }
  constexpr const char* kPhases[] = {"attached", "tearing", "loose"};
  for (std::size_t phase = 0; phase < 3; ++phase) {
    std::vector<double>& of = us[phase];
    if (of.empty()) continue;
    std::sort(of.begin(), of.end());
    std::printf("    %-9s %5zu ticks: median %5.1f, 99 %% %5.1f µs; %.2f evaluations\n", kPhases[phase], of.size(),
                of[of.size() / 2], of[of.size() * 99 / 100], evaluations[phase] / static_cast<double>(of.size()));
  }
  std::printf("    not settled: %d\n", hold.unsettled());
}

}  // namespace

void benchLigament() {
  const haptics::phantom::ToothPhantom solid = haptics::phantom::solidOf(
      {90, 60, 140}, 0.2, [](const glm::dvec3& p) { return std::max(p.z + 0.3, 0.22 - rootsDistance_mm(p)); });
  const DistanceField bone(solid.grid, solid.solid, 1.6);
  std::printf("ligament: ticks with %s\n", std::string(assets::nameOf(assets::chosenInstructionSet())).c_str());
  for (const double spacing_mm : {0.75, 0.5, 0.41}) {
    const PieceHold hold = holdIn(bone, spacing_mm);
    const haptics::PiecePose at{glm::normalize(glm::dquat(1.0, 0.004, 0.003, 0.002)), {0.05, 0.03, 0.06}};
    const PieceHold::KernelInput in = hold.inputAt(at, &bone, 1e-3);
    std::printf("  %d samples, %d of them with ligament; one sum, µs:", in.samples.all, in.samples.ligament);
    double energy = 0.0;
    const auto print = [&](const char* name, int times, auto sum) {
      std::printf(" %s %.2f", name, p10_us(times, [&] { energy += sum(); }));
    };
    print("twin", 20, [&] { return haptics::phantom::twinSums(hold, at, &bone, 1e-3).energy; });
    print("portable", 500, [&] { return haptics::portable::sumHold(in.law, in.samples, in.place).energy; });
#if defined(__x86_64__)
    if (assets::available(assets::InstructionSet::avx2))
      print("avx2", 500, [&] { return haptics::avx2::sumHold(in.law, in.samples, in.place).energy; });
    if (assets::available(assets::InstructionSet::avx512))
      print("avx512", 500, [&] { return haptics::avx512::sumHold(in.law, in.samples, in.place).energy; });
#endif
    std::printf("  (%.3f)\n", energy);
    printTicks(hold, bone);
  }
}

}  // namespace bench
