// Input and output of a force law. One Contact is one evaluation with the tool at rest at X_PT; proxy, damping and
// limits come later (servo, safety). Frame P; mm, N, N mm; forces act on the hand. Servo thread.
#pragma once

#include <array>

#include "assets/tissue.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/body/solid_bodies.h"
#include "haptics/tool/bur_shape.h"

namespace haptics {

/// Stiffness of each tissue relative to cortical bone. Multiplies a law's stiffness, voxel by voxel.
struct TissueStiffness {
  std::array<double, assets::kTissueCount> factor = [] {
    std::array<double, assets::kTissueCount> known{};
    for (std::size_t i = 0; i < known.size(); ++i) known[i] = assets::kTissues[i].stiffness_factor;
    return known;
  }();

  double of(std::uint8_t label) const { return factor[label < assets::kTissueCount ? label : 0]; }
};

struct ToolMotion {
  calibration::Vector<calibration::Patient> velocity_P_mm_per_s;  ///< of T's origin
  double spindle_rad_per_s = 0.0;                                 ///< about +z of T; 0: not turning
  double dt_s = 1e-3;
  double vibration_phase_rad = 0.0;  ///< phase of the vibration (tool/spindle)
};

/// Tool, pose and motion among solid bodies.
struct ToolInBone {
  SolidBodies bodies;
  BurShape head;
  calibration::Pose<calibration::Patient, calibration::Tool> X_PT;
  const TissueStiffness& tissue;
  ToolMotion motion;
};

struct Contact {
  calibration::Vector<calibration::Patient> force_P_N;      ///< without damping; zero out of contact
  calibration::Vector<calibration::Patient> torque_P_Nmm;   ///< about T's origin
  calibration::Vector<calibration::Patient> vibration_P_N;  ///< averages to zero over a revolution
  calibration::Vector<calibration::Patient> normal_P;       ///< out of the bone; shorter than 1 between walls
  double depth_mm = 0.0;                                    ///< in flat bone with the same overlap; 0: none
  double stiffness_N_per_mm = 0.0;                          ///< dF/ddepth, tissue included: the proxy's spring
  double volume_mm3 = 0.0;                                  ///< shared by head and solid
  double tissue_factor = 1.0;                               ///< mean stiffness factor of the tissue in contact
  double one_sided = 1.0;  ///< first moment, relative to flat bone of this depth: 1 flat, 2/3 in a socket, 0 in a slot
};

}  // namespace haptics
