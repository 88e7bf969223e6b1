// What breaks a bridge of tooth. To start, a break needs stress at the farthest edge of the section:
//   F n / A + M_u c_u / I_u + M_v c_v / I_v = 60 MPa          u along the width, v along the thickness
// to run on, the toughness of a section bent from the floor of a deep slot: 3.975 M_u / (b h^1.5) = 79 N/mm^1.5, with b
// the width and h = A / b. It breaks when both are reached. Enamel counts a third of dentine, by area. An elevator
// seated in the slot pushes its walls apart with F, kLever_mm above the floor: M_u = F (kLever_mm + h/2), and is
// twisted with F kBladeArm_mm. Bending about v is held against toughness alike with b and h exchanged (our default).
// N, mm, N mm. Any thread, the servo's too; some ten flops. Source: reference/extraction 1.3, 6.
#pragma once

#include "haptics/body/bridge.h"

namespace haptics {

struct DentineLimits {
  static constexpr double kStrength_N_per_mm2 = 60.0;  ///< tensile; our default within 40-105
  static constexpr double kToughness_N_per_mm15 = 79.0;
  static constexpr double kEnamelFactor = 1.0 / 3.0;
};

inline constexpr double kLever_mm = 1.6;            ///< half the width of a blade seated in the slot
inline constexpr double kBladeArm_mm = 2.95;        ///< w cos 11 deg - t sin 11 deg; blade 3.2 x 1.0, slot 1.6 mm
inline constexpr double kMostBreakable_mm2 = 40.0;  ///< half a neck; beyond, force goes elsewhere (our default)

/// What a bridge passes on from one part to the other.
struct BridgeLoad {
  double tension_N = 0.0;                           ///< along the normal; presses below 0
  double bending_u_Nmm = 0.0, bending_v_Nmm = 0.0;  ///< about the width axis, about the thickness axis; either sense
};

/// By an elevator that wedges the slot open.
BridgeLoad wedgedBy(const Bridge& bridge, double wedging_N);

/// 1 breaks it; scales with the load. `enamel_share` of the area. A bridge without area holds nothing: infinite.
double shareOfBreaking(const Bridge& bridge, double enamel_share, const BridgeLoad& load);

/// The wedging force at which an elevator breaks it, and the twist of the handle for it.
double breakingForce_N(const Bridge& bridge, double enamel_share);
double breakingTwist_Nmm(const Bridge& bridge, double enamel_share);

}  // namespace haptics
