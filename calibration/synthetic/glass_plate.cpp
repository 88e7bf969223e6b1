#include "calibration/synthetic/glass_plate.h"

#include <algorithm>
#include <cmath>

namespace calibration {
namespace {

/// Tangents of the angles outside and inside the glass, and the ray's direction along the face.
struct Bend {
  double tan_outside = 0.0, tan_inside = 0.0;
  glm::dvec3 along_face{0.0};
};

double tangentInside(double sine, double refractive_index) {
  return sine / std::sqrt(refractive_index * refractive_index - sine * sine);
}

Bend bendOf(const GlassPlate& plate, const Ray& ray) {
  const double into = glm::dot(ray.along_W.xyz, plate.face.normal);
  const glm::dvec3 sideways = ray.along_W.xyz - into * plate.face.normal;
  const double sine = glm::length(sideways), cosine = std::max(std::abs(into), 1e-9);
  if (sine < 1e-12) return {};
  return {sine / cosine, tangentInside(sine, plate.refractive_index), sideways / sine};
}

}  // namespace

Ray seenThrough(const GlassPlate& plate, const Ray& ray) {
  const Bend bend = bendOf(plate, ray);
  const double moved_mm = plate.thickness_mm * (bend.tan_inside - bend.tan_outside);
  return {{ray.from_W.mm + moved_mm * bend.along_face}, ray.along_W};
}

Ray mirrored(const Plane<World>& face, const Ray& ray) {
  const double into = glm::dot(ray.along_W.xyz, face.normal);
  const double way_mm = -face.distance_mm(ray.from_W) / (std::abs(into) < 1e-12 ? 1e-12 : into);
  return {{ray.from_W.mm + way_mm * ray.along_W.xyz}, {ray.along_W.xyz - 2.0 * into * face.normal}};
}

Ray mirroredByFarFace(const GlassPlate& plate, const Ray& ray) {
  const Bend bend = bendOf(plate, ray);
  Ray out = mirrored(plate.face, ray);
  out.from_W.mm += 2.0 * plate.thickness_mm * bend.tan_inside * bend.along_face;
  return out;
}

}  // namespace calibration
