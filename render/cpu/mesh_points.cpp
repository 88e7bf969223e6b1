#include "render/cpu/mesh_points.h"

#include <algorithm>
#include <utility>

namespace render {
namespace {

// Moves the arrays into a larger allocation.
template <class T, std::size_t kArrays>
void move(T** const (&arrays)[kArrays], std::size_t used, std::size_t room, std::vector<T>& memory) {
  std::vector<T> larger(kArrays * room);
  T* to = larger.data();
  for (T** array : arrays) {
    if (used > 0) std::copy_n(*array, used, to);
    *array = std::exchange(to, to + room);
  }
  memory = std::move(larger);
}

}  // namespace

void MeshPoints::makeRoom(int more) {
  const auto wanted = static_cast<std::size_t>(count + more + kLanePadding);
  if (wanted <= room_) return;
  room_ = wanted + wanted / 2;
  const auto used = static_cast<std::size_t>(count);
  move({&distance_mm, &nx, &ny, &nz, &r, &g, &b, &a, &roughness, &metallic, &qx, &qy, &qz, &mx, &my, &mz}, used, room_,
       values_);
  move({&ray, &finish, &is_cut, &faces_eye}, used, room_, integers_);
}

}  // namespace render
