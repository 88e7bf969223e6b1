// The selected force law and the parameters of all laws, so that switching back restores them. Trivially copyable, part
// of a Command; may change every tick. Ranges, units and sources: law_parameters.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/contact/agus.h"
#include "haptics/contact/contact.h"
#include "haptics/contact/forssim.h"
#include "haptics/contact/harmonic.h"
#include "haptics/contact/hertz.h"
#include "haptics/contact/machining.h"
#include "haptics/contact/points.h"
#include "haptics/contact/shell.h"
#include "haptics/tool/parameter_table.h"

namespace haptics {

enum class LawKind : std::uint8_t { agus, forssim, hertz, shell, points, machining, harmonic };

struct LawSettings {
  LawKind kind = LawKind::agus;
  double damping_Ns_per_mm = 0.0;  ///< every law: F -= b v while in contact; b >= 0
  TissueStiffness tissue;
  AgusParameters agus;
  ForssimParameters forssim;
  HertzParameters hertz;
  ShellParameters shell;
  PointsParameters points;
  MachiningParameters machining;
  HarmonicParameters harmonic;
};

using LawName = LawEntry<LawKind>;
inline constexpr std::array<LawName, 7> kLaws = {{
    {LawKind::agus, "agus", "F = k h", "the default: one stiffness for every bur and depth"},
    {LawKind::forssim, "forssim", "F = P V / R^3",
     "comparison with the published oral-surgery simulator; soft first touch"},
    {LawKind::hertz, "hertz", "F = C1 R^1/2 h^3/2", "an elastic ball: soft first touch that stiffens"},
    {LawKind::shell, "shell", "F = -k_s grad V", "crisp first touch; conservative"},
    {LawKind::points, "points", "F = k rho d0 u^(1/m)", "any head as a cloud of points; density in the stiffness"},
    {LawKind::machining, "machining", "dF = (K_tc t + K_te) db", "cutting forces of a turning bur, mean and vibration"},
    {LawKind::harmonic, "harmonic", "F = k h, U = sum rho k / (2 pi r)", "linear, unbiased and exactly conservative"},
}};

/// Whether the law is defined for this shape; otherwise contactOf is zero.
constexpr bool supports(LawKind law, ShapeKind shape) { return law != LawKind::harmonic || shape == ShapeKind::sphere; }

}  // namespace haptics
