// All that is told of one recorded rehearsal: measures, course, the case, what was removed against the plan, pictures.
// Gathered once, told by review_page; what comes of the session run again (app/debrief/moment_pictures) is given. Any
// one thread; some seconds, and the drawing of the moments.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/case/extraction_plan.h"
#include "app/review/bone_pictures.h"
#include "app/review/preparation_review.h"
#include "app/review/session_course.h"
#include "app/review/told_moments.h"
#include "app/review/treatment_page.h"
#include "app/session/metrics.h"
#include "assets/patient.h"

namespace app {

struct SessionReview {
  SessionMetrics metrics;
  SessionCourse course;
  std::string started_utc;             ///< empty: not recorded
  std::string law;                     ///< of force, at the end
  std::optional<ExtractionPlan> plan;  ///< none: why_no_plan
  std::string why_no_plan;
  bool is_against_plan = false;  ///< pictures are coloured by it
  bool has_canal = false;
  std::vector<BonePicture> pictures;
  std::vector<MomentPicture> moments;               ///< in order of time
  std::vector<std::string> remarks;                 ///< for people: what is not as it was when it was run again
  std::optional<TreatmentReview> treatment;         ///< of root canals; none: another operation
  std::optional<PreparationOfSession> preparation;  ///< of a tooth; none: another operation
};
/// Its outcomes are those of a tooth that stays.
inline bool isOfOneTooth(const SessionReview& review) { return review.treatment || review.preparation; }

/// A session run again once to its end, for its report.
struct RunAgain {
  const StoredStart& start;
  const assets::Patient* patient = nullptr;  ///< as scanned; null: not known
  const assets::RiskStructures& risks;
  BoneLeft left;
  std::vector<std::string> remarks;
  std::function<std::vector<MomentPicture>(const std::vector<ToldMoment>&)> draw;
  std::string patient_folder = {};  ///< of an imported patient; empty: not named
};

/// Throws SessionError.
SessionReview reviewOf(const std::string& path, const RunAgain& again);

}  // namespace app
