// How the hand worked near nerve and neighbours (reference/product 4.3), for canal, outer lingual surface and second
// molar: S3 largest force of the model nearer than 2 mm, its 95 %, its impulse; S4 risk integral, time on times
// nearness below 2 mm times force; S5 largest speed of approach of the head's centre nearer than 4 mm, the drill on.
// And what S6 needs, force and speed by distance (contact_envelope.h). Frame P; mm, N, s. A stream: live and from the
// file the same ticks give the same numbers. One thread. A clearance is asked for (2 to 4 µs) where the tool has moved
// 0.02 mm since, presses or turns, and can be nearer than 4 mm.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "app/session/measures/contact_envelope.h"
#include "app/session/measures/measure_value.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/clearance.h"

namespace app {

class NearWork {
 public:
  /// Borrowed.
  explicit NearWork(const assets::RiskStructures& structures) : structures_(structures) {}

  /// `tool` of that tick.
  void add(const haptics::Tick& tick, const haptics::Tool& tool);
  std::vector<MeasureValue> values() const;
  const ContactEnvelope& envelope() const { return envelope_; }

 private:
  static constexpr std::size_t kStructures =
      3;  ///< canal, lingual, second molar: in the order of assets::RiskStructure
  static constexpr double kNear_mm = 2.0, kBand_mm = 4.0, kForceClass_N = 0.02;
  static constexpr std::size_t kForceClasses = 2000;
  struct One {
    double asked_mm = 0.0, moved_mm = 0.0;
    bool is_asked = false;
    double near_s = 0.0, most_N = 0.0, impulse_Ns = 0.0, risk_Ns = 0.0;
    std::optional<double> most_s;
    std::optional<double> approach_mm_per_s, approach_s;
    glm::dvec3 towards_P{0.0};  ///< unit; zero: no direction is known
    double since_look_s = std::numeric_limits<double>::infinity();
    std::vector<double> force_s;  /// by class of force, nearer than 2 mm
  };
  void look(One& one, const assets::StructureDistance& structure, const haptics::Tick& tick,
            const haptics::Tool& tool) const;
  void approach(One& one, const assets::StructureDistance& structure, const haptics::Tick& tick) const;

  const assets::RiskStructures& structures_;
  std::array<One, kStructures> ones_;
  ContactEnvelope envelope_;
  std::optional<calibration::Pose<calibration::Patient, calibration::Tool>> last_;
  haptics::Tool tool_;
  bool turned_ = false;
};

/// S6 without a reference set.
std::vector<MeasureValue> noEnvelope();
/// Without any structure: each measure with why.
std::vector<MeasureValue> noNearWork(std::string_view why);

}  // namespace app
