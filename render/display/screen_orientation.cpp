#include "render/display/screen_orientation.h"

#include <cmath>
#include <cstring>

#include "render/display/eye_projection.h"

namespace render {

ScreenOrientation screenOrientation(const calibration::Rig& rig) {
  const EyeView view = eyeView(rig, Eye::cyclopean);
  const glm::dvec3 column = view.right_edge_W.xyz, row = -view.up_edge_W.xyz;  // directions of rising x and y
  const glm::dvec3 middle = view.lower_left_W.mm + 0.5 * (column - row);
  const glm::dvec3 eyes = rig.right_eye.mm - rig.left_eye.mm;
  ScreenOrientation orientation;
  orientation.transposed =
      std::abs(glm::dot(glm::normalize(column), eyes)) < std::abs(glm::dot(glm::normalize(row), eyes));
  const glm::dvec3 along = orientation.transposed ? row : column, across = orientation.transposed ? column : row;
  const bool flip_along = glm::dot(along, eyes) < 0.0;
  glm::dvec3 to_viewer = glm::cross(column, row);
  if (glm::dot(to_viewer, rig.cyclopeanEye().mm - middle) < 0.0) to_viewer = -to_viewer;
  const glm::dvec3 down = glm::cross(flip_along ? -along : along, to_viewer);
  const bool flip_across = glm::dot(across, down) < 0.0;
  orientation.flip_x = orientation.transposed ? flip_across : flip_along;
  orientation.flip_y = orientation.transposed ? flip_along : flip_across;
  return orientation;
}

Image turned(const Image& upright, const ScreenOrientation& orientation) {
  if (orientation == ScreenOrientation{}) return upright;
  const glm::ivec2 size = orientation.viewerSize({upright.w, upright.h});
  Image result{size.x, size.y, {}};
  result.rgba.resize(upright.rgba.size());
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const glm::ivec2 from(orientation.flip_x ? size.x - 1 - x : x, orientation.flip_y ? size.y - 1 - y : y);
      const int pixel = orientation.transposed ? from.x * upright.w + from.y : from.y * upright.w + from.x;
      std::memcpy(&result.rgba[4 * static_cast<std::size_t>(y * size.x + x)],
                  &upright.rgba[4 * static_cast<std::size_t>(pixel)], 4);
    }
  return result;
}

}  // namespace render
