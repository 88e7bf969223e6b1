// Enlarges an eye's image that was drawn at a half or a third of the resolution: bilinearly, and at edges by a kernel
// that is long along the edge and narrow across it, so that silhouettes are lines and not steps. The direction is that
// of the structure tensor (Bigün and Granlund 1987, ICCV 1:433) of the square root of the luminance, which is about
// even to the eye. Weights are positive: nothing rings, no colour beyond its neighbours appears. Evenly, or in the
// OpenGL back-end, bilinearly alone. Any thread, rows in parallel in the caller's arena; about 20 ns a pixel, evenly 2.
#pragma once

#include <vector>

#include "render/cpu/eye_image.h"

namespace render {

class Enlarger {
 public:
  enum class Edges { smooth, even };
  /// Colours only; `to` keeps its own memory from frame to frame.
  void enlarge(const EyeImage& from, glm::ivec2 px, EyeImage& to, Edges edges = Edges::smooth);

 private:
  void findEdges(const EyeImage& from);

  /// Of the small image: products of the gradient, as they are and blurred; how much of an edge a pixel is, 0..1.
  struct Tensor {
    std::vector<float> xx, xy, yy;
    void resize(std::size_t count) {
      for (std::vector<float>* plane : {&xx, &xy, &yy}) plane->resize(count);
    }
  };
  std::vector<float> brightness_, edge_;
  Tensor sharp_, tensor_;
};

}  // namespace render
