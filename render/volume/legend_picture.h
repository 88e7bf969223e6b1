// The ground on which legends of a picture are drawn: a dark plate, words on it, places of a colour. sRGB 0..255, px
// from the top left. Main thread, or any one.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "render/image.h"

namespace render {

class LegendPicture {
 public:
  static const glm::vec3 kGround;

  LegendPicture(const glm::ivec2& size_px, int line_px);

  /// Nothing beside the picture.
  void blend(int x, int y, const glm::vec3& colour, float share);
  void write(const std::string& word, const glm::ivec2& corner_px);
  Image done();

 private:
  int line_px_;
  Image image_;
};

}  // namespace render
