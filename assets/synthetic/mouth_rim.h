// Rim of the open mouth: a closed curve through the lips' inner edge, retracted on the operated side. Frame of the
// synthetic face (face_frames.h), mm. Immutable; any thread; about 0.3 us a query. Interincisal opening 37 mm,
// commissure retracted by about 20 mm; shape is our own modelling.
#pragma once

#include <array>
#include <functional>

#include <glm/glm.hpp>

namespace assets {

class MouthRim {
 public:
  static constexpr std::size_t kPoints = 120;

  /// `depth_at(x, z)`: y of the skin of the closed face.
  explicit MouthRim(const std::function<double(double x_mm, double z_mm)>& depth_at);

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
  std::array<glm::dvec2, kPoints> edge_;
  std::array<glm::dvec3, kPoints> lip_;
  std::array<double, kPoints> radius_mm_;
};

}  // namespace assets
