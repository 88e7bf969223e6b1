// Vertex colours of the synthetic face: skin, lips, mucosa, tongue, teeth, with ambient occlusion from the distance
// field along the normal (Evans 2006). Colours are our own choice. Frame of the mandible with the operated side at +x
// (face_frames.h), mm; linear RGB. Any thread; about 5 us a vertex.
#pragma once

#include <cstdint>

#include "assets/synthetic/head_shape.h"

namespace assets {

class FaceColours {
 public:
  FaceColours(const HeadShape& head, std::uint32_t seed);

  glm::vec3 head(const glm::dvec3& p, const glm::dvec3& n) const;
  glm::vec3 tongue(const glm::dvec3& p, const glm::dvec3& n) const;
  glm::vec3 tooth(const glm::dvec3& p, const glm::dvec3& n) const;
  /// Inside the mouth.
  bool isWet(const glm::dvec3& p) const;

 private:
  double openness(const glm::dvec3& p, const glm::dvec3& n) const;
  double mottling(const glm::dvec3& p, double wavelength_mm) const;

  const HeadShape& head_;
  glm::dvec3 phase_;
};

}  // namespace assets
