// Sections of canals as a picture for people: a row a canal, a panel for each of 1, 3, 5 and 7 mm from the foramen; the
// root, the canal as it was (blue, dashed) and as it is (orange), the furcation to the right. Any one thread; some
// milliseconds.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/procedure/root_canal/canal_outcomes.h"
#include "render/image.h"

namespace app {

struct CanalRow {
  std::string name;
  std::span<const CanalSection> sections;
};

render::Image sectionPicture(const std::vector<CanalRow>& canals);

}  // namespace app
