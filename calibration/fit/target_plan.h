// Target plans of the procedures: positions of the tip and tilts of the stylus, varied because one orientation hides
// gimbal errors (reference/calibration 0, 2.2 to 2.4, 4.3). Frame W, mm; directions from the tip to the handle. In
// touching order: short ways, differing neighbouring tilts. Plain values; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/fit/touches.h"

namespace calibration {

struct Target {
  int id = 0;
  Point<World> position_W;
  Vector<World> stylus_W;  ///< unit
};

/// The natural stylus direction: towards the surgeon, 10 degrees upward. Tilts are relative to it.
inline constexpr Vector<World> kRestingStylus_W{{0.0, 0.17364817766693033, 0.984807753012208}};

enum class TargetKind { pit, cross, webcam_place };

struct TargetPlan {
  std::string method;  ///< "jig27"
  TargetKind kind = TargetKind::pit;
  TouchPrecision precision;
  std::vector<Target> targets;
  bool one_pit = false;  ///< all targets are one pit that cannot be moved
};

/// The block with pits: 3 x 3 x 3 over 130 x 90 x 65 mm, frame B at its centre; verification pits between them.
struct JigPose {
  Pose<World, Board> X_WB;
};

/// "jig27", "jig8", "visual15", "visual25", "webcam27" (positions for each camera position), "rezero5", "check4",
/// "verify8" (8 positions not in any fit, two new tilts each: 16 touches), "pivot12" (one pit, twelve tilts). None:
/// another name.
std::optional<TargetPlan> targetPlan(std::string_view method, const JigPose& jig = {});

/// Pose of the handle with its tip at the target and its axis in this direction, with the least roll.
Pose<World, Handle> handleHolding(const Target& target, const glm::dvec3& tip_H_mm);

}  // namespace calibration
