// Forceps: beaks that close on a piece of tooth with the pedal and move it by the hand, through a spring. What holds
// the piece is its ligament and what is around it (ligament/piece_hold). Each grip is a stroke
// (servo/luxation_strokes). Frame P; N, N mm of the model unless said. Servo thread; no allocation, no throw; 20 to 80
// us while a piece is held, else nothing.
#pragma once

#include "haptics/servo/led_tool.h"
#include "haptics/servo/piece_sites.h"

namespace haptics {

struct ForcepsLaw {
  static constexpr double kSpring_N_per_mm = 25.0;       ///< 0.5 N/mm are felt
  static constexpr double kSpring_Nmm_per_rad = 8000.0;  ///< reference/extraction 5.2
  static constexpr double kMost_N = 165.0;
  static constexpr double kMost_Nmm = 3000.0;  ///< about what a handle of forceps gives. Our default
};

class Forceps {
 public:
  /// With nothing held. `beaks`: the tool at the proxy, which grips what is within `radius_mm`; `hand`: where the hand
  /// is. `closed`: the pedal holds forceps closed. True: from now on a piece is held.
  bool grip(const Bodies& bodies, const PieceSites& sites, double radius_mm, const ToolPose& beaks_X_PT,
            const ToolPose& hand_X_PT, bool closed, LedTool& held) noexcept;
  /// Moves the piece that is held, or lets go of it.
  void move(Bodies& bodies, PieceSites& sites, const ToolPose& hand_X_PT, bool closed, double dt_s,
            LedTool& held) noexcept;

 private:
  std::size_t pieceAt(const Bodies& bodies, const PieceSites& sites, double radius_mm,
                      const ToolPose& X_PT) const noexcept;

  calibration::Pose<calibration::Piece, calibration::Tool> grip_X_QT_;
  calibration::Pose<calibration::Tool, calibration::Tool> slack_;  ///< of the beaks in the hand when they closed
  bool was_closed_ = false;
};

}  // namespace haptics
