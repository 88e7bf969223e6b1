// What a root-canal file did in a tick: where it lies, what its walls and its metal bear, what it took. Part of a Tick.
// Frame P; mm, N, N mm. Plain values of fixed size; any thread.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/file/file_chain.h"

namespace haptics {

enum class FileStay : std::uint8_t {
  none = 0,     ///< no file in the hand
  free = 1,     ///< it meets nothing
  wall = 2,     ///< it lies against a wall
  through = 3,  ///< put into the tooth by an undo or a jump of the hand: without force until it is out
};

struct FileWork {
  FileStay stay = FileStay::none;
  glm::dvec3 tip_P_mm{0.0}, tip_axis_P{0.0, 0.0, -1.0};
  double normal_N = 0.0;            ///< sum over all sections
  double torque_Nmm = 0.0;          ///< of the hand on the file, about its axis
  double torque_share = 0.0;        ///< largest of torque over breaking torque
  double strain = 0.0;              ///< largest of the outer fibre
  double strain_from_tip_mm = 0.0;  ///< where
  double damage = 0.0;              ///< largest, by bending in turn; breaks at 1
  double windup_rad = 0.0;          ///< of the handle ahead of the tip
  double roll_rad = 0.0;            ///< of the handle as the fingers hold it, since the file was taken up
  double axial_N_per_mm = 0.0;      ///< at the handle; negative: it buckles
  double stop_N = 0.0;              ///< of the rubber stop on the tooth
  double due_total_mm3 = 0.0;       ///< of wear, of all files since the start
  double removed_total_mm3 = 0.0;   ///< from the wall, the same
  double broken_from_tip_mm = 0.0;  ///< of the whole file, in the tick in which it breaks; else 0
  double left_mm = 0.0;             ///< length of the file in the hand
  double flutes_full = 0.0;         ///< share of the fullest section's flutes; 1: it takes nothing there
  double sharpness = 1.0;           ///< of its edges, 1 when new
  double debris_mm3 = 0.0;          ///< chips that are not out of the canals: loose, and in its flutes
  std::uint8_t fragments = 0;       ///< of separated files in the tooth; also told while no file is held
  bool keeps_bend = false;          ///< steel bent too far in this tick
  bool unsettled = false;           ///< not at rest within a tick's steps
  /// Nodes from the handle to the tip, for the picture; a replay makes them again. In the tick in which it breaks still
  /// those of the whole file.
  std::array<glm::vec3, kUsualLinks + 1> node_P_mm{};
  std::array<float, kUsualLinks + 1> link_share{};  ///< of torque over breaking torque, of the link before each node
};

}  // namespace haptics
