#include "haptics/servo/stroke_undo.h"

#include <algorithm>

#include "haptics/contact/overlap.h"
#include "haptics/contact/shaft_contact.h"
#include "haptics/contact/shape_overlap.h"

namespace haptics {
namespace {

/// Overlap of head and shaft with solid.
double shared_mm3(const SolidBodies& bodies, const Tool& tool,
                  const calibration::Pose<calibration::Patient, calibration::Tool>& at_X_PT) {
  const TissueStiffness tissue;
  const double by_head_mm3 = tool.head.kind == ShapeKind::sphere
                                 ? sphereOverlap(bodies, {at_X_PT.translation_mm}, tool.head.radius_mm).volume_mm3
                                 : shapeOverlap(bodies, tool.head, at_X_PT, tissue).volume_mm3;
  return by_head_mm3 + shaftContact(bodies, tool, at_X_PT, tissue, 1.0).volume_mm3;
}

}  // namespace

SolidBodies metBy(const Tool& tool, const Bodies& bodies) {
  if (tool.grips) return SolidBodies(bodies.jaw().field());
  return isApplicator(tool.hand_instrument) ? bodies.viewOfSet() : bodies.view();
}

/// Of the newest stroke, or of the one to redo. A stroke that moved pieces is the last of a tick: of one that was split
/// after, the blocks come back before the poses, and go after them.
StrokeHistory::Restored StrokeUndo::restoreSome(Bodies& bodies, PieceSites& sites, std::size_t most_blocks) noexcept {
  const std::size_t count = strokes_.strokes();
  StrokeHistory::Restored restored;
  if (target_ < count) {
    const std::size_t place = strokes_.place(count - 1);
    const bool is_marked = strokes_.isMarked(count - 1);
    restored = strokes_.undo(bodies.bones(), most_blocks, bodies.filling());
    if (!is_marked || strokes_.strokes() == count) return restored;
    luxations_.undo(place, bodies, sites);
  } else {
    const bool is_marked = !strokes_.isBetweenStrokes() && strokes_.isMarked(count);
    if (is_marked) luxations_.redo(strokes_.place(count), bodies, sites);
    restored = strokes_.redo(bodies.bones(), most_blocks, bodies.filling());
    if (!is_marked) return restored;
  }
  moved_pieces_ = true;
  restored.blocks = most_blocks;
  return restored;
}

double StrokeUndo::restore(Bodies& bodies, PieceSites& sites, const Serials& serials, const Tool& tool,
                           const calibration::Pose<calibration::Patient, calibration::Tool>& at_X_PT) noexcept {
  // Limited to the strokes there are: surplus requests are dropped.
  constexpr std::uint64_t kMost = StrokeHistory::kMaxStrokes;
  const std::uint64_t undos = serials.undo > last_.undo ? std::min(serials.undo - last_.undo, kMost) : 0;
  const std::uint64_t redos = serials.redo > last_.redo ? std::min(serials.redo - last_.redo, kMost) : 0;
  last_ = serials;
  const std::size_t there_are = strokes_.strokes() + strokes_.undoneStrokes();
  target_ = std::min(there_are, target_ + redos - std::min<std::uint64_t>(target_ + redos, undos));
  changed_ = isRunning();
  if (!changed_) return 0.0;

  luxations_.end(bodies, sites);
  pedal_must_be_released_ = true;
  const double shared_before_mm3 = shared_mm3(metBy(tool, bodies), tool, at_X_PT);
  double volume_mm3 = 0.0;
  for (std::size_t left = kBlocksPerTick; left > 0 && isRunning();) {
    const StrokeHistory::Restored restored = restoreSome(bodies, sites, left);
    volume_mm3 += restored.volume_mm3;
    left -= restored.blocks;
  }
  embedded_ = embedded_ || shared_mm3(metBy(tool, bodies), tool, at_X_PT) > shared_before_mm3;
  restored_total_mm3_ += volume_mm3;
  return volume_mm3;
}

void StrokeUndo::beginLuxation(const Bodies& bodies, PieceSites& sites, std::size_t piece) noexcept {
  luxations_.begin(strokes_, bodies, sites, piece);
  target_ = strokes_.strokes();
}

DrillInhibit StrokeUndo::inhibitFor(bool pedal) noexcept {
  // Pressing while embedded does not count.
  pedal_must_be_released_ = pedal && (pedal_must_be_released_ || embedded_ || isRunning());
  return isRunning()               ? DrillInhibit::undo_running
         : embedded_               ? DrillInhibit::tool_embedded
         : pedal_must_be_released_ ? DrillInhibit::pedal_held
                                   : DrillInhibit::none;
}

void StrokeUndo::update(bool cutting, const calibration::Point<calibration::Patient>& bur_P, double removed_mm3,
                        bool may_end, double dt_s) noexcept {
  if (extent_.endsAt(cutting, bur_P, removed_mm3, dt_s) && may_end) strokes_.endStroke();
  changed_ = moved_pieces_ = false;
  // A running undo keeps its target; cutting moves it.
  if (cutting) target_ = strokes_.strokes();
}

}  // namespace haptics
