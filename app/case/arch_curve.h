// The curve of a dental arch in the axial plane: a spline through the centres of its teeth, from the patient's right to
// the left, extended straight at both ends. Frame P, mm. For the panoramic view. Start-up only; a pass over the voxels.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "assets/patient.h"

namespace app {

/// Of the arch with the operated tooth, else of the lower one. With fewer than three numbered teeth: a straight line
/// through the operated tooth along a normal arch. Points about 0.5 mm apart, within the volume. Empty without both.
std::vector<glm::dvec2> archCurve_P_mm(const assets::Patient& patient);

}  // namespace app
