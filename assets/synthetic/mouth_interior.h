// Interior of the open mouth next to the operated jaw: gingiva, teeth and tongue. Signed distances, negative inside.
// Frame of the mandible with the operated side at +x, or of the skull (K) by parameter name (face_frames.h), mm. The
// operated side of the lower jaw from the first premolar back belongs to the scan and is left out. Any thread; below 1
// us a query. Arch form and tooth sizes: adult means (Ash and Nelson, Wheeler's Dental Anatomy); crowns are simplified.
#pragma once

#include <glm/glm.hpp>

namespace assets {

double upperGingiva_mm(const glm::dvec3& p_K);
double lowerGingiva_mm(const glm::dvec3& p);
double upperTeeth_mm(const glm::dvec3& p_K);
double lowerTeeth_mm(const glm::dvec3& p);
double tongue_mm(const glm::dvec3& p);

/// Space of the scanned jaw segment with a margin, which the face must not enter.
double jawSegmentSpace_mm(const glm::dvec3& p);

}  // namespace assets
