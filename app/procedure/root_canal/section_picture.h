// Sections of canals as a picture for people: a row a canal, a panel for each of 1, 3, 5 and 7 mm from the foramen; the
// root, the canal as it was (blue, dashed) and as it is (orange), what was laid (rose), the furcation to the right. Any
// one thread; some milliseconds.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/procedure/root_canal/canal_outcomes.h"
#include "app/report/drawing.h"
#include "render/image.h"

namespace app {

struct CanalRow {
  std::string name;
  std::span<const CanalSection> sections;
};

render::Image sectionPicture(const std::vector<CanalRow>& canals);

/// One section in a square panel of a figure, as far as `half_mm` to every side; lines of this width and 0.8 of it.
void drawSection(const Drawing& drawing, const CanalSection& section, const glm::dvec2& corner, double edge,
                 double half_mm, double line);
/// The least dentine around the canal in this section; infinity where no surface is within reach.
double leastDentine_mm(const CanalSection& section);
/// "moved 0.12 mm to the furcation"; empty below 0.005 mm.
std::string movedWords(const CanalSection& section);

}  // namespace app
