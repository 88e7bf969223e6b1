#include "calibration/synthetic/glass_plate.h"

#include <algorithm>
#include <cmath>

namespace calibration {
namespace {

/// Tangents of the angles before and in the glass, and the direction along the face in which the line runs.
struct Bend {
  double tan_outside = 0.0, tan_inside = 0.0;
  glm::dvec3 along_face{0.0};
};

double tangentInside(double sine, double refractive_index) {
  return sine / std::sqrt(refractive_index * refractive_index - sine * sine);
}

Bend bendOf(const GlassPlate& plate, const Ray& sight) {
  const double into = glm::dot(sight.along_W.xyz, plate.face.normal);
  const glm::dvec3 sideways = sight.along_W.xyz - into * plate.face.normal;
  const double sine = glm::length(sideways), cosine = std::max(std::abs(into), 1e-9);
  if (sine < 1e-12) return {};
  return {sine / cosine, tangentInside(sine, plate.refractive_index), sideways / sine};
}

}  // namespace

double plateShift_mm(const GlassPlate& plate, double angle_rad) {
  const double sine = std::sin(angle_rad), cosine = std::cos(angle_rad), n = plate.refractive_index;
  return plate.thickness_mm * sine * (1.0 - cosine / std::sqrt(n * n - sine * sine));
}

double ghostSpacing_mm(const GlassPlate& plate, double angle_rad) {
  return 2.0 * plate.thickness_mm * tangentInside(std::sin(angle_rad), plate.refractive_index) * std::cos(angle_rad);
}

Ray seenThrough(const GlassPlate& plate, const Ray& sight) {
  const Bend bend = bendOf(plate, sight);
  const double moved_mm = plate.thickness_mm * (bend.tan_inside - bend.tan_outside);
  return {{sight.from_W.mm + moved_mm * bend.along_face}, sight.along_W};
}

Ray mirrored(const Plane<World>& face, const Ray& sight) {
  const double into = glm::dot(sight.along_W.xyz, face.normal);
  const double way_mm = -face.distance_mm(sight.from_W) / (std::abs(into) < 1e-12 ? 1e-12 : into);
  return {{sight.from_W.mm + way_mm * sight.along_W.xyz}, {sight.along_W.xyz - 2.0 * into * face.normal}};
}

Ray mirroredByFarFace(const GlassPlate& plate, const Ray& sight) {
  const Bend bend = bendOf(plate, sight);
  Ray out = mirrored(plate.face, sight);
  out.from_W.mm += 2.0 * plate.thickness_mm * bend.tan_inside * bend.along_face;
  return out;
}

}  // namespace calibration
