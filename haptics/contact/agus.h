// Agus's law: the force of bone on a bur from the volume they share (Agus et al., IEEE VR 2002; Presence 12(1), 2003;
// reference/physics 1.1):  F = k f h n, with h, n, f of contact/immersion. Frame P; mm, N; the force acts on the hand.
// Without proxy (servo/proxy) and limits (safety/safety_filter). One overlap sum a call. Any thread; any shape.
#pragma once

#include "haptics/contact/contact.h"

namespace haptics {

struct AgusParameters {
  double stiffness_N_per_mm = 0.8;  ///< F = k h; 0.8 N/mm feels hard at 1 kHz and stays passive (reference/physics 6)
};

Contact agusContact(const AgusParameters& parameters, const ToolInBone& at) noexcept;

}  // namespace haptics
