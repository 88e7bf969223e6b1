// Slow and obvious twin of the hold kernels: one sample after the other in double, straight from the formulas of
// reference/extraction 3.1, 3.4 and 4.2.
#pragma once

#include <cmath>

#include "haptics/ligament/piece_hold.h"

namespace haptics::phantom {

struct TwinSums {
  double energy = 0.0;
  std::array<double, 6> gradient{};
  std::array<std::array<double, 6>, 6> hessian{};
};

inline void addTwinForce(TwinSums& sums, const glm::dvec3& r, const glm::dvec3& f, const glm::dmat3& K) {
  const glm::dvec3 turn = glm::cross(r, f);
  double J[3][6] = {{1, 0, 0, 0, r.z, -r.y}, {0, 1, 0, -r.z, 0, r.x}, {0, 0, 1, r.y, -r.x, 0}};
  for (int a = 0; a < 6; ++a) {
    sums.gradient[static_cast<std::size_t>(a)] += a < 3 ? f[a] : turn[a - 3];
    for (int b = 0; b < 6; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          sums.hessian[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] += J[i][a] * K[j][i] * J[j][b];
  }
}

inline TwinSums twinSums(const PieceHold& hold, const PiecePose& X_PQ, const DistanceField* obstacles,
                         double period_s) {
  const PieceSamples& s = hold.samples();
  const LigamentLaw& law = hold.law();
  const LigamentMemory& memory = hold.state().ligament;
  const auto wide = [](float value) { return static_cast<double>(value); };
  TwinSums sums;
  for (std::size_t n = 0; n < s.size(); ++n) {
    const double A = wide(s.area_mm2[n]), t = wide(s.width_mm[n]);
    const glm::dvec3 p(wide(s.place_mm[0][n]), wide(s.place_mm[1][n]), wide(s.place_mm[2][n]));
    const glm::dvec3 normal(wide(s.normal[0][n]), wide(s.normal[1][n]), wide(s.normal[2][n]));
    const glm::dvec3 here = X_PQ.rotation * (s.centre_Q_mm + p) + X_PQ.translation_mm;
    const glm::dvec3 r = X_PQ.rotation * p, u = here - s.centre_Q_mm - p;

    glm::dvec3 in = normal;
    double depth = glm::dot(u, normal);
    if (obstacles != nullptr) {
      const auto there = obstacles->at(glm::vec3(obstacles->grid().indexFromPoint(here)));
      in = -glm::dvec3(there.gradient);
      depth = wide(s.rest_gap_mm[n]) - wide(there.distance_mm);
    }
    if (n >= s.ligament) {
      if (obstacles == nullptr || depth <= 0.0) continue;
      const double k = law.contact_N_per_mm3 * A;
      sums.energy += 0.5 * k * depth * depth;
      addTwinForce(sums, r, k * depth * in, k * glm::outerProduct(in, in));
      continue;
    }

    const double whole = 1.0 - wide(memory.torn[n]);
    const double un = glm::dot(u, normal), open = un < 0.0 ? 1.0 : 0.0;
    const glm::dmat3 projection = law.shear_weight * (glm::dmat3(1.0) - glm::outerProduct(normal, normal)) +
                                  open * glm::outerProduct(normal, normal);
    const double way = std::sqrt(std::max(glm::dot(u, projection * u), 1e-12)), stretch = way / t;
    const double low = std::min(stretch, law.peak_stretch), e = std::exp(law.fibre_stiffening * low);
    const double scale = law.fibre_N_per_mm2 / law.fibre_stiffening, stress = scale * (e - 1.0);
    const double slope = stretch > low ? 0.0 : law.fibre_N_per_mm2 * e;
    sums.energy += A * t * whole * (scale * ((e - 1.0) / law.fibre_stiffening - low) + stress * (stretch - low));
    const glm::dvec3 m = projection * u / way;
    addTwinForce(sums, r, A * whole * stress * m,
                 A * whole * (stress / way * projection + (slope / t - stress / way) * glm::outerProduct(m, m)));

    const double kept = whole / (1.0 + period_s / law.fluid_relaxation_s), change = un / t - wide(memory.strain[n]);
    const double q = wide(memory.fluid_N_per_mm2[n]);
    sums.energy += A * t * kept * (q + 0.5 * law.fluid_N_per_mm2 * change) * change;
    addTwinForce(sums, r, A * kept * (q + law.fluid_N_per_mm2 * change) * normal,
                 A * kept * law.fluid_N_per_mm2 / t * glm::outerProduct(normal, normal));

    const double strain = (depth - wide(memory.widened_mm[n])) / t;
    if (strain <= 0.0) continue;
    const double within = std::min(strain, 1.0), past = strain - within, w = std::exp(law.wall_stiffening * within);
    const double wall = law.wall_N_per_mm2 / law.wall_stiffening, end_slope = law.wall_N_per_mm2 * w;
    const double pressure = wall * (w - 1.0) + (past > 0.0 ? end_slope * past : 0.0);
    sums.energy +=
        A * t *
        (wall * ((w - 1.0) / law.wall_stiffening - within) + past * (wall * (w - 1.0) + 0.5 * end_slope * past));
    addTwinForce(sums, r, A * pressure * in, A * end_slope / t * glm::outerProduct(in, in));
  }
  return sums;
}

}  // namespace haptics::phantom
