// A recorded session as it is told of in its report: opened once, run again once, its moments drawn on the processor
// from the keyframes of that run. Of each moment the site as the surgeon has it before him, with the line that was
// read, and the bone and teeth alone from the cheek, where the bur and the canal are seen. Any one thread; the CPU time
// of the recorded steps, some tenths of a second a picture, and that of reviewOf().
#pragma once

#include <string>

#include "app/review/session_review.h"

namespace app {

/// `patient_folder`: of an imported patient, empty: not named. Throws SessionError, UsageError, LoadError.
SessionReview reviewWithPictures(const std::string& session, const std::string& patient_folder);

}  // namespace app
