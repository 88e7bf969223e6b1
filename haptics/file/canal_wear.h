// What a file takes from the wall of its canal, over a small field of its own; per section and tick:
//   wear:              dV = alpha N |m| eta, m = slip across the edge = |a sin b - c cos b| (a axial slip, c round)
//   counters:          dV = delta A |a|, A the wall it touches: the published numbers along a file, at any force;
//                      Archard's law at the pressure delta / alpha.   counters_helical: dV = delta A |m|
// eta 1 drawn out, 0.5 pushed in (unverified); alpha 3e-4 mm3/(N mm), a guess until it is fitted to grooves filed at a
// constant force. Taken where the section presses deepest, never more than the file has swept; what cannot be taken now
// is carried on, so the books close. Frame P; mm, N, mm3. Not for the servo's thread: 50 to 400 µs, no allocation.
// Source: reference/sisters 2.1, 2.2.
#pragma once

#include <span>
#include <vector>

#include "haptics/bone/cubelets.h"
#include "haptics/file/file_in_canal.h"
#include "haptics/file/wall_contact.h"

namespace haptics {

enum class WearLaw { wear, counters, counters_helical };

struct WearSettings {
  WearLaw law = WearLaw::wear;
  double alpha_mm3_per_Nmm = 3e-4, push_share = 0.5;
  double counter = 3e-3;  ///< delta: mm of wall a mm of slip
};

/// mm3 of a section in a tick.
double wornVolume_mm3(const WearSettings& settings, double normal_N, double touched_mm2, const glm::dvec2& slip_mm,
                      double radius_mm, double lead_mm) noexcept;

class CanalWear {
 public:
  /// Copies both. Allocates.
  CanalWear(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, const WearSettings& settings);

  /// What the file did in its last tick.
  void step(const FileInCanal& file) noexcept;

  /// The wall as it is now; valid as long as this.
  SolidField wall() const { return cubelets_.field(); }
  double due_mm3() const noexcept { return due_mm3_; }          ///< by the law, so far
  double removed_mm3() const noexcept { return removed_mm3_; }  ///< from the wall
  double carried_mm3() const noexcept { return due_mm3_ - removed_mm3_; }

 private:
  double take(const FileLaw& law, const SectionPlace& at, double volume_mm3) noexcept;
  void store(glm::ivec3 low, glm::ivec3 high) noexcept;

  assets::VolumeGrid grid_;
  WearSettings settings_;
  std::vector<float> left_;  ///< share of each voxel, finer than its byte
  Cubelets cubelets_;
  PerNode<double> carried_mm3_{};
  double due_mm3_ = 0.0, removed_mm3_ = 0.0;
};

}  // namespace haptics
