// Forceps: beaks that close on a piece of tooth with the pedal and move it by the hand, through a spring. What holds
// the piece is its ligament and what is around it (ligament/piece_hold). A hand moves a tooth with a hundred newtons, a
// device with two: the spring is kForceScale times as stiff as what is felt. While it holds, the tool is where the
// piece has it, not where the hand is. A piece let go of with its ligament torn and kClear_mm out of its place is set
// aside. Each grip is a stroke (servo/luxation_strokes). Frame P; N, N mm of the model unless said. Servo thread; no
// allocation, no throw; 20 to 80 us while a piece is held, else nothing.
#pragma once

#include "haptics/servo/piece_sites.h"
#include "haptics/tool/tool.h"
#include "haptics/wrench.h"

namespace haptics {

struct ForcepsLaw {
  /// Model N per N that is felt: 165 N at the 3.3 N of a Touch, what hands reach in extractions (reference/extraction
  /// 1.2). Our default.
  static constexpr double kForceScale = 50.0;
  static constexpr double kSpring_N_per_mm = 25.0;       ///< 0.5 N/mm are felt
  static constexpr double kSpring_Nmm_per_rad = 8000.0;  ///< reference/extraction 5.2
  static constexpr double kMost_N = 165.0;
  static constexpr double kMost_Nmm = 3000.0;  ///< about what a handle of forceps gives. Our default
  static constexpr double kClear_mm = 6.0;
  static constexpr double kAllTorn = 0.999;  ///< of the ligament: the piece is loose
};

class Forceps {
 public:
  using ToolPose = calibration::Pose<calibration::Patient, calibration::Tool>;

  /// What a tick of holding did.
  struct Held {
    bool holds = false;
    std::size_t piece = 0;
    ToolPose X_PT;                          ///< of the tool as the piece has it
    Wrench<calibration::Patient> felt{};    ///< on the hand, about T's origin, scaled down
    double max_stored_Nmm = 0.0;            ///< in what is felt
    Wrench<calibration::Patient> on_piece;  ///< model
    double torn_share = 0.0;                ///< of the ligament of the piece held, or last held
    bool unsettled = false;
    bool set_aside = false;  ///< a piece, in this tick
  };

  /// With nothing held. `beaks`: the tool at the proxy, which grips what is within `radius_mm`; `hand`: where the hand
  /// is. `closed`: the pedal holds forceps closed. True: from now on a piece is held.
  bool grip(const Bodies& bodies, const PieceSites& sites, double radius_mm, const ToolPose& beaks_X_PT,
            const ToolPose& hand_X_PT, bool closed) noexcept;
  /// Moves the piece that is held, if any, or lets go of it.
  void move(Bodies& bodies, PieceSites& sites, const ToolPose& hand_X_PT, bool closed, double dt_s) noexcept;

  bool holds() const { return held_.holds; }
  /// Of the last step.
  const Held& held() const { return held_; }
  /// Pieces were put back.
  void lookAgain(const Bodies& bodies, const PieceSites& sites) noexcept {
    held_.torn_share = sites.tornShare(bodies, held_.piece);
  }

 private:
  std::size_t pieceAt(const Bodies& bodies, const PieceSites& sites, double radius_mm,
                      const ToolPose& X_PT) const noexcept;
  void letGo(Bodies& bodies, PieceSites& sites) noexcept;

  Held held_;
  calibration::Pose<calibration::Piece, calibration::Tool> grip_X_QT_;
  calibration::Pose<calibration::Tool, calibration::Tool> slack_;  ///< of the beaks in the hand when they closed
  bool was_closed_ = false;
};

}  // namespace haptics
