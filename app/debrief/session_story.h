// What a debrief tells of a session beside its picture: marks on the time line, and where the tool was and how hard
// it pressed, fifty times a second. Made while the session is run once, tick by tick in order. Frame
// P, mm, N, s. Any one thread; 24 bytes a sample.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "app/review/session_marks.h"
#include "assets/risk_structures.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"
#include "render/frame.h"

namespace app {

struct StorySample {
  float t_s = 0.0F;
  glm::vec3 at_P_mm{0.0F};       ///< the proxy
  float force_N = 0.0F;          ///< of the model
  assets::RiskLevel level = {};  ///< of the most urgent
  bool drilling = false;
};

enum class TrailColour : std::uint8_t { none, force, clearance };

class SessionStory {
 public:
  static constexpr double kBetweenSamples_s = 0.02;

  /// Borrows the structures.
  SessionStory(std::vector<SessionEvent> events, const assets::RiskStructures& risks)
      : marks_(std::move(events)), risks_(risks) {}

  /// Every tick, in order.
  void follow(const haptics::Tick& tick, const haptics::Command& command);

  const std::vector<SessionMark>& marks() const { return marks_.all(); }
  std::span<const StorySample> samples() const { return samples_; }
  /// Those of the last `length_s` before a moment.
  std::span<const StorySample> samplesBefore(double t_s, double length_s) const;
  double mostForce_N() const { return most_force_N_; }

 private:
  SessionMarks marks_;
  const assets::RiskStructures& risks_;
  std::vector<StorySample> samples_;
  double most_force_N_ = 0.0, next_sample_s_ = 0.0;
};

/// The way of the tool as small balls, green to red by force (1, 2, 4 N) or by clearance (its bands).
std::vector<render::Bead> trailOf(std::span<const StorySample> samples, TrailColour colour);

}  // namespace app
