// Points spread evenly over the surface of a cutting head, each with its normal: Fibonacci's lattice, the golden angle
// from point to point and equal areas along the profile from tip to shaft. Frame T, mm. Exactly even in area; the
// rotation is a recurrence, without table or trigonometry. Servo thread; about 5 ns a point.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "calibration/geometry/units.h"
#include "haptics/tool/bur_shape.h"

namespace haptics {

/// cos and sin of the golden angle pi (3 - sqrt 5).
inline constexpr double kGoldenCos = -0.73736887807831985597, kGoldenSin = 0.67549029426152362720;

/// A point of a head's profile with its outward normal (out, up).
struct ProfilePoint {
  double radius_mm = 0.0, z_mm = 0.0, normal_out = 0.0, normal_up = 0.0;
};

/// A head's profile from the tip at -z to the other end, by area.
class HeadProfile {
 public:
  explicit HeadProfile(const BurShape& head) : head_(head), half_(0.5 * head.length_mm) {
    const double R = head.radius_mm, slant = std::hypot(R, head.length_mm), girth = 2.0 * calibration::kPi * R;
    using enum ShapeKind;
    if (head.kind == revolved) {
      outline_ = revolvedOutline(head);
      const double low = outline_.radius_mm[0], high = outline_.radius_mm[outline_.count - 1];
      tip_ = calibration::kPi * low * low;
      end_ = calibration::kPi * high * high;
      for (std::size_t n = 0; n + 1 < outline_.count; ++n) side_ += frustum_mm2(n);
    } else if (head.kind == sphere || head.kind == capsule) {
      if (head.kind == sphere) half_ = 0.0;
      tip_ = end_ = girth * R;
      side_ = girth * 2.0 * half_;
    } else if (head.kind == cylinder) {
      tip_ = end_ = 0.5 * girth * R;
      side_ = girth * head.length_mm;
    } else {
      side_ = 0.5 * girth * slant;
      end_ = 0.5 * girth * R;
      cone_out_ = slant > 0.0 ? head.length_mm / slant : 1.0;
      cone_up_ = slant > 0.0 ? -R / slant : 0.0;
    }
  }

  double area_mm2() const { return tip_ + side_ + end_; }

  /// The point with `below_mm2` of the area between it and the tip.
  ProfilePoint at(double below_mm2) const {
    const double R = head_.radius_mm;
    if (head_.kind == ShapeKind::revolved) return onOutline(below_mm2);
    if (below_mm2 < tip_) return tip(below_mm2 / tip_);
    below_mm2 -= tip_;
    if (below_mm2 < side_) {
      const double part = below_mm2 / side_;
      if (head_.kind != ShapeKind::cone) return {R, half_ * (2.0 * part - 1.0), 1.0, 0.0};
      const double r = std::sqrt(part);
      return {R * r, half_ * (2.0 * r - 1.0), cone_out_, cone_up_};
    }
    const ProfilePoint mirrored = tip(1.0 - std::min(1.0, (below_mm2 - side_) / end_));
    return {mirrored.radius_mm, -mirrored.z_mm, mirrored.normal_out, -mirrored.normal_up};
  }

 private:
  double frustum_mm2(std::size_t n) const {
    const double r0 = outline_.radius_mm[n], r1 = outline_.radius_mm[n + 1];
    return calibration::kPi * (r0 + r1) * std::hypot(r1 - r0, outline_.z_mm[n + 1] - outline_.z_mm[n]);
  }

  /// The area up to a radius of a disc or a frustum grows with the radius squared.
  ProfilePoint onOutline(double below_mm2) const {
    const std::size_t last = outline_.count - 1;
    if (below_mm2 < tip_) return {outline_.radius_mm[0] * std::sqrt(below_mm2 / tip_), -half_, 0.0, -1.0};
    below_mm2 -= tip_;
    for (std::size_t n = 0; n < last; ++n) {
      const double area_mm2 = frustum_mm2(n);
      if (below_mm2 >= area_mm2) {
        below_mm2 -= area_mm2;
        continue;
      }
      const double r0 = outline_.radius_mm[n], r1 = outline_.radius_mm[n + 1], part = below_mm2 / area_mm2;
      const double r = std::sqrt(r0 * r0 + part * (r1 * r1 - r0 * r0));
      const double way_r = r1 - r0, way_z = outline_.z_mm[n + 1] - outline_.z_mm[n], length = std::hypot(way_r, way_z);
      const double t = std::abs(way_r) > 1e-9 ? (r - r0) / way_r : part;
      return {r, outline_.z_mm[n] + t * way_z, way_z / length, -way_r / length};
    }
    const double left = end_ > 0.0 ? 1.0 - std::min(1.0, below_mm2 / end_) : 0.0;
    return {outline_.radius_mm[last] * std::sqrt(left), half_, 0.0, 1.0};
  }

  /// At the end at -z, with `part` of its area towards the axis: half a ball or a disc.
  ProfilePoint tip(double part) const {
    const double R = head_.radius_mm;
    if (head_.kind == ShapeKind::cylinder || head_.kind == ShapeKind::cone)
      return {R * std::sqrt(part), -half_, 0.0, -1.0};
    const double down = 1.0 - part, out = std::sqrt(std::max(0.0, 1.0 - down * down));
    return {R * out, -half_ - R * down, out, -down};
  }

  BurShape head_;
  assets::BurOutline outline_{};
  double half_, tip_ = 0.0, side_ = 0.0, end_ = 0.0, cone_out_ = 1.0, cone_up_ = 0.0;
};

/// Calls visit(position_T, normal_T) for each of `count` points; each stands for 1 / count of the area.
template <class Visit>
void visitSurfacePoints(const HeadProfile& profile, int count, Visit&& visit) {
  const double step_mm2 = profile.area_mm2() / count;
  double cosine = 1.0, sine = 0.0;
  for (int n = 0; n < count; ++n) {
    const ProfilePoint point = profile.at((n + 0.5) * step_mm2);
    visit(glm::dvec3(point.radius_mm * cosine, point.radius_mm * sine, point.z_mm),
          glm::dvec3(point.normal_out * cosine, point.normal_out * sine, point.normal_up));
    const double next = cosine * kGoldenCos - sine * kGoldenSin;
    sine = sine * kGoldenCos + cosine * kGoldenSin;
    cosine = next;
  }
}

}  // namespace haptics
