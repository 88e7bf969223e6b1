// All that is told of one recorded rehearsal: measures, course, the case, what was removed against the plan, pictures.
// Gathered once, told by review_page. The patient of a built-in case is made again; that of an imported one is named.
// Any one thread; some seconds, and the time of a replay: what is left in the mouth, and the pictures of moments, are
// of the session run again.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/case/extraction_plan.h"
#include "app/review/bone_pictures.h"
#include "app/review/session_course.h"
#include "app/review/told_moments.h"
#include "app/session/metrics.h"

namespace app {

struct SessionReview {
  SessionMetrics metrics;
  SessionCourse course;
  std::string started_utc;             ///< empty: not recorded
  std::string law;                     ///< of force, at the end
  std::optional<ExtractionPlan> plan;  ///< none: why_no_plan
  std::string why_no_plan;
  bool is_against_plan = false;  ///< pictures are coloured by it
  std::vector<BonePicture> pictures;
  std::vector<MomentPicture> moments;  ///< in order of time
  std::vector<std::string> remarks;    ///< on the pictures
};

/// What a session leaves when it is run again: these moments as pictures, and the solid fraction without what was taken
/// out of the mouth, in the order of its grid.
struct RunAgain {
  std::vector<MomentPicture> moments;
  std::vector<std::string> remarks;  ///< for people: what is not as it was
  std::vector<std::uint8_t> in_mouth;
};
using RunsAgain = std::function<RunAgain(const std::vector<ToldMoment>&)>;

/// `patient_folder` empty: the built-in patient of the session, or none. Throws SessionError; UsageError where the
/// folder is of another patient.
SessionReview reviewOf(const std::string& path, const std::string& patient_folder, const RunsAgain& runs_again);

}  // namespace app
