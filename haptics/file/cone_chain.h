// A cone of gutta-percha as a chain of links: round, without flutes, so soft that it bends under its own push, never
// breaks nor keeps a set in here. E 100 N/mm2, Poisson's ratio 0.45: our default, in the order of what is told of
// gutta-percha for root fillings at room temperature (unverified); friction on a wall with sealer and the stiffness of
// its side, which yields where it is wedged: our defaults. mm, N. Plain values; any thread.
#pragma once

#include "assets/instrument/gutta_percha_cone.h"
#include "haptics/file/file_chain.h"
#include "haptics/file/file_law.h"

namespace haptics {

inline constexpr double kGuttaPercha_N_per_mm2 = 100.0, kGuttaPerchaPoisson = 0.45;
inline constexpr double kConeFriction = 0.2, kConeSide_N_per_mm3 = 500.0;

FileChain coneChain(const assets::GuttaPerchaCone& cone, std::size_t links);

/// The same friction along and around: no edge screws it in.
FileLaw coneLaw();

}  // namespace haptics
