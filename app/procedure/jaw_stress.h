// What an elevator does to the jaw: bending stress of the bone in the plane through its fulcrum, square to the arch.
// Stress = force times a lever of 30 mm, to the condyle's support or the hand that holds the jaw, over the section
// modulus of what bone is left there, about the weaker principal axis. Trabecular bone counts as a tenth of
// cortical. Shown, never a random event: jaws break in some 5 of 100,000 extractions (reference/extraction 1.3, whose
// lever and bounds are our defaults; cortical bone fails in bending at 100 to 200 MPa). Frame P; mm, N, MPa. Main
// thread; a measurement takes some ms and is made at most five times a second.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "assets/patient.h"
#include "haptics/servo/tick.h"

namespace app {

/// Least section modulus, mm3 of cortical bone, within 22 mm of `at_P_mm` along and 36 mm below it; `along` is
/// horizontal. 0: no bone there. `solid`, `label`: of the grid.
double sectionModulus_mm3(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                          std::span<const std::uint8_t> label, const glm::dvec3& at_P_mm, const glm::dvec2& along);

class JawStress {
 public:
  static constexpr double kLever_mm = 30.0, kHigh_N_per_mm2 = 30.0, kDangerous_N_per_mm2 = 60.0;

  /// Borrows the patient.
  explicit JawStress(const assets::Patient& patient);

  /// With the newest tick; `jaw`: a copy of the live jaw's solid in grid order, asked for when a section is measured.
  template <class CopyJaw>
  void follow(const haptics::Tick& newest, const CopyJaw& jaw) {
    if (const auto plane = due(newest)) measure(*plane, jaw());
    update(newest);
  }
  /// None: no elevator presses on bone, or there is no arch to know the jaw's direction by.
  std::optional<double> now_N_per_mm2() const { return now_N_per_mm2_; }
  /// Since the start.
  double most_N_per_mm2() const { return most_N_per_mm2_; }

 private:
  struct Plane {
    glm::dvec3 at_P_mm;
    glm::dvec2 along;
  };
  std::optional<Plane> due(const haptics::Tick& newest);
  void measure(const Plane& plane, std::span<const std::uint8_t> solid);
  void update(const haptics::Tick& newest);

  const assets::Patient& patient_;
  std::vector<glm::dvec2> arch_P_mm_;
  double modulus_mm3_ = 0.0, measured_s_ = -1.0;
  glm::dvec3 measured_P_mm_{0.0};
  std::optional<double> now_N_per_mm2_;
  double most_N_per_mm2_ = 0.0;
};

}  // namespace app
