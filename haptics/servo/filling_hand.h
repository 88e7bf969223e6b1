// The instruments that fill a tooth, at work while the pedal is down: an applicator lays its material at
// kLaying_mm3_per_s into air it touches filling or tooth with, a plugger presses aside what has not set, one for root
// canals ahead of itself too, a carver takes filling away (each material by its removal factor), a curing lamp shines.
// Amalgam and glass ionomer set by themselves meanwhile, an increment as long after it was begun as its material needs.
// A cone that was let go of is laid (bone/lay_cone): meanwhile no instrument works. Frame P. Servo thread; once a tick
// after the contact; costs: bone/lay, bone/lay_cone, bone/cure, bone/hardening; no allocation, no throw.
#pragma once

#include "haptics/body/bodies.h"
#include "haptics/bone/cure.h"
#include "haptics/bone/erosion.h"
#include "haptics/bone/hardening.h"
#include "haptics/bone/lay_cone.h"
#include "haptics/servo/filling_work.h"
#include "haptics/tool/tool.h"

namespace haptics {

inline constexpr double kLaying_mm3_per_s = 3.0;
inline constexpr double kPacking_per_s = 25.0;  ///< share of what is in a plugger's way
inline constexpr unsigned kAsideOneIn = 4;      ///< ticks of a root plugger in which it presses aside, not ahead
/// Of the time in which it sets by itself a mix is laid, then a new one (condensed for 3.5 of 4.5 min, as
/// settingOf()).
inline constexpr double kMixed_share = 0.75;
inline constexpr double kCarving_per_s = 0.2;  ///< of a covered voxel of removal factor 1

class FillingHand {
 public:
  /// What lies in the tooth already goes on; null: nothing can be laid.
  explicit FillingHand(const Filling* filling);

  /// `pedal`: down, and the instrument may work.
  FillingWork work(Bodies& bodies, StrokeHistory& strokes, const Tool& tool,
                   const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, bool pedal,
                   const ErosionSettings& erosion, double dt_s, std::uint64_t tick) noexcept;

  /// An increment of its own.
  void lay(const LaidCone& cone) noexcept;
  bool isLayingCone() const noexcept { return cone_.isRunning(); }
  /// Its stroke was undone.
  void stopCone() noexcept { cone_.stop(); }

 private:
  double due_steps_ = 0.0;
  unsigned increment_ = 0;
  assets::Tissue material_ = assets::Tissue::unlabelled;  ///< of it
  bool ended_ = true;                                     ///< the increment: what is laid next is another
  bool worked_ = false;
  CuringLight light_;
  ConeLaying cone_;
  IncrementAges age_s_{};  ///< of those that are laid
  Hardening hardening_;
};

}  // namespace haptics
