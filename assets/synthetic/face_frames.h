// The two bodies of the synthetic head with the mouth open.
// Mandible: frame P (LPS mm, origin between the lower incisal edges), mirrored in x for a right-sided operation, so
// that the operated side is at +x. Skull K: same axes and origin with the mouth closed. The mouth opens about a hinge
// near the condyles, which glide forward in proportion: at the usual 37 mm between the incisal edges by 22 degrees and
// 10 mm (Gray's Anatomy: norm 35-50 mm, hinge and glide together); that they keep this proportion is our own modelling.
// Immutable; any thread; a few flops.
#pragma once

#include "assets/synthetic/implicit_shape.h"
#include "assets/synthetic/jaw.h"
#include "calibration/geometry/units.h"

namespace assets {

class MouthOpening {
 public:
  /// Between the incisal edges, on the midline.
  explicit MouthOpening(double opening_mm = kUsualOpening_mm) {
    // From the proportion, which is exact for the usual opening, to the share of it that opens so far.
    double share = opening_mm / kUsualOpening_mm;
    for (int step = 0; step < 12; ++step) {
      turnTo(share);
      share += (opening_mm - kUsualOpening_mm - (incisalGap_mm() - usual().incisalGap_mm())) / kUsualOpening_mm;
    }
  }

  glm::dvec3 skullFromMandible(const glm::dvec3& p_P) const {
    return kHinge_K_mm + turned(p_P - kHinge_K_mm, sine_) + glide_K_mm_;
  }
  glm::dvec3 mandibleFromSkull(const glm::dvec3& p_K) const {
    return kHinge_K_mm + turned(p_K - glide_K_mm_ - kHinge_K_mm, -sine_);
  }

  /// By how much the occlusal plane of the upper jaw stands higher at that place from front to back than in the mouth
  /// of the usual opening, z in the mandible's frame; 0 for the usual one.
  double raised_mm(double posterior_mm) const {
    const glm::dvec3 place_K(0.0, posterior_mm, 0.0);
    return mandibleFromSkull(place_K).z - usual().mandibleFromSkull(place_K).z;
  }

 private:
  struct Share {};
  MouthOpening(Share, double share) { turnTo(share); }
  static MouthOpening usual() { return {Share{}, 1.0}; }

  void turnTo(double share) {
    cosine_ = std::cos(share * kUsualTurn_rad), sine_ = std::sin(share * kUsualTurn_rad);
    glide_K_mm_ = share * kUsualGlide_K_mm;
  }
  double incisalGap_mm() const { return glm::length(mandibleFromSkull(kUpperIncisalEdge_K_mm)); }
  /// About x, positive from y to z.
  glm::dvec3 turned(const glm::dvec3& p, double sine) const {
    return {p.x, cosine_ * p.y - sine * p.z, sine * p.y + cosine_ * p.z};
  }

  static constexpr double kUsualTurn_rad = 22.0 * calibration::kPi / 180.0;
  static constexpr glm::dvec3 kHinge_K_mm{0.0, 88.0, 48.0}, kUsualGlide_K_mm{0.0, -10.0, -4.0};
  static constexpr glm::dvec3 kUpperIncisalEdge_K_mm{0.0, -3.0, -0.7};

  double cosine_ = 1.0, sine_ = 0.0;
  glm::dvec3 glide_K_mm_{0.0};
};

}  // namespace assets
