// Rim of the open mouth: a closed curve through the lips' inner edge, retracted on the operated side. Frame of the
// synthetic face (face_frames.h), mm. Immutable; any thread; about 0.1 us a query. For an opening of
// 37 mm between the incisal edges, commissure retracted by about 20 mm; shape is our own modelling.
#pragma once

#include <array>
#include <functional>

#include <glm/glm.hpp>

namespace assets {

class MouthRim {
 public:
  static constexpr std::size_t kPoints = 120;

  /// `depth_at(x, z)`: y of the skin of the closed face. `raised_mm`: by how much the upper lip stands higher than with
  /// the usual opening; the lower lip stays, the corners are between.
  MouthRim(const std::function<double(double x_mm, double z_mm)>& depth_at, double raised_mm);

  struct LipPoint {
    double distance_mm = 0.0;  ///< to the lip, a tube along the rim; negative inside
    double fraction = 0.0;     ///< 0..1 along the rim, from the middle of the upper lip towards the operated side
  };
  LipPoint lip(const glm::dvec3& p_mm) const;

  /// Signed distance in the frontal plane (x, z) to the opening: negative inside it.
  double opening_mm(double x_mm, double z_mm) const;

  /// Centre of the lip at the retractor.
  const glm::dvec3& retractedCorner_mm() const { return lip_[kPoints * 13 / 40]; }

 private:
  /// A run of neighbouring segments with balls around their lip and edge, so that far runs are left out of a query.
  struct Run {
    glm::dvec3 lip_centre{0.0};
    glm::dvec2 edge_centre{0.0};
    double lip_reach_mm = 0.0, edge_reach_mm = 0.0;
    double low_z_mm = 1e9, high_z_mm = -1e9;  ///< of the edge
  };
  static constexpr std::size_t kRuns = 12, kPerRun = kPoints / kRuns;

  void gatherRuns();
  LipPoint nearestInRun(std::size_t run, const glm::dvec3& p_mm, LipPoint best) const;
  double squareInRun_mm2(std::size_t run, const glm::dvec2& p_mm) const;
  bool crossesOddlyInRun(std::size_t run, const glm::dvec2& p_mm) const;

  std::array<glm::dvec2, kPoints> edge_;
  std::array<glm::dvec3, kPoints> lip_;
  std::array<double, kPoints> radius_mm_;
  std::array<Run, kRuns> runs_;
};

}  // namespace assets
