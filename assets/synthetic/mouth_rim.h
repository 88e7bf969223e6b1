// The opened mouth's rim: a closed curve through the lips' inner edge, pulled wide on the operated side by the
// retractor. Frame of the synthetic face (face_frames.h), mm. Immutable; any thread reads; about 0.3 us a query. Shape:
// our own modelling after an interincisal opening of 37 mm and a commissure retracted by about 20 mm.
#pragma once

#include <array>
#include <functional>

#include <glm/glm.hpp>

namespace assets {

class MouthRim {
 public:
  static constexpr std::size_t kPoints = 120;

  /// `depth_at(x, z)`: y of the closed face's skin, on which the rim is laid.
  explicit MouthRim(const std::function<double(double x_mm, double z_mm)>& depth_at);

  struct LipPoint {
    double distance_mm = 0.0;  ///< to the tube of lip around the rim, negative inside the lip
    double turn = 0.0;         ///< 0..1 round the rim, from the middle of the upper lip toward the operated side
  };
  LipPoint lip(const glm::dvec3& p_mm) const;

  /// Signed distance in the frontal plane (x, z) to the opening: negative inside it.
  double opening_mm(double x_mm, double z_mm) const;

  /// The middle of the lip where the retractor holds it.
  const glm::dvec3& retractedCorner_mm() const { return lip_[kPoints * 13 / 40]; }

 private:
  std::array<glm::dvec2, kPoints> edge_;
  std::array<glm::dvec3, kPoints> lip_;
  std::array<double, kPoints> radius_mm_;
};

}  // namespace assets
