// Figures of a root-canal treatment's report as markup: sections of a canal, its axis before and after, radiographs.
// Pure; any thread.
#pragma once

#include <string>

#include "app/review/treatment_films.h"
#include "app/review/treatment_review.h"

namespace app {

/// Of one canal at 1, 3, 5 and 7 mm: the root above, below the canal four times as large.
std::string sectionsFigure(const TreatedCanal& canal);
/// Of one canal, from the cheek and from mesial: its wall as it is left, its axis before and after.
std::string axisFigure(const assets::ToothCanals& tooth, std::size_t number, const CanalOutcomes& outcomes);
/// A pair side by side.
std::string filmsFigure(const FilmPair& films);

}  // namespace app
