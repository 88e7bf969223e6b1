// The colours of the synthetic face, vertex by vertex: skin with its flush and mottling, lips, mucosa, tongue, teeth;
// and how much light reaches a place. Frame of the mandible with the operated side at +x (face_frames.h), mm; linear
// RGB. Any thread; about 5 us a vertex. Colours are our own choice, judged by eye. Light: distance field sampled along
// the normal (Evans, 2006).
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
  /// Inside the mouth, where the surface is wet.
  bool isWet(const glm::dvec3& p) const;

 private:
  double light(const glm::dvec3& p, const glm::dvec3& n) const;
  double mottling(const glm::dvec3& p, double wavelength_mm) const;

  const HeadShape& head_;
  glm::dvec3 phase_;
};

}  // namespace assets
