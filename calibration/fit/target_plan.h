// Where a procedure wants the tip, and how it wants the stylus held there: tilts that vary, for one orientation hides
// what the gimbal gets wrong (reference/calibration 0, 2.2 to 2.4, 4.3). Frame W, mm; directions from the tip to the
// handle. The order is the order of touching: short ways, neighbouring tilts unlike. Plain values; any thread.
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

/// How a stylus is held without thinking of it: towards the surgeon, 10 degrees upright. Tilts are away from this.
inline constexpr Vector<World> kRestingStylus_W{{0.0, 0.17364817766693033, 0.984807753012208}};

/// What the targets are.
enum class TargetKind { pit, cross, webcam_place };

struct TargetPlan {
  std::string method;  ///< "jig27"
  TargetKind kind = TargetKind::pit;
  TouchPrecision precision;
  std::vector<Target> targets;
  bool one_pit = false;  ///< all targets are the same place, held in many ways: it can not be moved
};

/// The block with pits: 3 x 3 x 3 of 130 x 90 x 65 mm, frame B in its middle; the verification pits lie between them.
struct JigPose {
  Pose<World, Board> X_WB;
};

/// "jig27", "jig8", "visual15", "visual25", "webcam27" (places for each camera position), "rezero5", "check4",
/// "verify8" (8 places not in any fit, two new tilts each: 16 touches), "pivot12" (one pit, twelve tilts). None for
/// another name.
std::optional<TargetPlan> targetPlan(std::string_view method, const JigPose& jig = {});

/// A turn of the handle about H's axes that holds the stylus in this direction; the roll as little as may be.
Pose<World, Handle> handleHolding(const Target& target, const glm::dvec3& tip_H_mm);

}  // namespace calibration
