// Undoes strokes of the drill on request without harm to hand or bone. A stroke begins when the drill first meets bone
// and ends when it has been out of it, or not turning, for 0.3 s. At most kBlocksPerTick blocks are restored in a tick,
// so the largest stroke takes 0.24 s at 1 kHz. The bur does not turn meanwhile, and not until the pedal has been
// released once, so that restored bone is not cut by mistake. A tool that meets restored bone is embedded: the servo
// fades its force and gives none until it is out. Frame P. Servo thread; no allocation, no throw. Cost:
// bone/stroke_history, and two overlaps in ticks that restore.
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

  /// First in a tick. Returns the mm3 restored. Each rise of the serial by one requests a stroke; a fall is ignored.
  /// `X_PQ`: the tool at the proxy of the last tick.
  double restore(CarvedBone& bone, std::uint64_t undo_serial, const Tool& tool,
                 const calibration::Pose<calibration::Patient, calibration::Tool>& X_PQ) noexcept;

  bool isToolEmbedded() const { return embedded_; }
  /// The tool is out of the bone.
  void release() { embedded_ = false; }

  /// Whether the bur must not turn in this tick. `pedal`: it is down, or its state is not known.
  DrillInhibit inhibitFor(bool pedal) noexcept;

  StrokeHistory& strokes() { return strokes_; }
  const StrokeHistory& strokes() const { return strokes_; }
  /// Last in a tick. `cutting`: the turning bur was in bone.
  void update(bool cutting, double dt_s) noexcept;

 private:
  StrokeHistory strokes_;
  std::uint64_t last_serial_ = 0;
  std::size_t requested_ = 0;  ///< strokes still to be restored
  double pause_s_ = 0.0;
  bool embedded_ = false, pedal_must_be_released_ = false;
};

}  // namespace haptics
