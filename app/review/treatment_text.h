// A root-canal treatment for programs and for a terminal: JSON, a table, and the picture of its sections. Pure; any
// thread.
#pragma once

#include <string>

#include "app/review/treatment_review.h"
#include "render/image.h"

namespace app {

std::string treatmentJson(const TreatmentOfSession& of);
/// For people, with its first line.
std::string treatmentTable(const TreatmentOfSession& of);
/// Sections of every canal at 1, 3, 5 and 7 mm, before and after.
render::Image treatmentSections(const TreatmentOfSession& of);

}  // namespace app
