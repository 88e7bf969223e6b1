// Words and the scale on a picture of a scan, legible on bone and on air: panoramic view, radiograph. Output pixels.
// Any one thread.
#pragma once

#include <string>

#include "app/report/drawing.h"

namespace app {

inline constexpr Ink kFilmWord = inkOf(0xe1e8eb), kFilmRim = inkOf(0x0e1012);

inline void filmLabel(const Drawing& drawing, const std::string& words, const glm::dvec2& at, Align align) {
  constexpr double kText_px = 13.0;
  for (const glm::dvec2 offset : {glm::dvec2(-1, 0), glm::dvec2(1, 0), glm::dvec2(0, -1), glm::dvec2(0, 1)})
    drawing.text(words, at + offset, kText_px, kFilmRim, align, true);
  drawing.text(words, at, kText_px, kFilmWord, align, true);
}

/// 10 mm, in the lower right corner of a picture of `size`, with its words.
inline void filmScale(const Drawing& drawing, const glm::dvec2& size, double px_per_mm, const std::string& words) {
  const glm::dvec2 from{size.x - 12.0 - 10.0 * px_per_mm, size.y - 12.0}, to = from + glm::dvec2(10.0 * px_per_mm, 0.0);
  drawing.line(from, to, 4.0, kFilmRim);
  drawing.line(from, to, 2.0, kFilmWord);
  filmLabel(drawing, words, from - glm::dvec2(8.0, 0.0), Align::right);
}

}  // namespace app
