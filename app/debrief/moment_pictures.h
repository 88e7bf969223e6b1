// Moments of a recorded session as pictures for its report: the site from the usual place before the patient, with the
// line that was read, and the jaw alone from aside, where the bur and the canal are seen. Drawn on the processor while
// the session is run again once; no picture is drawn where no moment is told. Any one thread; the CPU time of the
// recorded steps, and some tenths of a second a picture.
#pragma once

#include <string>
#include <vector>

#include "app/review/session_review.h"

namespace app {

/// `moments` in order of time. `patient_folder`: of an imported patient, empty: not named. Throws SessionError,
/// UsageError, LoadError.
RunAgain momentPictures(const std::string& session, const std::string& patient_folder,
                        const std::vector<ToldMoment>& moments);

}  // namespace app
