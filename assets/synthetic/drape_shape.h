// The cloth of the theatre: a cap over hair, ears and back of the head, and a drape over neck and chest. Signed
// distances. Frame of the mandible with the operated side at +x (face_frames.h), mm. Any thread; about 1 us a query.
// Both cover the head by some millimetres and end in a rolled hem; folds are our own modelling.
#pragma once

#include "assets/synthetic/head_shape.h"

namespace assets {

/// Positive above the hem: how deep under the cloth a point of the head lies.
double depthUnderCap_mm(const glm::dvec3& p);
double depthUnderDrape_mm(const glm::dvec3& p);

double cap_mm(const HeadShape& head, const glm::dvec3& p);
double drape_mm(const HeadShape& head, const glm::dvec3& p);

}  // namespace assets
