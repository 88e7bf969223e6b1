// Constants of a file against the wall of its canal. Stiffness of the overlap and the depth of a flat face at touch:
// reference/sisters 1.3 (prototypes); friction along and across an edge of the flutes: 0.15 and 0.45, unverified. N,
// mm. Plain values; any thread.
#pragma once

namespace haptics {

struct FileLaw {
  double wall_N_per_mm3 = 2000.0;
  double tip_factor = 4.0;         ///< of the wall's stiffness, under the rounded tip
  double flat_face_voxels = 0.23;  ///< depth that a smooth face gives at touch, taken off
  double ray_step_mm = 0.04;       ///< at most; never more than a voxel
  double ray_reach_mm = 0.24;
  double friction_along = 0.15, friction_across = 0.45;
  double bristle_N_per_mm = 65.0;  ///< for a friction of 1
  double stop_N_per_mm = 50.0;     ///< of the rubber stop
  double drag_N_per_mm2 = 0.1;     ///< of each mm of file, for what moves in a tick aside from following itself

  bool operator==(const FileLaw&) const = default;
};

/// Bounds of a tick.
inline constexpr int kMostFileSteps = 12, kMostShortenings = 6, kMostTwistSteps = 12;
/// At rest: no node has farther to go, or not much and no more energy to gain.
inline constexpr double kSettledFile_mm = 5e-4, kNearlySettledFile_mm = 3e-3, kSettledFile_Nmm = 5e-7;
inline constexpr double kMostFileStep_mm = 0.3, kFarFileStep_mm = 0.05;
/// Followed in a tick: free, and on the wall.
inline constexpr double kMostHandStep_mm = 0.2, kMostPressedStep_mm = 0.04, kMostHandTurn_rad = 0.03;
/// The stiffest spring between hand and file at 1 kHz.
inline constexpr double kFileCoupling_N_per_mm = 0.8;

}  // namespace haptics
