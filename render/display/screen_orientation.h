// How the viewer sees the rows and columns of the framebuffer image: the panel may stand upside down, on its side, or
// behind a mirror. Turns upright pictures into what the panel must show. "Viewer's pixels" count from the top left of
// the (virtual) screen as the viewer sees it, "image pixels" from the top left of the framebuffer image. Pure; any
// thread.
#pragma once

#include "calibration/rig.h"
#include "render/image.h"

namespace render {

struct PixelBox {
  glm::ivec2 corner_px{0}, size_px{0};
  friend constexpr bool operator==(const PixelBox&, const PixelBox&) = default;
};

struct ScreenOrientation {
  bool transposed = false;              ///< rows of the image are columns for the viewer
  bool flip_x = false, flip_y = false;  ///< the image's x or y runs against the viewer's direction along it

  constexpr glm::ivec2 viewerSize(glm::ivec2 image_px) const {
    return transposed ? glm::ivec2(image_px.y, image_px.x) : image_px;
  }
  /// A box in viewer's pixels, in the pixels of an image of this size.
  constexpr PixelBox imageBox(const PixelBox& seen, glm::ivec2 image_px) const {
    PixelBox box = seen;
    if (transposed) box = {{seen.corner_px.y, seen.corner_px.x}, {seen.size_px.y, seen.size_px.x}};
    if (flip_x) box.corner_px.x = image_px.x - box.corner_px.x - box.size_px.x;
    if (flip_y) box.corner_px.y = image_px.y - box.corner_px.y - box.size_px.y;
    return box;
  }
  /// The inverse of imageBox.
  constexpr PixelBox seenBox(PixelBox box, glm::ivec2 image_px) const {
    if (flip_x) box.corner_px.x = image_px.x - box.corner_px.x - box.size_px.x;
    if (flip_y) box.corner_px.y = image_px.y - box.corner_px.y - box.size_px.y;
    if (!transposed) return box;
    return {{box.corner_px.y, box.corner_px.x}, {box.size_px.y, box.size_px.x}};
  }
  friend constexpr bool operator==(const ScreenOrientation&, const ScreenOrientation&) = default;
};

/// The viewer's right is the direction from the left to the right eye.
ScreenOrientation screenOrientation(const calibration::Rig& rig);

/// An upright picture as the panel has to show it.
Image turned(const Image& upright, const ScreenOrientation& orientation);

}  // namespace render
