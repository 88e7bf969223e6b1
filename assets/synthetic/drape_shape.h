// Surgical cloth: a cap over hair, ears and the back of the head, and a drape over neck and chest, ending in a rolled
// hem. Signed distances. Frame of the mandible with the operated side at +x (face_frames.h), mm. Any thread; about 1 us
// a query.
#pragma once

#include "assets/synthetic/head_shape.h"

namespace assets {

/// Distance of a point of the head behind the hem, positive under the cloth; that of the cap in the skull's frame.
double depthUnderCap_mm(const glm::dvec3& p_K);
double depthUnderDrape_mm(const glm::dvec3& p);

double cap_mm(const HeadShape& head, const glm::dvec3& p);
double drape_mm(const HeadShape& head, const glm::dvec3& p);

}  // namespace assets
