// forssim's law: force proportional to the shared volume, F = P V / R^3 n (Forsslund et al. 2009;
// reference/physics 1.2), with the exact lens of every voxel weighted by solid fraction and tissue. R is the bur's
// largest radius, for any shape. Steepest at h = R: pi P / R, so a small bur needs a small P. Optional hold, as
// published: when more than `hold_from` of the bur is immersed, a spring to the position x + F/k of that moment, until
// less than `hold_until` is immersed and that position is nearer than 2 mm. With the servo's proxy the bur does not get
// that deep. Frame P; mm, N. Servo thread; one overlap sum.
#pragma once

#include "haptics/contact/contact.h"
#include "haptics/contact/law_state.h"

namespace haptics {

struct ForssimParameters {
  double force_constant_N = 0.8;  ///< P; 0.8 N fills a Touch's 3.3 N when the bur is wholly immersed (P 4 pi/3)
  double hold_N_per_mm = 0.0;     ///< spring of the hold, published 1 N/mm; 0: no hold
  double hold_from = 0.45;        ///< immersed fraction that starts the hold
  double hold_until = 0.40;       ///< immersed fraction below which it may end
};

Contact forssimContact(const ForssimParameters& parameters, const ToolInBone& at, const LawState& state) noexcept;

/// Starts or ends the hold, from the last evaluation of a tick.
void updateForssimState(const ForssimParameters& parameters, const ToolInBone& at, const Contact& contact,
                        LawState& state) noexcept;

}  // namespace haptics
