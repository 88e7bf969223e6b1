// The ruler between two touches: where it is marked on the patient, and what is said of it. Its line is part of the
// frame, so that pictures, slices and recordings show the same. Frame P, mm. Pure; main thread.
#pragma once

#include <optional>
#include <string>

#include "haptics/tool/bur_shape.h"
#include "render/frame.h"

namespace app {

/// The point that the bur of `frame` marks: of tooth or bone nearest to it, also while it touches; farther than
/// render::kMaxGap_mm, or where no gap is known, the middle of the bur's tip.
calibration::Point<calibration::Patient> markedPoint(const render::Frame& frame, const haptics::BurShape& head);

/// The first mark, the second, then none.
std::optional<render::RulerLine> rulerAfterMark(const std::optional<render::RulerLine>& ruler,
                                                const calibration::Point<calibration::Patient>& point_P);

/// For the line in the picture: "ruler 7.3 mm", "ruler: 2nd point"; empty without a ruler.
std::string rulerText(const std::optional<render::RulerLine>& ruler);

/// For the recording: "7.30 mm from (-28.10, 49.00, 2.50) to (…) mm", frame P; "cleared".
std::string rulerEvent(const std::optional<render::RulerLine>& ruler);

}  // namespace app
