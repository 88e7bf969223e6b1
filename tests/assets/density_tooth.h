// A lower molar as a volume of densities: a round crown with enamel, two roots from front to back, a chamber and two
// canals; upright, its neck at z = 0. Volumes by hand: the crown's ball of 5 mm over the neck, cones as roots.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "tests/assets/scan_on_disk.h"

namespace density_tooth {

struct Form {
  bool has_pulp = true;
  double scale = 1.0;
};

inline double rootHalf_mm(double z) { return std::max(0.0, 2.1 + 0.12 * z); }

/// 0 air, 100 pulp, 150 dentine, 255 enamel.
inline int densityAt(glm::dvec3 p, const Form& form) {
  p /= form.scale;
  constexpr double kCrown_mm = 5.0, kTop_mm = 6.0, kApex_mm = -12.0, kRootAt_mm = 2.4;
  const double r = std::hypot(p.x, p.y);
  // Straight sides to 2.5 mm, then a dome.
  const double side_mm = kCrown_mm - r;
  const double dome_mm = p.z > 2.5 ? 1.0 - std::hypot(r / kCrown_mm, (p.z - 2.5) / (kTop_mm - 2.5)) : 1.0;
  const double root_mm =
      p.z > kApex_mm ? rootHalf_mm(p.z) - std::min(std::hypot(p.x, p.y - kRootAt_mm), std::hypot(p.x, p.y + kRootAt_mm))
                     : -1.0;
  const bool in_trunk = p.z > -3.0 && p.z <= 0.0 && r < 4.6;
  const bool in_crown = p.z > 0.0 && side_mm > 0.0 && dome_mm > 0.0;
  if (!in_crown && !in_trunk && !(p.z <= 0.0 && root_mm > 0.0)) return 0;
  if (form.has_pulp) {
    const bool in_chamber = glm::length((p - glm::dvec3(0.0, 0.0, -0.3)) / glm::dvec3(1.5, 3.0, 0.9)) < 1.0;
    const double canal_mm = std::min(std::hypot(p.x, p.y - kRootAt_mm), std::hypot(p.x, p.y + kRootAt_mm));
    if (in_chamber || (p.z < 0.0 && p.z > kApex_mm + 0.5 && canal_mm < 0.35)) return 100;
  }
  // Enamel: 0.8 mm at the sides, thinner to the neck, 1.3 mm over the dome.
  const double thick_mm = std::min(0.8, 0.4 * p.z);
  const bool in_enamel = in_crown && (side_mm < thick_mm || (p.z > 2.5 && dome_mm < 0.26));
  return in_enamel ? 255 : 150;
}

/// Densities of a scan in the order of its voxels; `parts`: samples of a voxel along each edge, 1: levels alone.
inline std::vector<std::uint8_t> densities(const on_disk::Scan& scan, const Form& form, int parts) {
  std::vector<std::uint8_t> values;
  for (int k = 0; k < scan.size.z; ++k)
    for (int j = 0; j < scan.size.y; ++j)
      for (int i = 0; i < scan.size.x; ++i) {
        int sum = 0;
        for (int n = 0; n < parts * parts * parts; ++n) {
          const glm::dvec3 within((n % parts + 0.5) / parts - 0.5, (n / parts % parts + 0.5) / parts - 0.5,
                                  (n / parts / parts + 0.5) / parts - 0.5);
          sum += densityAt(scan.origin + scan.step * (glm::dvec3(i, j, k) + within), form);
        }
        values.push_back(static_cast<std::uint8_t>((sum + parts * parts * parts / 2) / (parts * parts * parts)));
      }
  return values;
}

/// Cubic voxels around the tooth.
inline on_disk::Scan scanOf(glm::ivec3 size, double spacing_mm) {
  const glm::dvec3 middle(0.0, 0.0, -3.0);
  return {size, glm::dmat3(spacing_mm), middle - 0.5 * spacing_mm * glm::dvec3(size - 1)};
}

inline std::string nrrd(const on_disk::Scan& scan, const Form& form = {}, int parts = 3) {
  return on_disk::nrrd(scan, "uchar", on_disk::bytesOf(densities(scan, form, parts)));
}

/// The smallest that shows it all.
inline on_disk::Scan usualScan(double spacing_mm = 0.25) {
  const glm::dvec3 size = glm::ceil(glm::dvec3(11.0, 11.0, 19.0) / spacing_mm);
  return scanOf(glm::ivec3(size), spacing_mm);
}

}  // namespace density_tooth
