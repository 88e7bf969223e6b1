// Words on CT slices and legends, by Pango in DejaVu Sans: coverage of the pixels. Main thread, or any one. A word that
// was written before is kept (64 of them); a new one takes 0.1 ms.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace render {

/// A line of text with a rim one pixel wide around its letters, by which it is legible on any ground.
struct WordPixels {
  glm::ivec2 size_px{0};
  std::vector<std::uint8_t> letters, rim;  ///< 255: covered; rows from the top
};

/// `line_px`: height of the line, 1.17 times the size of the font.
const WordPixels& wordPixels(const std::string& text, int line_px);

/// Calls blend(x, y, is_rim, share 0..1) for every pixel of a word whose top left is at a place, the rim first.
template <class Blend>
void forWordPixels(const WordPixels& word, const glm::ivec2& corner_px, const Blend& blend) {
  for (const bool is_rim : {true, false}) {
    const std::uint8_t* cover = (is_rim ? word.rim : word.letters).data();
    for (int y = 0; y < word.size_px.y; ++y)
      for (int x = 0; x < word.size_px.x; ++x, ++cover)
        if (*cover != 0) blend(corner_px.x + x, corner_px.y + y, is_rim, static_cast<float>(*cover) / 255.0f);
  }
}

}  // namespace render
