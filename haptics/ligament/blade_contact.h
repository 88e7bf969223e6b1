// An elevator's blade against what it meets: balls along its edges against the field of all obstacles and against the
// piece's own field, and samples of the piece's surface against the blade's closed-form distance. Each pushes by its
// depth, as bare contact does (ligament_law.h). What could meet within a tick is found once, as it begins. Frames P, T,
// Q; mm, N. Servo thread; no allocation; 2 to 10 µs. A pure function. Reference/extraction 4, 5.1.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/body/distance_field.h"
#include "haptics/ligament/elevator_shape.h"
#include "haptics/ligament/hand_coupling.h"
#include "haptics/ligament/pair_balance.h"
#include "haptics/ligament/piece_samples.h"

namespace haptics {

/// What an elevator is among. Null: not there.
struct ElevatorScene {
  const DistanceField* obstacles = nullptr;  ///< jaw, its teeth, other pieces; frame P
  const DistanceField* teeth = nullptr;      ///< the jaw's teeth alone: what is a fulcrum on a neighbour
  const DistanceField* piece = nullptr;      ///< of the piece itself, frame Q
};

struct BladeContact {
  enum class On : std::uint8_t { bone, teeth, piece };  ///< bone: or another piece
  On on = On::bone;
  glm::dvec3 at_P_mm{0.0};
  glm::dvec3 out_P{0.0};  ///< pushes the blade
  double depth_mm = 0.0;  ///< above zero
  double N_per_mm = 0.0;
};

class BladeContacts {
 public:
  static constexpr double kPoint_N_per_mm = 200.0;  ///< of one ball. Our default
  static constexpr std::size_t kMostSamples = 384;  ///< of a piece near the blade; of more, the first

  /// What lies within kNear_mm of the blade at these poses; `samples` may be null.
  void find(const ElevatorShape& shape, const ElevatorScene& scene, const PieceSamples* samples,
            double contact_N_per_mm3, const ToolPose& X_PT, const PiecePose& X_PQ) noexcept;
  bool none() const noexcept { return against_obstacles_.count + against_piece_.count + near_samples_.count == 0; }

  /// visit(BladeContact) for each that presses.
  template <class Visit>
  void forEach(const ToolPose& X_PT, const PiecePose& X_PQ, const Visit& visit) const noexcept;
  /// Returns the energy in them.
  double add(const ToolPose& X_PT, const PiecePose& X_PQ, PairBalance& balance) const noexcept;

 private:
  static constexpr double kNear_mm = 0.8;

  template <std::size_t N>
  struct List {
    std::array<std::uint16_t, N> index{};
    std::size_t count = 0;
    void add(std::size_t n) noexcept {
      if (count < N) index[count++] = static_cast<std::uint16_t>(n);
    }
  };
  struct Around {
    double mm;
    glm::dvec3 out;
  };
  static Around around(const DistanceField& field, const glm::dvec3& p_mm) noexcept;
  glm::dvec3 sample_Q_mm(std::size_t n) const noexcept;
  bool isOnTeeth(const glm::dvec3& p_P_mm, double obstacle_mm) const noexcept;

  const ElevatorShape* shape_ = nullptr;
  ElevatorScene scene_;
  const PieceSamples* samples_ = nullptr;
  double contact_N_per_mm3_ = 0.0;
  List<ElevatorShape::kMostPoints> against_obstacles_, against_piece_;
  List<kMostSamples> near_samples_;
};

template <class Visit>
void BladeContacts::forEach(const ToolPose& X_PT, const PiecePose& X_PQ, const Visit& visit) const noexcept {
  using calibration::Patient;
  using calibration::Piece;
  using calibration::Point;
  using calibration::Tool;
  for (std::size_t n = 0; n < against_obstacles_.count; ++n) {
    const std::size_t point = against_obstacles_.index[n];
    const double radius_mm = shape_->point_radius_mm[point];
    const glm::dvec3 p_P_mm = (X_PT * Point<Tool>{shape_->point_T_mm[point]}).mm;
    const Around near = around(*scene_.obstacles, p_P_mm);
    if (near.mm >= radius_mm) continue;
    const bool on_teeth = isOnTeeth(p_P_mm, near.mm);
    visit(BladeContact{on_teeth ? BladeContact::On::teeth : BladeContact::On::bone, p_P_mm, near.out,
                       radius_mm - near.mm, kPoint_N_per_mm});
  }
  const calibration::Pose<Piece, Patient> X_QP = X_PQ.inverse();
  for (std::size_t n = 0; n < against_piece_.count; ++n) {
    const std::size_t point = against_piece_.index[n];
    const double radius_mm = shape_->point_radius_mm[point];
    const Point<Patient> p_P = X_PT * Point<Tool>{shape_->point_T_mm[point]};
    const Around near = around(*scene_.piece, (X_QP * p_P).mm);
    if (near.mm >= radius_mm) continue;
    visit(
        BladeContact{BladeContact::On::piece, p_P.mm, X_PQ.rotation * near.out, radius_mm - near.mm, kPoint_N_per_mm});
  }
  const calibration::Pose<Tool, Patient> X_TP = X_PT.inverse();
  for (std::size_t n = 0; n < near_samples_.count; ++n) {
    const std::size_t sample = near_samples_.index[n];
    const Point<Patient> p_P = X_PQ * Point<Piece>{sample_Q_mm(sample)};
    const ElevatorShape::Distance near = shape_->distanceAt((X_TP * p_P).mm);
    if (near.mm >= 0.0) continue;
    visit(BladeContact{BladeContact::On::piece, p_P.mm, -(X_PT.rotation * near.out), -near.mm,
                       contact_N_per_mm3_ * static_cast<double>(samples_->area_mm2[sample])});
  }
}

}  // namespace haptics
