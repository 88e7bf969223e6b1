// A tooth on a fine grid: its shell by the distances of a closed form or of a scan's labels, its canals and chamber in
// closed form, bone and soft tissue around from the scan. A voxel is made of distances by min and max, never by cases:
// a lid over an orifice would stop a file. Frame P, mm. Immutable; any thread. A molar at 0.04 mm: fine_tooth_bench.
#pragma once

#include <memory>

#include "assets/scan/tooth_surroundings.h"
#include "assets/tooth_canals.h"
#include "assets/tooth_sampler.h"

namespace assets {

/// A tooth's own surfaces as signed distances, negative inside, that change by no more than the way.
class ToothShell {
 public:
  struct Box {
    glm::dvec3 low_P_mm{0.0}, high_P_mm{0.0};
  };

  ToothShell() = default;
  virtual ~ToothShell() = default;
  ToothShell(const ToothShell&) = delete;
  ToothShell& operator=(const ToothShell&) = delete;

  virtual Box box() const = 0;
  virtual double outer_mm(const glm::dvec3& p_P_mm) const = 0;
  /// Dentine and pulp, given the outer distance there; changes by at most 1.6 times the way.
  virtual double core_mm(const glm::dvec3& p_P_mm, double outer_mm) const = 0;
  /// Pulp that a scan shows, beside canals and chamber; far where there is none.
  virtual double pulp_mm(const glm::dvec3&) const { return StructureDistance::kReach_mm; }
};

inline constexpr double kFineSpacing_mm = 0.04;
/// Around the tooth.
inline constexpr double kFineMargin_mm = 1.0;

/// `ct`: of the scan in which it stands; no voxels: alone. Throws LoadError where a canal is thinner than a voxel.
std::unique_ptr<ToothSampler> fineTooth(std::unique_ptr<ToothShell> shell, const ToothCanals& canals,
                                        const CtVolume& ct, double spacing_mm = kFineSpacing_mm);

}  // namespace assets
