// All that is told of one recorded rehearsal: measures, course, the case, what was removed against the plan, pictures.
// Gathered once, told by review_page. The patient of a built-in case is made again; that of an imported one is named.
// Any one thread; some seconds: the bone's end is replayed to know which pieces of tooth are out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/case/extraction_plan.h"
#include "app/review/bone_pictures.h"
#include "app/review/session_course.h"
#include "app/session/measures/plan_comparison.h"
#include "app/session/metrics.h"

namespace app {

struct SessionReview {
  SessionMetrics metrics;
  SessionCourse course;
  std::string started_utc;                     ///< empty: not recorded
  std::string law;                             ///< of force, at the end
  std::optional<ExtractionPlan> plan;          ///< none: why_no_plan
  std::optional<PlanComparison> against_plan;  ///< none: no plan is known
  std::string why_no_plan;
  std::vector<BonePicture> pictures;
};

/// `patient_folder` empty: the built-in patient of the session, or none. Throws SessionError; UsageError where the
/// folder is of another patient.
SessionReview reviewOf(const std::string& path, const std::string& patient_folder);

}  // namespace app
