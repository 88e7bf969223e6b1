// Dry friction between an elevator's blade and what it presses on, by regions of the blade: the four quadrants about
// its shaft, each against obstacles and against the piece. A region sticks by a tangential spring, whose force ends at
// mu times the normal force of the tick before; what it has slid beyond that is lost. Springs act at the middle of the
// region's pressure, which may move on without work. Frames P, T; mm, N. Servo thread; plain values. mu and stiffness:
// reference/extraction 4.3, our defaults.
#pragma once

#include <array>
#include <span>

#include "haptics/ligament/blade_contact.h"
#include "haptics/ligament/elevator_law.h"

namespace haptics {

struct BladeFriction {
  static constexpr std::size_t kRegions = 8;

  struct Region {
    double normal_N = 0.0;         ///< 0: nothing is touched
    glm::dvec3 at_T_mm{0.0};       ///< middle of the pressure
    glm::dvec3 out{0.0};           ///< unit; of P, or of Q against the piece
    glm::dvec3 stretched_mm{0.0};  ///< of the spring, across `out`, in the same frame
  };
  std::array<Region, kRegions> region{};

  static bool isAgainstPiece(std::size_t n) { return n >= kRegions / 2; }

  /// Since a tick began at start_X_PT, start_X_PQ. Returns the energy in the springs.
  double add(const ElevatorLaw& law, const ToolPose& start_X_PT, const PiecePose& start_X_PQ, const ToolPose& X_PT,
             const PiecePose& X_PQ, const glm::dvec3& middle_T_mm, const glm::dvec3& centre_Q_mm,
             PairBalance& balance) const noexcept;
  /// As the tick ends.
  void slide(const ElevatorLaw& law, const ToolPose& start_X_PT, const PiecePose& start_X_PQ, const ToolPose& X_PT,
             const PiecePose& X_PQ, std::span<const BladeContact> pressing) noexcept;

 private:
  glm::dvec3 stretch_P_mm(std::size_t n, const ToolPose& start_X_PT, const PiecePose& start_X_PQ, const ToolPose& X_PT,
                          const PiecePose& X_PQ, glm::dvec3& out_P) const noexcept;
};

}  // namespace haptics
