// The proxy: where the surface holds the tool while the hand pushes on. Surface-constrained with tangential freedom, so
// deep immersion never takes its direction from a vanishing vector and the tool never sticks to a point. For any law
// and any head; the head and the shaft are two constraints, projected together. It turns as the hand turns.
//   depth at the hand <= h_max:  the proxy is the hand and the force is the law's alone.
//   deeper:  the proxy q waits at depth h_max, sliding to the place nearest the hand p, and
//            F = law(q) + k (q - p),  k the law's own slope at q: over flat bone force goes on with it at every depth.
// The two meet without a step, whichever way the hand goes and while the bone is carved away. Between walls that face
// each other the force fades instead of flipping. Frame P. Servo thread. At most kMaxEvaluations evaluations an update,
// one in steady sliding; a look is one contact sum for the head and one for a shaft. Not damping, not passivity, not
// limits.
#pragma once

#include "haptics/contact/law.h"
#include "haptics/tool/tool.h"

namespace haptics {

/// The proxy waits at half the head's thinnest radius, or less where a large head would otherwise swallow a plate of
/// bone of 0.6 mm, the thinnest that has to hold: at 85 % of the volume of such a plate through the head's middle.
double maxLawDepth_mm(const BurShape& head);

class Proxy {
 public:
  static constexpr int kMaxEvaluations = 6;

  struct State {
    calibration::Point<calibration::Patient> proxy_P;        ///< of T's origin
    Contact head, shaft;                                     ///< at the proxy, faded between facing walls
    calibration::Vector<calibration::Patient> stretch_P_mm;  ///< q - p: the spring between hand and proxy
    double spring_N_per_mm = 0.0;                            ///< k of that spring
    int evaluations = 0;                                     ///< how often the bone was asked

    bool touches() const { return head.depth_mm > 0.0 || shaft.depth_mm > 0.0; }
    /// The head where it touches, or else the shaft.
    const Contact& touching() const { return head.depth_mm > 0.0 ? head : shaft; }
    /// law(q) + k (q - p), head and shaft together; zero out of contact.
    calibration::Vector<calibration::Patient> force_P_N() const;
    /// About T's origin; the spring pulls through it.
    calibration::Vector<calibration::Patient> torque_P_Nmm() const;
    /// Never less than what contact and spring together could give back: k h^2 + F h is more than the energy of every
    /// law's curve up to h = R/2 (a straight one holds k h^2 / 2), also where opposing walls cancel its force.
    double maxStored_Nmm() const;
  };

  /// Moves the proxy towards the hand as far as the bone lets it. A law steeper than the limit is scaled down to it.
  State follow(const SolidField& field, const LawSettings& law, const Tool& tool,
               const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, const ToolMotion& motion,
               double max_stiffness_N_per_mm) noexcept;

  /// Lets the hand go through bone as if there were none: one look at it where the hand is, which tells depth and
  /// volume and holds nothing. Afterwards as after release().
  State passThrough(const SolidField& field, const LawSettings& law, const Tool& tool,
                    const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT,
                    const ToolMotion& motion) noexcept;

  /// Forgets where it was: the next follow() starts at the hand, wherever that is.
  void release() { placed_ = false; }

 private:
  calibration::Point<calibration::Patient> proxy_P_;
  Contact head_, shaft_;  ///< at proxy_P_, as they were last looked at
  LawState law_state_;
  LawKind last_law_ = LawKind::agus;
  BurShape last_head_;
  double unremembered_s_ = 0.0;
  double trust_ = 1.0;  ///< part of a bound step that is taken at once
  bool placed_ = false;
};

}  // namespace haptics
