// A rehearsal for tests: a real servo carving a real block of bone, driven by a hand that is a function of time, with
// one change of command. Faster than real time; no device, no thread of its own. Test code only.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "app/session/recorder.h"
#include "app/session/replay.h"
#include "app/text/version.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/servo.h"
#include "tests/app/session/small_session.h"

namespace app::test {

/// A block of bone 8 mm wide with its surface, one voxel of grey, at z = 0; enamel below z = -2.
struct BoneBlock {
  assets::VolumeGrid grid{{41, 41, 26}, 0.2, {-4.0, -4.0, -4.0}};
  std::vector<std::uint8_t> solid, label;
  BoneBlock() : solid(grid.voxelCount()), label(grid.voxelCount()) {
    for (int k = 0; k < grid.size.z; ++k) {
      for (int j = 0; j < grid.size.y; ++j) {
        for (int i = 0; i < grid.size.x; ++i) {
          const double z_mm = grid.centre_P_mm({i, j, k}).z;
          solid[grid.index({i, j, k})] = z_mm < -0.1 ? 255 : z_mm < 0.1 ? 128 : 0;
          label[grid.index({i, j, k})] = z_mm < -2.0 ? 4 : 1;
        }
      }
    }
  }
  SessionStart start() const {
    SessionStart start{"block of bone", std::string(programVersion()), 0.001, grid, solid, label, {}};
    start.command.serial = 1;
    start.command.tool.head.radius_mm = 1.0;
    return start;
  }
};

/// Sweeps to and fro, 0.4 mm deep, the pedal down half of the time.
inline haptics::HandSample sweepingHand(double t_s) {
  haptics::HandSample hand;
  hand.X_PT.translation_mm = {2.0 * std::sin(9.0 * t_s), 0.5 * std::cos(4.0 * t_s), 0.6 + 0.1 * std::sin(40.0 * t_s)};
  hand.velocity_P_mm_per_s.xyz = {18.0 * std::cos(9.0 * t_s), -2.0 * std::sin(4.0 * t_s), 4.0 * std::cos(40.0 * t_s)};
  hand.drill_pedal = std::fmod(t_s, 0.2) < 0.1;
  return hand;
}

inline haptics::Command largerBur(const haptics::Command& first) {
  haptics::Command second = first;
  second.serial = 2;
  second.tool.head.radius_mm = 1.3;
  second.law.damping_Ns_per_mm = 0.001;
  return second;
}

/// Ticks of the rehearsal, the larger bur from tick `change` on; the bone is carved on the way.
inline std::vector<haptics::Tick> rehearse(haptics::Bodies& bone, const haptics::Command& first, std::size_t ticks,
                                           std::size_t change) {
  haptics::Servo servo(bone);
  std::vector<haptics::Tick> made;
  for (std::size_t n = 0; n < ticks; ++n) {
    const haptics::Command command = n < change ? first : largerBur(first);
    made.push_back(servo.step(sweepingHand(static_cast<double>(n) * 0.001), command, 0.001));
  }
  return made;
}

}  // namespace app::test
