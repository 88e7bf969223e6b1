// A tool that is led: forceps by the piece they hold, an elevator by what its blade meets. It is drawn and felt where
// it was led to, not where the hand is. A hand moves a tooth with a hundred newtons, a device with two:
// what moves the piece is kForceScale times as stiff as what is felt. Frame P; N, N mm of the model unless said. Plain
// values.
#pragma once

#include <cstddef>

#include "haptics/ligament/hand_coupling.h"
#include "haptics/servo/levering.h"
#include "haptics/wrench.h"

namespace haptics {

struct LedTool {
  /// Model N per N that is felt: 165 N at the 3.3 N of a Touch, what hands reach in extractions (reference/extraction
  /// 1.2). Our default.
  static constexpr double kForceScale = 50.0;

  bool leads = false;                      ///< the rest but torn_share is of a tick in which it did
  bool holds = false;                      ///< a piece moves with it
  std::size_t piece = 0;                   ///< this one; of an elevator that holds none, the nearest
  ToolPose X_PT;                           ///< of the tool as the piece has it
  Wrench<calibration::Patient> felt{};     ///< on the hand, about T's origin, scaled down
  double max_stored_Nmm = 0.0;             ///< in what is felt
  Wrench<calibration::Patient> gripped{};  ///< of forceps on the piece, about T's origin
  Levering lever;                          ///< of an elevator
  double torn_share = 0.0;                 ///< of the ligament of this piece, or the last one
  bool unsettled = false;
  bool set_aside = false;  ///< a piece, in this tick
};

}  // namespace haptics
