// forssim's law: force with the volume that bur and bone share, F = P V / R^3 n (Forsslund et al. 2009;
// reference/physics 1.2), as its equations say: the exact lens of every voxel, weighted by how solid it is and by its
// tissue. Frame P; mm, N. R is the bur's largest radius, whatever its shape. Stiffest at h = R: pi P / R, so a small
// bur needs a small P. Optional hold, as published: when more than `hold_from` of the bur is immersed, a spring to the
// place x + F/k of that moment, until less than `hold_until` is immersed and the place is nearer than 2 mm. It sticks
// to a point; the servo's proxy does that work without, and never lets the bur so deep. Servo thread; one overlap sum.
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

/// Starts or ends the hold, by the last look of a tick.
void updateForssimState(const ForssimParameters& parameters, const ToolInBone& at, const Contact& contact,
                        LawState& state) noexcept;

}  // namespace haptics
