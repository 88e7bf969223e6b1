// What an elevator's blade does in a tick: the piece it works on, the torque of the hand and the forces by what they
// press on; part of the Tick. Of the model: a device feels LedTool::kForceScale times less. Frame P; mm, N,
// N mm.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace haptics {

struct Levering {
  std::uint8_t piece = 0;        ///< 1 + the piece that the blade works on; 0: none
  double twist_Nmm = 0.0;        ///< of the hand on the blade, about its shaft
  double on_bone_N = 0.0;        ///< of the blade, normal forces: on the jaw and other pieces of the tooth
  double on_teeth_N = 0.0;       ///< on other teeth
  double on_piece_N = 0.0;       ///< on the piece that it works on
  double wedging_N = 0.0;        ///< drives the walls of a slot apart
  glm::dvec3 fulcrum_P_mm{0.0};  ///< middle of what presses on bone and other teeth, if anything does

  bool operator==(const Levering&) const = default;

  static constexpr double kFulcrum_N = 5.0, kFulcrumShare = 0.2;
  /// Other teeth carry enough of the blade to be its fulcrum (reference/extraction 5.3; our default).
  bool restsOnTeeth() const {
    return on_teeth_N > kFulcrum_N && on_teeth_N > kFulcrumShare * (on_bone_N + on_teeth_N + on_piece_N);
  }
};

}  // namespace haptics
