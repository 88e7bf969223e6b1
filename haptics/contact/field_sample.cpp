#include "haptics/contact/field_sample.h"

#include <cmath>

namespace haptics {

FieldSample sampleField(const SolidField& field, const glm::dvec3& at_P_mm) noexcept {
  const glm::dvec3 index = field.grid.indexFromPoint(at_P_mm);
  const glm::ivec3 size = field.grid.size;
  // Also false for what is no number.
  const bool near =
      index.x > -1.0 && index.y > -1.0 && index.z > -1.0 && index.x < size.x && index.y < size.y && index.z < size.z;
  if (!near) return {};
  const glm::dvec3 floor = glm::floor(index), part = index - floor;
  const glm::ivec3 low(floor);

  double sum = 0.0;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const glm::ivec3 ijk = low + glm::ivec3(i, j, k);
        if (!field.grid.contains(ijk)) continue;
        const double weight = (i ? part.x : 1.0 - part.x) * (j ? part.y : 1.0 - part.y) * (k ? part.z : 1.0 - part.z);
        sum += weight * field.solidAt(ijk);
      }
  if (sum <= 0.0) return {};
  const glm::ivec3 nearest = glm::clamp(glm::ivec3(glm::floor(index + 0.5)), glm::ivec3(0), size - 1);
  return {sum / 255.0, field.labelAt(nearest)};
}

}  // namespace haptics
