// The proxy (god-object) of the tool: surface-constrained with tangential freedom, so that deep immersion never takes
// its direction from a vanishing vector and the tool never sticks. For any law and head; head and shaft are two
// constraints, projected together. It rotates with the hand.
//   depth at the hand <= h_max:  the proxy is at the hand and the force is the law's.
//   deeper:  the proxy q stays at depth h_max, sliding to the point nearest the hand p, and
//            F = law(q) + k (q - p),  k the law's slope at q: over flat bone the force continues with this slope.
// Both join without a step, also while the bone is carved. Between facing walls the force fades. Frame P. Servo thread.
// At most kMaxEvaluations an update, one in steady sliding: one contact sum for the head and one for a shaft. Without
// damping, passivity and limits.
#pragma once

#include "haptics/contact/law.h"
#include "haptics/tool/tool.h"

namespace haptics {

/// h_max: half the head's smallest radius, or, if less, the equivalent depth at which the overlap is 85 % of that with
/// a 0.6 mm plate through the middle of the head: a large head does not pass the thinnest bone plate that must resist.
double maxLawDepth_mm(const BurShape& head);

class Proxy {
 public:
  static constexpr int kMaxEvaluations = 6;

  struct State {
    calibration::Point<calibration::Patient> proxy_P;        ///< of T's origin
    Contact head, shaft;                                     ///< at the proxy, faded between facing walls
    calibration::Vector<calibration::Patient> stretch_P_mm;  ///< q - p: the spring between hand and proxy
    double spring_N_per_mm = 0.0;                            ///< k of that spring
    int evaluations = 0;                                     ///< evaluations of the bone

    bool touches() const { return head.depth_mm > 0.0 || shaft.depth_mm > 0.0; }
    /// The head if it touches, else the shaft.
    const Contact& touching() const { return head.depth_mm > 0.0 ? head : shaft; }
    /// law(q) + k (q - p), head and shaft together; zero out of contact.
    calibration::Vector<calibration::Patient> force_P_N() const;
    /// About T's origin; the spring acts there.
    calibration::Vector<calibration::Patient> torque_P_Nmm() const;
    /// Upper bound of the energy of contact and spring: k h^2 + F h exceeds that of every law up to h = R/2 (a linear
    /// one stores k h^2 / 2), also where facing walls cancel the force.
    double maxStored_Nmm() const;
  };

  /// Moves the proxy towards the hand as far as the bone allows. A law steeper than the limit is scaled down.
  State update(const SolidBodies& bodies, const LawSettings& law, const Tool& tool,
               const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, const ToolMotion& motion,
               double max_stiffness_N_per_mm) noexcept;

  /// Follows the hand through bone without force: one evaluation there for depth and volume. Afterwards as release().
  State passThrough(const SolidBodies& bodies, const LawSettings& law, const Tool& tool,
                    const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT,
                    const ToolMotion& motion) noexcept;

  /// The next update() starts there: where something else has held the tool.
  void startAt(const calibration::Point<calibration::Patient>& p_P) {
    release();
    proxy_P_ = p_P;
    placed_ = true;
    head_ = shaft_ = {};
  }
  /// The next update() starts at the hand.
  void release() { placed_ = false; }

 private:
  calibration::Point<calibration::Patient> proxy_P_;
  Contact head_, shaft_;  ///< at proxy_P_, last evaluated
  LawState law_state_;
  LawKind last_law_ = LawKind::agus;
  BurShape last_head_;
  double law_state_age_s_ = 0.0;
  double step_scale_ = 1.0;  ///< of constrained moves
  bool placed_ = false;
};

}  // namespace haptics
