// Undoes and redoes strokes of the drill (stroke_extent.h) and of what moves pieces (luxation_strokes.h) on request
// without harm to hand or bone. At most kBlocksPerTick blocks change in a tick, or one stroke of the latter. The bur
// does not turn meanwhile, and not until the pedal has been released once, so that restored bone is not cut by mistake.
// A tool that meets restored bone, or a piece put back, is embedded: the servo fades its force and gives none until it
// is out. Frame P. Servo thread; no allocation, no throw. Cost: bone/stroke_history, and two overlaps in ticks that
// undo or redo.
#pragma once

#include <cstdint>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/body/bodies.h"
#include "haptics/bone/stroke_history.h"
#include "haptics/servo/drill_inhibit.h"
#include "haptics/servo/luxation_strokes.h"
#include "haptics/servo/stroke_extent.h"
#include "haptics/tool/tool.h"

namespace haptics {

/// What the tool is held off by: beaks go round a tooth, between them is room for it; an applicator goes through what
/// has not set, as it would be pushed out by what it lays.
SolidBodies metBy(const Tool& tool, const Bodies& bodies);

class StrokeUndo {
 public:
  static constexpr std::size_t kBlocksPerTick = 64;

  explicit StrokeUndo(const Bodies& bodies)
      : strokes_(bodies.bones(), StrokeHistory::kMaxBlocks, bodies.filling()), luxations_(bodies) {}

  /// Each rise of a serial by one requests a stroke to undo or redo; a fall is ignored. Requests of both kinds in one
  /// tick cancel out.
  struct Serials {
    std::uint64_t undo = 0, redo = 0;
  };
  /// First in a tick. Returns the mm3 restored, below 0 when redoing. `at_X_PT`: the tool at the proxy of the last
  /// tick.
  double restore(Bodies& bodies, PieceSites& sites, const Serials& serials, const Tool& tool,
                 const calibration::Pose<calibration::Patient, calibration::Tool>& at_X_PT) noexcept;

  bool isToolEmbedded() const { return embedded_; }
  /// The tool is out of the bone.
  void release() { embedded_ = false; }

  /// Whether the bur must not turn in this tick. `pedal`: it is down, or its state is not known.
  DrillInhibit inhibitFor(bool pedal) noexcept;

  StrokeHistory& strokes() { return strokes_; }
  LuxationStrokes& luxations() { return luxations_; }
  const StrokeHistory& strokes() const { return strokes_; }
  /// Restored since the start by undo, less what was redone, mm3.
  double restoredTotal_mm3() const { return restored_total_mm3_; }
  /// Requests that come while nothing can be undone.
  void ignore(const Serials& serials) noexcept { last_ = serials; }
  /// restore() undid or redid something in this tick,
  bool hasChanged() const { return changed_; }
  /// pieces among it.
  bool hasMovedPieces() const { return moved_pieces_; }
  /// A stroke of an instrument that takes hold of `piece`; before it or another moves.
  void beginLuxation(const Bodies& bodies, PieceSites& sites, std::size_t piece) noexcept;
  /// The pieces have settled, or something else begins.
  void endLuxation(const Bodies& bodies, PieceSites& sites) noexcept { luxations_.end(bodies, sites); }
  bool isLuxating() const { return luxations_.isOpen(); }
  /// As LuxationStrokes::newestOf().
  const PieceMemory* leftByLuxation(std::size_t piece) const noexcept { return luxations_.newestOf(strokes_, piece); }
  /// The newest stroke was changed by something else than the bur.
  void keepStrokes() { target_ = strokes_.strokes(); }
  bool isRunning() const { return target_ != strokes_.strokes() || strokes_.isBetweenStrokes(); }
  /// Last in a tick. `cutting`: the turning bur was in bone, at `bur_P`. `may_end`: no split adds to the stroke.
  void update(bool cutting, const calibration::Point<calibration::Patient>& bur_P, double removed_mm3, bool may_end,
              double dt_s) noexcept;

 private:
  StrokeHistory::Restored restoreSome(Bodies& bodies, PieceSites& sites, std::size_t most_blocks) noexcept;

  StrokeHistory strokes_;
  LuxationStrokes luxations_;
  StrokeExtent extent_;
  Serials last_;
  std::size_t target_ = 0;  ///< strokes that shall be left
  double restored_total_mm3_ = 0.0;
  bool embedded_ = false, pedal_must_be_released_ = false, changed_ = false, moved_pieces_ = false;
};

}  // namespace haptics
