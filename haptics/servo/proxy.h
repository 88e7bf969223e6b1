// The proxy: where the surface holds the bur while the hand pushes on. Surface-constrained with tangential freedom, so
// deep immersion never takes its direction from a vanishing vector and the bur never sticks to a point.
//   depth at the hand <= h_max:  the proxy is the hand and the law is Agus's alone.
//   deeper:  the proxy q waits at depth h_max, sliding to the place nearest the hand p, and
//            F = k h(q) n(q) + k (q - p),  which over flat bone is k H for every depth H of the hand.
// The two meet without a step, whichever way the hand goes and while the bone is carved away. Between walls that face
// each other the direction fades instead of flipping. Frame P. Servo thread. At most kMostSums overlap sums an update.
// Not damping, not limits (servo/safety).
#pragma once

#include "haptics/contact/agus.h"

namespace haptics {

/// The proxy waits at half a radius, or less where a large bur would otherwise swallow a plate of bone of 0.6 mm, the
/// thinnest that has to hold: at 85 % of the volume of such a plate through the bur's centre.
double deepestPureContact_mm(double radius_mm);

class Proxy {
 public:
  static constexpr int kMostSums = 6;

  struct Held {
    calibration::Point<calibration::Patient> proxy_P;
    AgusContact contact;                                  ///< at the proxy
    calibration::Vector<calibration::Patient> pull_P_mm;  ///< q - p: the spring between hand and proxy
    int sums = 0;                                         ///< overlap sums spent
  };

  /// Moves the proxy towards the hand as far as the bone lets it.
  Held follow(const SolidField& field, const calibration::Point<calibration::Patient>& hand_P,
              double radius_mm) noexcept;

  /// Forgets where it was: the next follow() starts at the hand, wherever that is.
  void release() { placed_ = false; }

 private:
  calibration::Point<calibration::Patient> proxy_P_;
  AgusContact contact_;  ///< at proxy_P_, as it was last looked at
  bool placed_ = false;
};

/// k h n + k (q - p) - b v; zero out of contact.
calibration::Vector<calibration::Patient> heldForce_N(
    const Proxy::Held& held, const AgusParameters& parameters,
    const calibration::Vector<calibration::Patient>& velocity_P_mm_per_s) noexcept;

}  // namespace haptics
