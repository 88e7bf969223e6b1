// Takes strokes of the drill back when asked, and sees to it that neither hand nor bone suffers by it. A stroke begins
// when the drill first meets bone and ends when it has been out of it, or not turning, for 0.3 s. At most
// kBlocksPerTick blocks come back in a tick, so the largest stroke takes 0.24 s at 1 kHz.
// The bur rests meanwhile, and until the foot has left the pedal once: what came back is not cut again by mistake. A
// tool that the returning bone meets is embedded: the servo lets its force fade and gives none until it is out, so a
// hand is never thrown. A tool elsewhere feels nothing of it. Frame P. Servo thread; no allocation, no throw. Cost:
// bone/stroke_history, and two overlaps in ticks that give back.
#pragma once

#include <cstdint>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/stroke_history.h"
#include "haptics/servo/drill_inhibit.h"
#include "haptics/tool/tool.h"

namespace haptics {

class StrokeUndo {
 public:
  static constexpr std::size_t kBlocksPerTick = 64;
  static constexpr double kPause_s = 0.3;

  explicit StrokeUndo(const CarvedBone& bone) : strokes_(bone) {}

  /// First in a tick: mm3 that come back. Each rise of the serial by one asks for a stroke; a fall asks for nothing.
  /// The tool is where the last tick held it.
  double restore(CarvedBone& bone, std::uint64_t undo_serial, const Tool& tool,
                 const calibration::Pose<calibration::Patient, calibration::Tool>& X_PQ) noexcept;

  bool isToolEmbedded() const { return embedded_; }
  /// The tool is out of the bone.
  void release() { embedded_ = false; }

  /// Whether the bur has to rest in this tick, if it is not made to by anything else. `foot`: it is on the pedal, as
  /// far as that can be believed.
  DrillInhibit inhibitFor(bool foot) noexcept;

  /// Where cutting saves what it changes.
  StrokeHistory& strokes() { return strokes_; }
  const StrokeHistory& strokes() const { return strokes_; }
  /// Last in a tick: whether the turning bur was in bone.
  void follow(bool at_work, double dt_s) noexcept;

 private:
  StrokeHistory strokes_;
  std::uint64_t last_serial_ = 0;
  std::size_t asked_ = 0;  ///< strokes still to come back
  double pause_s_ = 0.0;
  bool embedded_ = false, foot_must_leave_ = false;
};

}  // namespace haptics
