#include "render/volume/smooth_field.h"

#include <algorithm>
#include <cassert>

namespace render {
namespace {

// Five rows weighted 1 4 6 4 1; `step` values lie between them.
template <class Out, class In>
void weigh(const In* from, std::size_t step, std::size_t n, Out* to) {
  const In *const a = from, *const b = a + step, *const c = b + step, *const d = c + step, *const e = d + step;
  for (std::size_t i = 0; i < n; ++i)
    to[i] = static_cast<Out>(Out(a[i]) + Out(e[i]) + Out(4) * (Out(b[i]) + Out(d[i])) + Out(6) * Out(c[i]));
}

}  // namespace

void Smoother::smooth(const BorderedField<std::uint8_t>& solid, const VoxelBox& box,
                      BorderedField<std::uint16_t>& smooth) {
  const glm::ivec3 size = solid.layout().size, extent = box.extent, wide = extent + 2 * kSmoothReach;
  assert(!box.empty() && grown(box, 0, size) == box);

  // The box and its border.
  taken_.assign(countIn(wide), 0);
  const VoxelBox reach = grown(box, kSmoothReach, size);
  const glm::ivec3 shift = reach.first - box.first + kSmoothReach;
  for (int k = 0; k < reach.extent.z; ++k)
    for (int j = 0; j < reach.extent.y; ++j)
      std::copy_n(solid.at(reach.first + glm::ivec3(0, j, k)), reach.extent.x,
                  &taken_[indexIn(wide, glm::ivec3(shift.x, j + shift.y, k + shift.z))]);

  // z, then y: at most 255 * 16^2, which 16 bits hold.
  const std::size_t row = static_cast<std::size_t>(wide.x), slice = row * static_cast<std::size_t>(wide.y);
  along_z_.resize(slice * static_cast<std::size_t>(extent.z));
  for (std::size_t k = 0; k < static_cast<std::size_t>(extent.z); ++k)
    weigh(&taken_[k * slice], slice, slice, &along_z_[k * slice]);
  along_y_.resize(countIn({wide.x, extent.y, extent.z}));
  for (std::size_t k = 0; k < static_cast<std::size_t>(extent.z); ++k)
    for (std::size_t j = 0; j < static_cast<std::size_t>(extent.y); ++j)
      weigh(&along_z_[k * slice + j * row], row, row, &along_y_[(k * static_cast<std::size_t>(extent.y) + j) * row]);

  // x; then 255 * 16^3 becomes 65535.
  for (int k = 0; k < extent.z; ++k)
    for (int j = 0; j < extent.y; ++j) {
      const std::uint16_t* const a = &along_y_[indexIn({wide.x, extent.y, 0}, {0, j, k})];
      std::uint16_t* const to = smooth.at(box.first + glm::ivec3(0, j, k));
      for (int i = 0; i < extent.x; ++i) {
        const std::uint32_t sum =
            std::uint32_t{a[i]} + a[i + 4] + 4u * (std::uint32_t{a[i + 1]} + a[i + 3]) + 6u * a[i + 2];
        to[i] = static_cast<std::uint16_t>((sum * 257u) >> 12);
      }
    }
}

}  // namespace render
