// An elevator's blade against what it meets: balls along its edges against the field of all obstacles and against the
// piece's own field, and samples of the piece's surface against the blade's closed-form distance. Each pushes by its
// depth, as bare contact does (ligament_law.h). What could meet within a tick is found once, as it begins. Frames P, T,
// Q; mm, N. Servo thread; no allocation; 2 to 10 µs. A pure function. Reference/extraction 4, 5.1.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "haptics/body/distance_field.h"
#include "haptics/ligament/blade_kernels.h"
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
  enum class On : std::uint8_t { obstacle, piece };
  On on = On::obstacle;
  glm::dvec3 at_P_mm{0.0};
  glm::dvec3 out_P{0.0};  ///< unit, pushes the blade
  double depth_mm = 0.0;  ///< above zero
  double N_per_mm = 0.0;

  double push_N() const { return N_per_mm * depth_mm; }
};

/// What the kernels read: u, v, s of a vector of T, and back; the blade; where the samples lie.
glm::dvec3 inOutline(const ElevatorShape& shape, const glm::dvec3& v_T) noexcept;
glm::dvec3 fromOutline(const ElevatorShape& shape, const glm::dvec3& v_uvs) noexcept;
BladeOutline outlineOf(const ElevatorShape& shape) noexcept;
BladePlace placeOf(const ElevatorShape& shape, const ToolPose& X_PT, const PiecePose& X_PQ,
                   const glm::dvec3& centre_Q_mm) noexcept;

class BladeContacts {
 public:
  static constexpr std::size_t kMostSamples = 384;  ///< of a piece near the blade; of more, the first

  /// What lies within 0.8 mm of the blade at these poses, and how stiff a ball and an area of the piece are; `samples`
  /// may be null.
  void find(const ElevatorShape& shape, const ElevatorScene& scene, const PieceSamples* samples, double point_N_per_mm,
            double contact_N_per_mm3, const ToolPose& X_PT, const PiecePose& X_PQ) noexcept;

  /// What presses at these poses, and adds it. Returns the energy in it.
  double press(const ToolPose& X_PT, const PiecePose& X_PQ, PairBalance& balance) noexcept;
  /// Of the last press().
  std::span<const BladeContact> pressing() const noexcept { return std::span(pressing_).first(pressing_count_); }
  /// A contact with obstacles on the jaw's teeth, not on bone.
  bool isOnTeeth(const BladeContact& contact) const noexcept;

 private:
  template <std::size_t N>
  struct List {
    std::array<std::uint16_t, N> index{};
    std::size_t count = 0;
  };
  void add(const BladeContact& contact) noexcept { pressing_[pressing_count_++] = contact; }

  const ElevatorShape* shape_ = nullptr;
  ElevatorScene scene_;
  glm::dvec3 centre_Q_mm_{0.0};
  double point_N_per_mm_ = 0.0;
  BladeOutline outline_{};
  List<ElevatorShape::kMostPoints> against_obstacles_, against_piece_;
  // Samples near the blade, about the samples' centre, and their stiffness.
  std::size_t samples_count_ = 0;
  alignas(64) std::array<float, kMostSamples> x_{}, y_{}, z_{}, N_per_mm_{}, gap_{}, out_u_{}, out_v_{}, out_s_{};
  std::array<BladeContact, kMostSamples + 2 * ElevatorShape::kMostPoints> pressing_{};
  std::size_t pressing_count_ = 0;
};

}  // namespace haptics
