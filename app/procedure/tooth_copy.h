// A copy of the live tooth for a worker that measures it, brought up to date by bricks, beside the tooth before
// anything was cut; both on whole blocks, the grid grown with air. And when to measure: a moment after each stroke, and
// every few seconds of a long one. Main thread, microseconds a brick; a worker reads it while nothing is taken over.
// Frame P.
#pragma once

#include <span>
#include <vector>

#include "assets/ct_volume.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/tick.h"

namespace app {

class ToothCopy {
 public:
  /// `before`: of the scan's grid.
  ToothCopy(const assets::CtVolume& scan, std::span<const std::uint8_t> before);

  const assets::VolumeGrid& grid() const { return grid_; }
  std::span<const std::uint8_t> before() const { return before_; }
  std::span<const std::uint8_t> labels() const { return label_; }
  std::span<const std::uint8_t> now() const { return now_; }
  /// What was laid into it; empty volumes: nothing was yet.
  const haptics::Filling::Volumes& filling() const { return filling_; }

  /// Those bricks of the live jaw.
  void take(const haptics::Bodies& bodies, std::span<const glm::ivec3> bricks);

 private:
  assets::VolumeGrid grid_;
  std::vector<std::uint8_t> before_, label_, now_;
  haptics::Filling::Volumes filling_;
};

class StrokePause {
 public:
  /// At each frame; `has_changed`: something is to be measured.
  bool isDue(const haptics::Tick& newest, bool has_changed);

 private:
  double busy_s_ = -1e9, measured_s_ = -1e9;
};

}  // namespace app
