// What a recorded root-canal treatment has come to, read from its session: as JSON and as a table for people. Any one
// thread; a second or two. Throws SessionError.
#pragma once

#include <optional>
#include <string>

#include "app/procedure/root_canal/treatment.h"
#include "assets/tooth_canals.h"
#include "render/image.h"

namespace app {

struct TreatmentOfSession {
  assets::ToothCanals tooth;
  Treatment treatment;
};

/// None: the session is of another operation, or its bone at the end is not known.
std::optional<TreatmentOfSession> treatmentOfSession(const std::string& path);

std::string treatmentJson(const TreatmentOfSession& of);
/// For people, with its first line.
std::string treatmentTable(const TreatmentOfSession& of);
/// Sections of every canal at 1, 3, 5 and 7 mm, before and after.
render::Image treatmentSections(const TreatmentOfSession& of);

}  // namespace app
