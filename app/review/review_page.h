// One recorded rehearsal as one HTML page, in the order a supervisor reads (reference/product 3.5): the case, the four
// errors, how near, what was removed, the hand's work, the course, the conditions. No other file, no script; readable
// in print and without colour. No name of a person, no path. With a second session its measures stand beside. Pure; any
// thread.
#pragma once

#include <string>

#include "app/review/reference_set.h"
#include "app/review/session_review.h"

namespace app {

/// `other`: of a rehearsal of the same case, or null. `reference`: a set of that case, or null.
std::string reviewHtml(const SessionReview& review, const SessionMetrics* other,
                       const ReferenceSet* reference = nullptr);

}  // namespace app
