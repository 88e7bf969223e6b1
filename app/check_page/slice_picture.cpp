#include "app/check_page/slice_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace app {
namespace {

constexpr double kOutline = 0.9;

bool isOtherTooth(std::uint8_t a, std::uint8_t b) {
  return a != b && ((a != 0 && a != kBoneVoxel) || (b != 0 && b != kBoneVoxel));
}

/// Places of pixels in voxels.
struct PixelPlaces {
  PixelPlaces(const assets::VolumeGrid& grid, const JawViews::Plane& plane)
      : first(grid.indexFromPoint(plane.at({0.5, 0.5}))),
        right(plane.pixel_mm / grid.spacing_mm * plane.right_P),
        down(plane.pixel_mm / grid.spacing_mm * plane.down_P) {}
  glm::vec3 at(int x, int y) const { return first + static_cast<float>(x) * right + static_cast<float>(y) * down; }

  glm::vec3 first, right, down;
};

int below(float v) { return static_cast<int>(std::floor(v)); }

/// Between eight voxels; air beyond the scan.
class GreySampler {
 public:
  explicit GreySampler(const assets::CtVolume& ct)
      : hounsfield_(ct.hounsfield.data()), size_(ct.grid.size), row_(size_.x), layer_(row_ * size_.y) {}

  float at(const glm::vec3& p) const {
    const int i = below(p.x), j = below(p.y), k = below(p.z);
    const bool is_in = i >= 0 && j >= 0 && k >= 0 && i + 1 < size_.x && j + 1 < size_.y && k + 1 < size_.z;
    if (!is_in) return -1000.0F;
    const std::int16_t* const v = hounsfield_ + (i + row_ * j + layer_ * k);
    const float u = p.x - static_cast<float>(i), w = p.y - static_cast<float>(j), t = p.z - static_cast<float>(k);
    const auto along = [u](const std::int16_t* a) {
      return static_cast<float>(a[0]) + u * static_cast<float>(a[1] - a[0]);
    };
    const float near = along(v) + w * (along(v + row_) - along(v)),
                far = along(v + layer_) + w * (along(v + layer_ + row_) - along(v + layer_));
    return near + t * (far - near);
  }

 private:
  const std::int16_t* hounsfield_;
  glm::ivec3 size_;
  std::ptrdiff_t row_, layer_;
};

}  // namespace

void drawSlice(const assets::CtVolume& ct, const std::vector<std::uint8_t>& what, const JawViews::Plane& plane,
               const GreyRange& range, const PixelBox& box, render::Image& image) {
  const PixelPlaces places(ct.grid, plane);
  const GreySampler grey_at(ct);
  const glm::ivec3 size = ct.grid.size;
  // What is seen, with a pixel more to the right and below.
  const int width = box.end.x - box.low.x + 1, height = box.end.y - box.low.y + 1;
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  tbb::parallel_for(0, height, [&](int y) {
    std::uint8_t* const out = seen.data() + static_cast<std::ptrdiff_t>(y) * width;
    for (int x = 0; x < width; ++x) {
      const glm::vec3 p = places.at(box.low.x + x, box.low.y + y) + 0.5F;
      const glm::ivec3 voxel(below(p.x), below(p.y), below(p.z));
      const bool is_in = glm::all(glm::greaterThanEqual(voxel, glm::ivec3(0))) && glm::all(glm::lessThan(voxel, size));
      out[x] = is_in ? what[assets::indexIn(size, voxel)] : std::uint8_t{0};
    }
  });
  const float low_hu = static_cast<float>(range.low_hu),
              per_hu = 255.0F / static_cast<float>(range.high_hu - range.low_hu);
  tbb::parallel_for(box.low.y, box.end.y, [&](int y) {
    std::uint8_t* out = image.rgba.data() + 4 * (static_cast<std::ptrdiff_t>(y) * image.w + box.low.x);
    const std::uint8_t* here_row = seen.data() + static_cast<std::ptrdiff_t>(y - box.low.y) * width;
    for (int x = box.low.x; x < box.end.x; ++x, out += 4, ++here_row) {
      const float grey = std::clamp(per_hu * (grey_at.at(places.at(x, y)) - low_hu), 0.0F, 255.0F);
      const std::uint8_t here = here_row[0], beside = here_row[1], under = here_row[width];
      const bool is_tooth = here != 0 && here != kBoneVoxel;
      if (!is_tooth && here == beside && here == under) {
        out[0] = out[1] = out[2] = static_cast<std::uint8_t>(grey + 0.5F);
        continue;
      }
      glm::dvec3 colour(grey);
      if (is_tooth) colour = glm::mix(colour, colourOf(here), kToothTint);
      if (isOtherTooth(here, beside) || isOtherTooth(here, under)) {
        const std::uint8_t owner = is_tooth ? here : isOtherTooth(here, beside) ? beside : under;
        colour = glm::mix(colour, colourOf(owner), kOutline);
      }
      for (int c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>(std::clamp(colour[c] + 0.5, 0.0, 255.0));
    }
  });
}

}  // namespace app
