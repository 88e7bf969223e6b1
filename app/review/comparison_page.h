// Two recorded rehearsals of one case as one HTML page: events, the bone that only one of them took with pictures of
// both results, steps over one axis of time, each measure with its difference. No other file, no script, no name of a
// person, no path. For `molar compare --out`.
#pragma once

#include <string>
#include <vector>

#include "app/review/bone_pictures.h"
#include "app/review/session_comparison.h"

namespace app {

/// The same views of both.
struct ComparisonPictures {
  std::vector<BonePicture> a, b;
};
/// Bone that this one alone cut is red, bone that the other alone cut is blue. Any thread; a second a picture.
ComparisonPictures comparisonPictures(const ComparedEnds& ends);

/// Pure; any thread.
std::string comparisonHtml(const SessionComparison& comparison, const ComparisonPictures& pictures);

}  // namespace app
