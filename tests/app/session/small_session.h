// A small session for tests: a few voxels of bone and ticks with every field set to something of its own. No servo;
// ticks are made up. Test code only.
#pragma once

#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/session/session_start.h"
#include "haptics/servo/tick.h"
#include "tests/scratch_folder.h"

namespace app::test {

struct SmallBone {
  assets::VolumeGrid grid{{10, 9, 8}, 0.2, {-1.0, 2.5, 0.0}};
  std::vector<std::uint8_t> solid, label;
  SmallBone() : solid(grid.voxelCount()), label(grid.voxelCount()) {
    for (std::size_t v = 0; v < solid.size(); ++v) {
      solid[v] = static_cast<std::uint8_t>(v * 7);
      label[v] = static_cast<std::uint8_t>(v % 10);
    }
  }
  SessionStart start() const {
    SessionStart start{"built-in patient, right", "0.1.0", 0.001, grid, solid, label, {}};
    start.command.serial = 1;
    start.calibration = {"5d41",
                         "rig-02",
                         "60623",
                         "red",
                         16,
                         1.24,
                         1.8,
                         2.5,
                         "2026-11-19T08:20:00Z",
                         3.4,
                         "demonstration without a patient"};
    return start;
  }
};

/// Tick `index` of an imagined rehearsal: smooth, as a hand is.
inline haptics::Tick imaginedTick(std::uint64_t index, std::uint64_t serial = 1) {
  haptics::Tick tick;
  tick.index = index;
  tick.dt_s = 0.001;
  tick.t_s = static_cast<double>(index) * tick.dt_s;
  tick.command_serial = serial;
  const double s = std::sin(2.0 * tick.t_s);
  tick.hand.X_PT = {glm::normalize(glm::dquat{1.0, 0.1 * s, -0.2, 0.3}), {s, 2.0 - s, 3.0 * s}};
  tick.hand.velocity_P_mm_per_s.xyz = {s * 4.0, -s, 0.25};
  tick.hand.drill_pedal = index % 3 != 0;
  tick.proxy_P.mm = {s + 0.1, 2.0 - s, 3.1 * s};
  tick.law_force_P_N.xyz = {0.5 * s, -0.25 * s, 1.0 / 3.0};
  tick.commanded_force_P_N.xyz = {0.4 * s, -0.2 * s, 0.3};
  tick.hand.arm_P_mm.xyz = {s, 0.5, -40.0};
  tick.law_torque_P_Nmm.xyz = {3.0 * s, 0.125, -s};
  tick.commanded_torque_P_Nmm.xyz = {2.5 * s, 0.0625, -s};
  tick.energy_Nmm = 0.01 * s;
  tick.spindle_rad_per_s = 4000.0 + s;
  tick.overlap_mm3 = 0.75 + s;
  tick.depth_mm = 0.1 * s * s;
  tick.removed_mm3 = 1e-4 * s;
  tick.bone_digest = 0x9e3779b97f4a7c15ULL * (index + 1);
  tick.contact_tissue = static_cast<std::uint8_t>(index % 10);
  tick.drilling = index % 2 == 0;
  tick.faults = index % 100 == 0 ? haptics::Fault::clamped | haptics::Fault::slewed : haptics::Fault::none;
  tick.work_us = 12.5f;
  return tick;
}

inline std::vector<haptics::Tick> imaginedTicks(std::uint64_t first, std::uint64_t count) {
  std::vector<haptics::Tick> ticks;
  for (std::uint64_t i = first; i < first + count; ++i) ticks.push_back(imaginedTick(i));
  return ticks;
}

inline std::string bytesOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void writeBytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace app::test
