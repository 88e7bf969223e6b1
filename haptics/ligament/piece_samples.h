// Points of a piece's surface that hold it in its socket or meet what is around it: structure of arrays for the
// kernels. Those with ligament come first, each group padded to sixteen by samples of no area. Places in frame Q about
// `centre_Q_mm`; normals out of the piece, fixed in P, where at rest Q lies on P. mm. Made by workers (allocates, 10 to
// 40 ms a tooth); the servo only reads. Reference/extraction 3.1, 3.4, 4.2.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "haptics/body/distance_field.h"
#include "haptics/body/way_out.h"
#include "haptics/ligament/ligament_law.h"

namespace haptics {

inline constexpr std::size_t kSampleLanes = 16, kMostSamples = 4096;
/// A root's surface farther than this from bone has no ligament.
inline constexpr double kLigamentReach_mm = 0.6;
/// Bone that lies within this of a socket's point still holds its fibres.
inline constexpr double kSocketReach_mm = 0.3;

struct PieceSamples {
  glm::dvec3 centre_Q_mm{0.0};  ///< mean of the places by area
  std::size_t ligament = 0;     ///< samples with ligament, padding counted
  std::vector<float> place_mm[3], normal[3];
  std::vector<float> area_mm2, width_mm;
  /// Distance to the obstacles at which nothing presses: as at rest, so that rest is free of stress. Without ligament
  /// zero, or the overlap at rest.
  std::vector<float> rest_gap_mm;

  std::size_t size() const { return area_mm2.size(); }
  double ligamentArea_mm2() const;
};

/// What the ligament's samples remember, beside the pose of the piece. 0 at rest.
struct LigamentMemory {
  std::vector<float> torn;             ///< share 0..1; only grows
  std::vector<float> fluid_N_per_mm2;  ///< stress of the Maxwell branch
  std::vector<float> strain;           ///< along the normal at the last tick
  std::vector<float> widened_mm;       ///< the socket's wall, for good
};

struct SamplePoint {
  glm::dvec3 p_Q_mm{0.0};
  glm::dvec3 outward{0.0, 0.0, 1.0};  ///< unit
  double area_mm2 = 0.0, width_mm = 0.2;
  double rest_gap_mm = 0.0;
  bool has_ligament = false;
};

/// In the order given, ligament first. At most kMostSamples with padding (assert).
PieceSamples arranged(const std::vector<SamplePoint>& points);
LigamentMemory unworn(const PieceSamples& samples);

/// Whether fibres may end at this place of the surface: on the root, not on crown, follicle, cut or fracture.
using IsRoot = std::function<bool(const glm::dvec3& p_Q_mm, const glm::dvec3& outward)>;

/// `piece` where it lies at rest, about `spacing_mm` apart (wider if there were too many); ligament where is_root and
/// the obstacles' surface lies in front within kLigamentReach_mm. Widths scatter by a hash of the index. Empty without
/// a solid voxel.
std::vector<SamplePoint> surfaceSamples(const SolidVoxels& piece, const DistanceField& obstacles, const IsRoot& is_root,
                                        const LigamentLaw& law, double spacing_mm = 0.5);

/// What a change of the obstacles does to the samples: for a worker to find and for the servo to take over.
struct SocketChange {
  std::vector<float> rest_gap_mm;  ///< of all samples
  std::vector<float> torn;         ///< of the ligament's, 1 where the socket's bone within kSocketReach_mm is gone
};

/// Rest gaps anew where bone still stands. `samples` are those before the change.
SocketChange socketAfter(const DistanceField& obstacles, const PieceSamples& samples);

}  // namespace haptics
