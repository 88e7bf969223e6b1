// Soft tissue against the whole instrument (head, shaft, handpiece): a weak wall. The instrument as held is the pose
// nearest to the hand at which no ball of its outline is inside the tissue; it is what is drawn, and what bone contact
// starts from. It slides along the tissue without friction and gives way by shifting and by tilting about the bur:
//   D = hypot(|u|, L |t|)   u: shift of T's origin, t: rotation vector, from the hand to the held pose; L = 40 mm
//   F = f u / D,  M = f L^2 t / D,  f = F_max (1 - exp(-k D / F_max)) - b v, never below 0: it does not pull
// The held pose depends on the way of the hand, so f has an account of its own (spring_account.h) and never gives back
// more than the hand has put in.
// Zero and exactly the hand's pose outside. k = 0.25 N/mm, F_max = 0.8 N: our choice for a device of 3 N. A lip or
// cheek of 8 mm thickness and E = 10 to 40 kPa under a rod of 1 to 4 mm gives k = 2 E a / (1 - nu^2) (flat punch,
// Sneddon 1965) of 0.03 to 0.4 N/mm; gingiva is stiffer, and lies on bone that is felt as such.
// A turning bur cuts soft tissue: its head is not held. Tissue in which the instrument is placed (start, change of
// tool, a jump) does not push it; it holds again what has left it. Frame P; mm, N, s. Servo thread, no allocation. At
// most 4 steps of 3 sweeps over at most 80 balls; out of reach one look-up a ball: 1.7 us free, 20 us
// held (haptics_servo_bench soft). Not a physical deformation.
#pragma once

#include <array>
#include <cstdint>

#include "assets/soft_tissue_field.h"
#include "haptics/contact/soft_touch.h"
#include "haptics/servo/spring_account.h"
#include "haptics/tool/instrument_outline.h"

namespace haptics {

struct SoftHoldLaw {
  static constexpr double kStiffness_N_per_mm = 0.25, kMaxForce_N = 0.8, kDamping_Ns_per_mm = 0.0008;
  static constexpr double kLever_mm = 40.0;  ///< L: how much a tilt weighs against a shift
};

class SoftHold {
 public:
  using ToolPose = calibration::Pose<calibration::Patient, calibration::Tool>;

  struct State {
    ToolPose X_PT;  ///< as held; the hand's where nothing is touched
    SoftTouch touch;
    double max_stored_Nmm = 0.0;  ///< upper bound of the energy the tissue could give back
  };

  /// `turning`: the bur turns. `passable`: tissues that give way without force (assets::bitOf). `tool` sanitised,
  /// `X_PT` finite. A field of null or without values: the hand's pose.
  State update(const assets::SoftTissueField* field, const Tool& tool, const ToolPose& X_PT,
               const calibration::Vector<calibration::Patient>& velocity_P_mm_per_s, bool turning,
               std::uint8_t passable = 0) noexcept;

  /// The next update() starts at the hand, whatever is there.
  void release() { placed_ = false; }

 private:
  struct Contact {
    std::size_t ball = 0;
    double push_mm = 0.0;
    glm::dvec3 normal_P{0.0};
  };

  void place(const assets::SoftTissueField& field, const Tool& tool, const ToolPose& X_PT) noexcept;
  bool isFree(const assets::SoftTissueField& field, const ToolPose& X_PT, bool turning) const noexcept;
  void moveTowards(const ToolPose& X_PT) noexcept;
  Contact pushOut(const assets::SoftTissueField& field, bool turning) noexcept;
  SoftTouch touched(const assets::SoftTissueField& field, const Contact& most, bool turning) noexcept;
  void push(State& state, const ToolPose& X_PT, const calibration::Vector<calibration::Patient>& velocity_P_mm_per_s,
            const Contact& most) noexcept;
  double lastWork_Nmm(const ToolPose& X_PT) const noexcept;
  void settle(const ToolPose& X_PT, const SoftTouch& touch, double deflection_mm) noexcept;
  glm::dvec3 centre_P(const ToolPose& X_PT, std::size_t ball) const noexcept {
    return X_PT.translation_mm + X_PT.rotation * glm::dvec3(0.0, 0.0, outline_.balls[ball].z_mm);
  }

  /// Gum that a turning head cuts is told, also where it holds nothing.
  bool givesWay(assets::SoftTissue tissue, bool is_cut) const noexcept {
    return assets::contains(passable_, tissue) && !(is_cut && tissue == assets::SoftTissue::gingiva);
  }

  Tool tool_;
  std::uint8_t passable_ = 0;
  InstrumentOutline outline_;
  std::array<double, InstrumentOutline::kMaxBalls> buried_mm_{};  ///< a ball may be this deep inside
  ToolPose held_;
  bool placed_ = false;
  SpringAccount account_{SoftHoldLaw::kStiffness_N_per_mm, SoftHoldLaw::kMaxForce_N};
  ToolPose last_X_PT_;  ///< the hand's, and what was felt there
  calibration::Vector<calibration::Patient> last_force_N_, last_torque_Nmm_;
};

}  // namespace haptics
