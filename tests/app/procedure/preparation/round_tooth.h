// A round tooth of enamel over dentine with a flat top, and stumps made of it, in closed form. The tooth's frame stands
// askew in P.
#pragma once

#include "app/procedure/preparation/preparation_outcomes.h"
#include "tests/app/procedure/root_canal/shapes.h"

namespace app::round_tooth {

inline constexpr double kRadius_mm = 5.0, kTop_mm = 7.0, kEnamel_mm = 1.0;
inline constexpr double kDegree = std::numbers::pi / 180.0;

inline assets::ToothFrame frame(bool is_askew) {
  assets::ToothFrame frame;
  frame.cervix_P_mm = {0.013, -0.021, 0.007};
  if (!is_askew) return frame;
  const double turn = 20.0 * kDegree, lean = 10.0 * kDegree;
  const glm::dvec3 up(std::sin(lean), 0.0, std::cos(lean));
  const glm::dvec3 mesial = glm::normalize(glm::dvec3(std::cos(turn), std::sin(turn), 0.0) -
                                           up * glm::dot(up, glm::dvec3(std::cos(turn), std::sin(turn), 0.0)));
  frame.axes_P = glm::dmat3(mesial, glm::cross(up, mesial), up);
  return frame;
}

inline double intact_mm(const glm::dvec3& p) { return std::min(kRadius_mm - std::hypot(p.x, p.y), kTop_mm - p.z); }

/// A frustum on the tooth cut off at height 0: its radius there, its walls' angle, its height.
inline shapes::Depth stump(double radius_mm, double degrees, double height_mm) {
  return [=](const glm::dvec3& p) {
    const double slope = std::tan(degrees * kDegree), side = std::cos(degrees * kDegree);
    const double wall_mm = std::min((radius_mm - slope * p.z - std::hypot(p.x, p.y)) * side, height_mm - p.z);
    return std::min(intact_mm(p), std::max(wall_mm, -p.z));
  };
}

struct Scene {
  assets::ToothFrame frame;
  assets::VolumeGrid grid;
  Crown crown;

  explicit Scene(double spacing_mm = 0.05, bool is_askew = false)
      : frame(round_tooth::frame(is_askew)),
        grid(shapes::gridOf(glm::dvec3(is_askew ? -7.0 : -6.0, is_askew ? -7.0 : -6.0, -2.0),
                            is_askew ? glm::dvec3(7.0, 7.0, 8.5) : glm::dvec3(6.0, 6.0, 8.0), spacing_mm)),
        crown(ToothBlocks(shapes::ShapeTooth(grid, inP(intact_mm),
                                             [this](const glm::dvec3& p_P) {
                                               const double depth_mm = intact_mm(frame.local(p_P));
                                               if (depth_mm < 0.0) return assets::Tissue::unlabelled;
                                               return depth_mm < kEnamel_mm ? assets::Tissue::enamel
                                                                            : assets::Tissue::dentine;
                                             })),
              frame) {}
  /// A depth of the tooth's frame, of P.
  shapes::Depth inP(const shapes::Depth& depth) const {
    return [depth, this](const glm::dvec3& p_P) { return depth(frame.local(p_P)); };
  }
  BoxBytes made(const shapes::Depth& depth) const {
    BoxBytes bytes(crown.solid.grid());
    const shapes::Depth depth_P = inP(depth);
    assets::forVoxels(bytes.grid(), [&](glm::ivec3 ijk, std::size_t v) {
      bytes.bytes()[v] = shapes::bytesOf(depth_P(bytes.grid().centre_P_mm(ijk)), grid.spacing_mm);
    });
    return bytes;
  }
};

/// With sharp angles, as closed forms have them.
inline IdealRule sharpCrown() {
  return {.name = "test",
          .for_people = "test",
          .occlusal_mm = 2.0,
          .margin_mm = 1.0,
          .margin_height_mm = 0.0,
          .half_angle_rad = 6.0 * kDegree,
          .edge_mm = 1e-6,
          .fillet_mm = 1e-6};
}

inline double frustum_mm3(double low_mm, double high_mm, double height_mm) {
  return std::numbers::pi * height_mm / 3.0 * (low_mm * low_mm + low_mm * high_mm + high_mm * high_mm);
}

}  // namespace app::round_tooth
