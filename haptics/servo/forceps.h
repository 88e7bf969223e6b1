// Forceps: beaks that close on a piece of tooth with the pedal and move it by the hand, through a spring. What holds
// the piece is its ligament and what is around it (ligament/piece_hold). A hand moves a tooth with a hundred newtons, a
// device with two: the spring is kForceScale times as stiff as what is felt. While it holds, the tool is where the
// piece has it, not where the hand is. A piece let go of with its ligament torn and kClear_mm out of its place is set
// aside. Frame P; N, N mm of the model unless said. Servo thread; no allocation, no throw; 20 to 80 us while a piece is
// held, and for kSettle_s after, else nothing.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/body/bodies.h"
#include "haptics/ligament/piece_site.h"
#include "haptics/tool/tool.h"
#include "haptics/wrench.h"

namespace haptics {

/// Part of the Command: a piece made ready to be gripped. The site is not recorded: it follows from the bodies.
struct SiteOrder {
  std::uint64_t serial = 0;         ///< rises by one for every site
  std::uint64_t bodies_digest = 0;  ///< Bodies::digest() of what it was made from
  std::uint64_t piece = 0;
  PieceSite* site = nullptr;  ///< the servo's from now on, until a later one of this piece was taken over
};

enum class SiteAnswer : std::uint8_t {
  none = 0,
  ready = 1,
  refused = 2,  ///< the bodies have changed since, or a piece is held
};

struct ForcepsLaw {
  /// Model N per N that is felt: 165 N at the 3.3 N of a Touch, what hands reach in extractions (reference/extraction
  /// 1.2). Our default.
  static constexpr double kForceScale = 50.0;
  static constexpr double kSpring_N_per_mm = 25.0;       ///< 0.5 N/mm are felt
  static constexpr double kSpring_Nmm_per_rad = 8000.0;  ///< reference/extraction 5.2
  static constexpr double kMost_N = 165.0;
  static constexpr double kMost_Nmm = 3000.0;  ///< about what a handle of forceps gives. Our default
  static constexpr double kClear_mm = 6.0;
  static constexpr double kSettle_s = 0.3;  ///< a piece let go of springs back and rests
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
    double torn_Nmm = 0.0;                  ///< of all pieces, in this tick
    double torn_share = 0.0;                ///< of the ligament of the piece held, or last held
    bool unsettled = false;
    bool set_aside = false;  ///< a piece, in this tick
  };

  /// First in a tick: an order holds for the bodies as they are then, or not at all.
  void receive(const Bodies& bodies, const SiteOrder& order) noexcept;

  /// `beaks`: the tool at the proxy, which grips what is within `radius_mm`; `hand`: where the hand is. `closed`: the
  /// pedal holds forceps closed. Moves pieces.
  void step(Bodies& bodies, double radius_mm, const ToolPose& beaks_X_PT, const ToolPose& hand_X_PT, bool closed,
            double dt_s) noexcept;

  bool holds() const { return held_.holds; }
  /// Of the last step.
  const Held& held() const { return held_; }
  /// A part of `from` becomes piece `to`: as much of its ligament is torn.
  void part(std::size_t from, std::size_t to) noexcept;
  /// Of the newest order.
  SiteAnswer answer() const { return answer_; }

 private:
  std::size_t pieceAt(const Bodies& bodies, double radius_mm, const ToolPose& X_PT) const noexcept;
  void letGo(Bodies& bodies) noexcept;

  bool isReady(const Bodies& bodies, std::size_t piece) const noexcept;

  std::array<PieceSite*, kMaxPieces> sites_{};
  /// Bodies::digestWithoutPose() of each when its site was taken over: it holds for these.
  std::array<std::uint64_t, kMaxPieces> made_of_{};
  std::array<double, kMaxPieces> torn_share_{};  ///< of a piece without a site yet
  std::array<double, kMaxPieces> settling_s_{};  ///< left for a piece that was let go of
  SiteOrder order_;
  SiteAnswer answer_ = SiteAnswer::none;
  Held held_;
  calibration::Pose<calibration::Piece, calibration::Tool> grip_X_QT_;
  calibration::Pose<calibration::Tool, calibration::Tool> slack_;  ///< of the beaks in the hand when they closed
  bool was_closed_ = false;
};

}  // namespace haptics
