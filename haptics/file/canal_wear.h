// What a file takes from the wall of its canal; per section and tick:
//   wear:              dV = alpha N |m| eta, m = slip across the edge = |a sin b - c cos b| (a axial slip, c round)
//   counters:          dV = delta A |a|, A the wall it touches: the published numbers along a file, at any force;
//                      Archard's law at the pressure delta / alpha.   counters_helical: dV = delta A |m|
// eta 1 drawn out, 0.5 pushed in (unverified); alpha 3e-4 mm3/(N mm) of dentine, a guess until it is fitted to grooves
// filed at a constant force; other tissues by their removal factor. Taken where the section presses deepest, never more
// than the file has swept; what cannot be taken now is carried on, so the books close. In a tick the section with the
// most due takes it. Frame P; mm, N, mm3. Servo thread: no allocation; 10 to 40 µs. Source: reference/sisters 2.1,
// 2.2.
#pragma once

#include <cstdint>

#include "haptics/bone/carve.h"
#include "haptics/bone/carved_bone.h"
#include "haptics/file/file_flutes.h"
#include "haptics/file/file_in_canal.h"
#include "haptics/file/wall_contact.h"

namespace haptics {

enum class WearLaw : std::uint8_t { wear, counters, counters_helical };

struct WearSettings {
  WearLaw law = WearLaw::wear;
  double alpha_mm3_per_Nmm = 3e-4, push_share = 0.5;
  double counter = 3e-3;  ///< delta: mm of wall a mm of slip

  bool operator==(const WearSettings&) const = default;
};

/// Every number in its range, defaults for what is none.
WearSettings sanitised(const WearSettings& settings) noexcept;

inline constexpr std::size_t kWornAtOnce = 1;  ///< sections

/// mm3 of a section in a tick.
double wornVolume_mm3(const WearSettings& settings, double normal_N, double touched_mm2, const glm::dvec2& slip_mm,
                      double radius_mm, double lead_mm) noexcept;

class CanalWear {
 public:
  explicit CanalWear(const WearSettings& settings = {}) : settings_(settings) {}

  /// What the file did in its last tick, from the wall that it lay against. Changed blocks are saved to `strokes`.
  /// `flutes`: filled and dulled by the law `wear`; null: for ever empty and sharp, as the published counters are.
  CarveResult step(const FileInCanal& file, CarvedBone& wall, StrokeHistory* strokes, std::uint64_t tick,
                   FileFlutes* flutes = nullptr) noexcept;

  double due_mm3() const noexcept { return due_mm3_; }          ///< by the law, so far
  double removed_mm3() const noexcept { return removed_mm3_; }  ///< from the wall
  double carried_mm3() const noexcept { return due_mm3_ - removed_mm3_; }

 private:
  struct Section {
    double due_mm3 = 0.0;      ///< not yet taken
    double touched_mm2 = 0.0;  ///< when it was last looked at
  };
  /// How much of the wall it touches; false: nothing.
  static bool lookAt(const FileLaw& law, const SolidField& field, const SectionPlace& at, Section& section,
                     std::array<double, kRays>* depth_mm = nullptr) noexcept;
  static SectionPlace placeOf(const FileInCanal& file, std::size_t section) noexcept;
  CarveResult take(const FileLaw& law, const SectionPlace& at, Section& section, CarvedBone& wall,
                   StrokeHistory* strokes, std::uint64_t tick) noexcept;

  WearSettings settings_;
  PerNode<Section> of_{};
  double due_mm3_ = 0.0, removed_mm3_ = 0.0;
};

}  // namespace haptics
