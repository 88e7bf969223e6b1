// Cutting force of a turning bur (Arbabtafti et al., HAVE 2008, ToH 4(1) 2011; reference/physics 1.5): every element db
// of a flute cuts a chip of thickness t and drags its edge through the bone,
//   dF_t = (K_tc t + K_te) db,  dF_r = (K_rc t + K_re) db,  dF_a = (K_ac t + K_ae) db,   t = max(0, f . n),
// f the feed per tooth, n out of the head, t against the flute's motion, r into the head, a along the flute to the
// shaft. Averaged over a revolution: F = N / (2 pi) sum rho (..) dA / |r x axis| over the surface in bone, rho solid x
// tissue. Any body of revolution. The mean is force_P_N; the rotating part is vibration_P_N. At rest a wall, a
// potential:
//   F = -k_s grad V,  k_s = N K_re / (2 pi R), faded in as the spindle slows below `slowest_cut_rpm`.
// Frame P; mm, N, s. Servo thread; about 400 samples of the field a call, besides one overlap sum.
#pragma once

#include "haptics/contact/contact.h"

namespace haptics {

/// Defaults: a round bone bur, calibrated to 2 N at R = 1 mm, 0.5 mm deep, 40,000 rpm, 1 mm/s (reference/physics 6).
/// K_c: 0.03-0.15 J/mm3 at chips above 10 um; thrust of edges 1.7-2.5 times their drag (reference/physics 4).
struct MachiningParameters {
  double chip_tangential_N_per_mm2 = 100.0;  ///< K_tc, the specific cutting energy u: 100 N/mm2 = 0.1 J/mm3
  double chip_radial_N_per_mm2 = 50.0;       ///< K_rc
  double chip_axial_N_per_mm2 = 0.0;         ///< K_ac: no helix
  double edge_tangential_N_per_mm = 0.25;    ///< K_te: friction and ploughing, dominant for thin chips
  double edge_radial_N_per_mm = 0.5;         ///< K_re
  double edge_axial_N_per_mm = 0.0;          ///< K_ae
  double flutes = 8.0;                       ///< N
  double thickest_chip_mm = 0.005;           ///< limit of t: a full flute only rubs
  double slowest_cut_rpm = 1000.0;           ///< below it cutting fades into the wall
  double worn = 0.0;                         ///< 0 a new bur .. 1 edge forces three times as large
  double vibration_share = 0.05;             ///< of the force, at most 0.1 and 0.3 N (reference/devices 6)
};

Contact machiningContact(const MachiningParameters& parameters, const ToolInBone& at) noexcept;

/// Solid swept by the head's surface per second: sum rho (v . n)+ dA; the limit of the machining erosion
/// (bone/erosion_step).
double sweptRate_mm3_per_s(const ToolInBone& at) noexcept;

/// Torque of the bone on the spindle against its rotation, N mm, from a contact of this law; 0 at rest.
double spindleTorque_Nmm(const Contact& contact, const ToolInBone& at) noexcept;

}  // namespace haptics
