// What a K-file's wire does: stiffness of a section in bending and torsion, where the metal gives, where it breaks.
// Square: I = D^4/48, J = 0.0351 D^4; triangle: I = D^4/98.5, J = 0.01218 D^4; D the circle around it, alike in every
// direction. Steel: E 193, G 75 GPa; elastic to 3 % of strain, then keeps a set. Nickel-titanium: E 36, G 13.5 GPa, a
// plateau at 450 MPa (superelastic, without the loss between loading and unloading), no set. Breaks in torsion at T =
// 0.0735 tau D^3, tau 1.26 GPa (fits the least torques of ADA 28); in bending after N = (e_f/e)^2 turns of strain e.
// Elastic moduli of nickel-titanium, plateau and e_f are unverified. N, mm. Pure; any thread.
#pragma once

#include "assets/instrument/k_file.h"

namespace haptics {

struct FileMetal {
  double young_N_per_mm2, shear_N_per_mm2;
  double plateau_N_per_mm2;  ///< 0: none
  double plateau_share;      ///< of the slope that is left on it
  double set_strain;         ///< of the outer fibre, beyond which a set stays; 0: never
  double fatigue_strain;
  double torsion_N_per_mm2;
};

constexpr FileMetal fileMetal(assets::KFileMetal metal) {
  return metal == assets::KFileMetal::steel ? FileMetal{193e3, 75e3, 0.0, 1.0, 0.03, 0.3, 1260.0}
                                            : FileMetal{36e3, 13.5e3, 450.0, 0.08, 0.0, 1.0, 1260.0};
}

struct FileSection {
  double bending_mm4, torsion_mm4, plastic_mm3, area_mm2;
};

/// Of the circle around it. Plastic moment of area: of a square about its diagonal, and of a triangle.
constexpr FileSection fileSection(assets::KFileSection form, double diameter_mm) {
  const double d3 = diameter_mm * diameter_mm * diameter_mm, d4 = d3 * diameter_mm;
  return form == assets::KFileSection::square
             ? FileSection{d4 / 48.0, 0.0351 * d4, d3 / 12.0, 0.5 * diameter_mm * diameter_mm}
             : FileSection{d4 / 98.534, 0.012178 * d4, d3 * 0.0476, 0.325 * diameter_mm * diameter_mm};
}

constexpr double breakingTorque_Nmm(const FileMetal& metal, double diameter_mm) {
  return 0.0735 * metal.torsion_N_per_mm2 * diameter_mm * diameter_mm * diameter_mm;
}

/// Turns at a constant strain of the outer fibre until it breaks.
constexpr double turnsToBreak(const FileMetal& metal, double strain) {
  return metal.fatigue_strain * metal.fatigue_strain / (strain * strain);
}

}  // namespace haptics
