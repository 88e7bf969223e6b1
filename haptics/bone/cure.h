// A curing lamp over a filling: light goes from its tip along -z of T, no wider than the tip and a little, and reaches
// kCuredDepth_mm into what is solid, tooth or filling; a voxel sets once it has had its material's time. Blocks take
// turns: kBlocksPerTick a tick, each with the time since its last turn, so that the work of a tick is bounded. Frame P.
// The thread that owns the filling; under 60 us a tick; no allocation, no throw. Times: bone/filling; 2 mm:
// reference/sisters 5.4.
#pragma once

#include <cstdint>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/filling.h"

namespace haptics {

inline constexpr double kCuredDepth_mm = 2.0, kLampReach_mm = 8.0, kLampRadius_mm = 4.0;

/// Part of the servo's state.
class CuringLight {
 public:
  static constexpr int kBlocksPerTick = 2, kLookedAtPerTick = 512;

  /// A tick with the lamp on; its tip `tip_mm` below T's origin. Returns the steps of 1/255 of a voxel that have set.
  std::int64_t shine(const SolidField& tooth, Filling& filling,
                     const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, double tip_mm, double dt_s,
                     StrokeHistory* strokes) noexcept;
  /// The lamp is off: the next turn begins anew.
  void rest() noexcept { *this = {}; }

 private:
  std::int64_t lightBlock(const SolidField& tooth, Filling& filling, std::size_t number, glm::ivec3 block,
                          const glm::dmat3& to_T, const glm::dvec3& tip, StrokeHistory* strokes) const noexcept;

  glm::ivec3 first_{0}, size_{0};  ///< blocks of the turn
  std::size_t next_ = 0;           ///< of them
  double turn_s_ = 0.0;            ///< of this turn so far
  double due_s_ = 0.0;             ///< of light for every block of this turn: what the last one took
};

}  // namespace haptics
