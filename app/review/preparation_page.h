// What a report tells of a tooth preparation, in the order a prosthodontist reads: what must not happen, form of the
// walls and the margin or of the cavity, what was cut too much and too little, and the picture. Raw millimetres, no
// mark. Markup for review_page. Pure; any thread.
#pragma once

#include "app/report/html_page.h"
#include "app/review/preparation_review.h"

namespace app {

void addPreparation(HtmlPage& page, const PreparationOfSession& of);

}  // namespace app
