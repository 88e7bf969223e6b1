// What a report tells of a root-canal treatment, in the order an endodontist reads: what must not happen, the access,
// each canal with its sections and its axis, radiographs, the files. Markup for review_page. Pure; any thread.
#pragma once

#include <string>

#include "app/report/html_page.h"
#include "app/review/treatment_films.h"
#include "app/review/treatment_review.h"

namespace app {

/// Of a session that has canals.
struct TreatmentReview {
  TreatmentOfSession of;
  TreatmentFilms films;
};

/// `is_confirmed`: a person has confirmed the tooth; else it is grey.
void addTreatment(HtmlPage& page, const TreatmentReview& review, bool is_confirmed = true);

}  // namespace app
