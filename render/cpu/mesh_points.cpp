#include "render/cpu/mesh_points.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace render {

void MeshPoints::makeRoom(int more) {
  const auto wanted = static_cast<std::size_t>(count + more + kLanePadding);
  if (wanted <= room_) return;
  const std::size_t room = wanted + wanted / 2, used = static_cast<std::size_t>(count);
  float** const floats[] = {&distance_mm, &nx, &ny, &nz, &r, &g, &b, &a, &roughness, &metallic};
  std::int32_t** const integers[] = {&ray, &finish, &is_cut, &faces_eye};
  std::vector<float> values(std::size(floats) * room, 0.0f);
  std::vector<std::int32_t> numbers(std::size(integers) * room, 0);
  float* value = values.data();
  for (float** array : floats) {
    if (used > 0) std::copy_n(*array, used, value);
    *array = value;
    value += room;
  }
  std::int32_t* number = numbers.data();
  for (std::int32_t** array : integers) {
    if (used > 0) std::copy_n(*array, used, number);
    *array = number;
    number += room;
  }
  values_ = std::move(values);
  numbers_ = std::move(numbers);
  room_ = room;
}

}  // namespace render
