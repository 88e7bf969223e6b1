#include "haptics/servo/stroke_undo.h"

#include <algorithm>

#include "haptics/contact/overlap.h"
#include "haptics/contact/shaft_contact.h"
#include "haptics/contact/shape_overlap.h"

namespace haptics {
namespace {

/// Overlap of head and shaft with the bone.
double shared_mm3(const SolidField& field, const Tool& tool,
                  const calibration::Pose<calibration::Patient, calibration::Tool>& X_PQ) {
  const TissueStiffness tissue;
  const double by_head_mm3 = tool.head.kind == ShapeKind::sphere
                                 ? sphereOverlap(field, {X_PQ.translation_mm}, tool.head.radius_mm).volume_mm3
                                 : shapeOverlap(field, tool.head, X_PQ, tissue).volume_mm3;
  return by_head_mm3 + shaftContact(field, tool, X_PQ, tissue, 1.0).volume_mm3;
}

}  // namespace

double StrokeUndo::restore(CarvedBone& bone, std::uint64_t undo_serial, const Tool& tool,
                           const calibration::Pose<calibration::Patient, calibration::Tool>& X_PQ) noexcept {
  // Limited to the strokes there are: surplus requests are dropped.
  const std::uint64_t more = undo_serial > last_serial_ ? undo_serial - last_serial_ : 0;
  last_serial_ = undo_serial;
  requested_ =
      std::min(strokes_.strokes(),
               requested_ + static_cast<std::size_t>(std::min<std::uint64_t>(more, StrokeHistory::kMaxStrokes)));
  if (requested_ == 0) return 0.0;

  pedal_must_be_released_ = true;
  const double shared_before_mm3 = shared_mm3(bone.field(), tool, X_PQ);
  double volume_mm3 = 0.0;
  for (std::size_t left = kBlocksPerTick; left > 0 && requested_ > 0;) {
    const std::size_t strokes = strokes_.strokes();
    const StrokeHistory::Restored restored = strokes_.restore(bone, left);
    volume_mm3 += restored.volume_mm3;
    left -= restored.blocks;
    if (strokes_.strokes() < strokes) --requested_;
  }
  embedded_ = embedded_ || shared_mm3(bone.field(), tool, X_PQ) > shared_before_mm3;
  return volume_mm3;
}

DrillInhibit StrokeUndo::inhibitFor(bool pedal) noexcept {
  // Pressing while embedded does not count.
  pedal_must_be_released_ = pedal && (pedal_must_be_released_ || embedded_ || requested_ > 0);
  return requested_ > 0            ? DrillInhibit::undo_running
         : embedded_               ? DrillInhibit::tool_embedded
         : pedal_must_be_released_ ? DrillInhibit::pedal_held
                                   : DrillInhibit::none;
}

void StrokeUndo::update(bool cutting, double dt_s) noexcept {
  pause_s_ = cutting ? 0.0 : pause_s_ + dt_s;
  if (pause_s_ > kPause_s - 0.5 * dt_s) strokes_.endStroke();
}

}  // namespace haptics
