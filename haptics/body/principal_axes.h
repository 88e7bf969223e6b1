// The principal axes of a body or a section. Any thread; a microsecond.
#pragma once

#include <glm/glm.hpp>

namespace haptics {

/// The axes of a symmetric matrix, as columns of a rotation, in no order (Jacobi 1846).
glm::dmat3 principalAxes(glm::dmat3 matrix);

}  // namespace haptics
