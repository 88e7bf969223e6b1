// A tooth with two roots between a neighbour and a canal, in a block of bone; what a planned cut takes from it, and the
// bodies as the servo would have them. Frame P, mm.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "app/procedure/bodies_copy.h"
#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "assets/tissue.h"
#include "haptics/body/components.h"

namespace app {

inline constexpr double kSpacing_mm = 0.4, kBur_mm = 1.0;
inline constexpr int kFdi = 48, kNeighbour = 47;

/// Crown above z = 0, a root on either side in y below it; distal is +y, the cheek -x, up +z.
inline bool isInTooth(const glm::dvec3& p) {
  if (std::abs(p.x) > 3.6) return false;
  if (p.z >= 0.0 && p.z < 6.0) return std::abs(p.y) < 4.0;
  return p.z < 0.0 && p.z > -7.0 && std::abs(std::abs(p.y) - 2.6) < 1.3;
}
inline bool isInNeighbour(const glm::dvec3& p) {
  return std::abs(p.x) < 4.0 && p.y > -13.0 && p.y < -5.2 && p.z > -9.0 && p.z < 7.0;
}

/// Bone up to `bone_top_mm`.
inline assets::Patient phantom(double bone_top_mm) {
  assets::Patient patient;
  assets::CtVolume& ct = patient.ct;
  ct.grid = {glm::ivec3(50, 70, 70), kSpacing_mm, glm::dvec3(-10.0, -16.0, -14.0)};
  const std::size_t voxels = ct.grid.voxelCount();
  ct.label.assign(voxels, 0);
  ct.solid.assign(voxels, 0);
  ct.tooth.assign(voxels, 0);
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    const bool tooth = isInTooth(p), neighbour = isInNeighbour(p);
    if (!tooth && !neighbour && p.z > bone_top_mm) return;
    ct.solid[v] = 255;
    ct.tooth[v] = static_cast<std::uint8_t>(tooth ? kFdi : neighbour ? kNeighbour : 0);
    const assets::Tissue tissue = tooth       ? (p.z > 0.5 ? assets::Tissue::enamel : assets::Tissue::dentine)
                                  : neighbour ? assets::Tissue::dentine
                                              : assets::Tissue::trabecular;
    ct.label[v] = static_cast<std::uint8_t>(tissue);
  });
  patient.site = assets::OperativeSite{};
  patient.site->fdi = kFdi;
  patient.site->axis_P = {0.0, 0.0, 1.0};
  patient.site->centre_P_mm = {0.0, 0.0, 2.0};
  for (double x = -8.0; x <= 8.0; x += 0.5) patient.mandibular_canal_P_mm.push_back({x, 0.0, -11.0});
  patient.mandibular_canal_radius_mm = 1.2;
  return patient;
}

/// What a ball of the plan's radius sweeps.
inline void sweep(assets::CtVolume& ct, const assets::PlannedCut& cut) {
  const double r_mm = cut.bur_radius_mm;
  const auto take = [&](const glm::dvec3& p) {
    const glm::ivec3 low(glm::floor(ct.grid.indexFromPoint(p - r_mm))),
        high(glm::ceil(ct.grid.indexFromPoint(p + r_mm)));
    assets::forVoxels(glm::max(low, glm::ivec3(0)), glm::min(high + 1, ct.grid.size), [&](glm::ivec3 ijk) {
      if (glm::distance(ct.grid.centre_P_mm(ijk), p) < r_mm) ct.solid[ct.grid.index(ijk)] = 0;
    });
  };
  for (const auto& stroke : cut.strokes_P_mm)
    for (std::size_t n = 0; n < stroke.size(); ++n) {
      const glm::dvec3 to = n + 1 < stroke.size() ? stroke[n + 1] : stroke[n];
      const int steps = 1 + static_cast<int>(glm::distance(stroke[n], to) / 0.2);
      for (int k = 0; k < steps; ++k) take(glm::mix(stroke[n], to, double(k) / steps));
    }
}

inline std::size_t solidOf(const assets::CtVolume& ct, int fdi) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < ct.solid.size(); ++v) count += ct.tooth[v] == fdi && ct.solid[v] != 0 ? 1 : 0;
  return count;
}

inline std::size_t piecesOf(const assets::CtVolume& ct) {
  std::vector<std::uint8_t> tooth(ct.solid.size());
  for (std::size_t v = 0; v < tooth.size(); ++v) tooth[v] = ct.tooth[v] == kFdi ? ct.solid[v] : std::uint8_t{0};
  const haptics::Components components(ct.grid, tooth);
  return static_cast<std::size_t>(
      std::ranges::count_if(components.pieces(), [](const auto& piece) { return piece.volume_mm3 > 5.0; }));
}

inline double nearestCanal_mm(const assets::Patient& patient, const assets::PlannedCut& cut) {
  double least_mm = 1e9;
  for (const auto& stroke : cut.strokes_P_mm)
    for (const glm::dvec3& p : stroke)
      for (const glm::dvec3& c : patient.mandibular_canal_P_mm) least_mm = std::min(least_mm, glm::distance(p, c));
  return least_mm - cut.bur_radius_mm - patient.mandibular_canal_radius_mm;
}

/// The phantom as the servo would have it.
struct Operation {
  assets::Patient patient;
  bool is_any_out = false;
  BodiesCopy copy() const {
    BodiesCopy bodies;
    bodies.jaw = patient.ct.solid;
    bodies.is_any_out = is_any_out;
    bodies.piece[0].assign(patient.ct.solid.size(), 0);
    for (std::size_t v = 0; v < bodies.jaw.size(); ++v)
      if (patient.ct.tooth[v] == kFdi) std::swap(bodies.jaw[v], bodies.piece[0][v]);
    return bodies;
  }
};

}  // namespace app
