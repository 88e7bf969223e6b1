// The requested procedure and what is known beforehand. Plain data; any thread.
#pragma once

#include <string>
#include <vector>

#include "calibration/fit/target_plan.h"
#include "calibration/record/rig_record.h"

namespace app {

enum class CalibrationProcedure {
  full,    ///< everything: 8 minutes
  check,   ///< 4 touches; what is not green is brought up to date with 5 more and checked again
  rezero,  ///< 5 touches, then the check
  rest,    ///< where the hand rests: 3 + 3 touches
};

struct WizardPlan {
  CalibrationProcedure procedure = CalibrationProcedure::full;
  std::string method = "jig27";  ///< of the full one: jig27, jig8, visual15, visual25
  calibration::JigPose jig;
  calibration::RigRecord record;          ///< as it is; its rig says where screen, eyes and device are nominally
  calibration::RigDevice device;          ///< as it reports itself, and what stands in its handle
  bool has_inkwell = true;                ///< false: home is where its maker says, confirmed by a press
  double settle_s = 20.0;                 ///< of the full procedure, after homing
  double region_mm3 = 0.0;                ///< of the case; 0: not known
  std::vector<glm::dvec3> rest_marks_mm;  ///< of the hand rest: the first three make its pose, three more verify it
};

}  // namespace app
