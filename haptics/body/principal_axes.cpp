#include "haptics/body/principal_axes.h"

#include <cmath>
#include <utility>

namespace haptics {

glm::dmat3 principalAxes(glm::dmat3 matrix) {
  glm::dmat3 axes(1.0);
  for (int sweep = 0; sweep < 12; ++sweep)
    for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      if (std::abs(matrix[p][q]) < 1e-12 * (std::abs(matrix[p][p]) + std::abs(matrix[q][q]))) continue;
      const double ratio = (matrix[q][q] - matrix[p][p]) / (2.0 * matrix[p][q]);
      const double tangent = std::copysign(1.0, ratio) / (std::abs(ratio) + std::sqrt(1.0 + ratio * ratio));
      const double c = 1.0 / std::sqrt(1.0 + tangent * tangent), s = tangent * c;
      glm::dmat3 turn(1.0);
      turn[p][p] = turn[q][q] = c;
      turn[q][p] = s;
      turn[p][q] = -s;
      matrix = glm::transpose(turn) * matrix * turn;
      axes = axes * turn;
    }
  return axes;
}

}  // namespace haptics
