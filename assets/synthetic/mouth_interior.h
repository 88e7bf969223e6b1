// What stands in the opened mouth beside the operated jaw: gums, teeth and tongue. Signed distances, negative inside.
// Frame of the mandible with the operated side at +x, or of the skull (K) where the name says so (face_frames.h), mm.
// The operated side of the lower jaw from the first premolar back belongs to the scan and is left out.
// Any thread; below 1 us a query. Arch form and tooth sizes: adult means (Ash and Nelson, Wheeler's Dental Anatomy);
// crowns are our own simplification: context behind the operation, not a tooth to be drilled.
#pragma once

#include <glm/glm.hpp>

namespace assets {

double upperGingiva_mm(const glm::dvec3& p_K);
double lowerGingiva_mm(const glm::dvec3& p);
double upperTeeth_mm(const glm::dvec3& p_K);
double lowerTeeth_mm(const glm::dvec3& p);
double tongue_mm(const glm::dvec3& p);

/// The space that the scanned jaw segment takes up, with a margin: nothing of the face may reach into it.
double jawSegmentSpace_mm(const glm::dvec3& p);

}  // namespace assets
