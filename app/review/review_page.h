// One recorded rehearsal as one HTML page, in the order a supervisor reads (reference/product 3.5): the case, the four
// errors, how near, what was removed, the hand's work, the course, the conditions. No other file, no script; readable
// in print and without colour. No name of a person, no path. With a second session its measures stand beside, with
// earlier runs their trend. Pure; any thread.
#pragma once

#include <string>

#include "app/review/reference_set.h"
#include "app/review/session_review.h"
#include "app/review/session_trend.h"

namespace app {

/// What the rehearsal is held against; each may be null.
struct HeldAgainst {
  const SessionMetrics* other = nullptr;    ///< another of the same case
  const ReferenceSet* reference = nullptr;  ///< of that case
  const CaseTrend* trend = nullptr;         ///< runs of that case
};
std::string reviewHtml(const SessionReview& review, const HeldAgainst& against = {});

}  // namespace app
