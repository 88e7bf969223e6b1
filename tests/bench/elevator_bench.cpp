// An elevator between a tooth and its crest: ticks of twisting while the ligament holds and tears, beside the forceps
// on the same piece. Two roots with 968 samples of ligament and some 1100 of a crown. MOLAR_INSTRUCTIONS=portable or
// avx2 selects the set.
#include <cstdio>
#include <string>

#include "assets/instruction_set.h"
#include "tests/bench/extraction_parts.h"
#include "tests/haptics/elevator_scene.h"

namespace bench {
namespace {

void print(const char* name, std::vector<double>& us, int evaluations) {
  std::sort(us.begin(), us.end());
  std::printf("  %-22s %zu ticks: median %5.1f, 99 %% %5.1f µs; %.2f evaluations\n", name, us.size(), us[us.size() / 2],
              us[us.size() * 99 / 100], evaluations / static_cast<double>(us.size()));
}

}  // namespace

void benchElevator() {
  const haptics::phantom::LuxationScene scene(0.5, 14);
  std::printf("elevator: ticks with %s\n", std::string(assets::nameOf(assets::chosenInstructionSet())).c_str());
  {
    haptics::PieceHold piece = scene.hold();
    std::printf("  %zu samples, %zu of them with ligament\n", piece.samples().size(), piece.samples().ligament);
    haptics::PieceDrive drive;
    drive.spring.stiffness_N_per_mm = 2e3;
    drive.spring.stiffness_Nmm_per_rad = 1e5;
    std::vector<double> us;
    int evaluations = 0;
    for (int n = 0; n < 2000; ++n) {
      drive.spring.target_X_PQ.translation_mm = {0.03 * std::sin(n * 0.012), 0.03 * std::cos(n * 0.017), 0.0};
      const double began_us = threadTime_us();
      evaluations += piece.step(drive, &scene.obstacles, 1e-3).evaluations;
      us.push_back(threadTime_us() - began_us);
    }
    print("forceps", us, evaluations);
  }
  for (const double torque_Nmm : {400.0, 650.0}) {
    haptics::PieceHold piece = scene.hold();
    haptics::ElevatorHold hold;
    hold.take(haptics::ElevatorKind::straight_34s, scene.rest_X_PT);
    std::vector<double> us;
    int evaluations = 0, unsettled = 0;
    double torn = 0.0;
    for (int n = 0; n < 4000; ++n) {
      const double share = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * n / 1500.0);
      const haptics::ElevatorHand hand = scene.turned(0.9 * share, torque_Nmm);
      const double began_us = threadTime_us();
      const haptics::ElevatorTick tick = hold.step(hand, scene.scene(), &piece, 1e-3);
      us.push_back(threadTime_us() - began_us);
      evaluations += tick.evaluations;
      unsettled += tick.unsettled ? 1 : 0;
      torn = tick.torn_share;
    }
    const std::string name = "twisted to " + std::to_string(static_cast<int>(torque_Nmm)) + " N mm";
    print(name.c_str(), us, evaluations);
    std::printf("    not settled: %d; torn %.2f\n", unsettled, torn);
  }
}

}  // namespace bench
