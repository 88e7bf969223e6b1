// What a debrief tells of a session beside its picture: marks on the time line, and where the tool was, how hard it
// pressed and how near it came, fifty times a second. Made while the session is run once, tick by tick in order. Frame
// P, mm, N, s. Any one thread; 30 bytes a sample.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/session/session_writer.h"
#include "assets/risk_structures.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"
#include "render/frame.h"

namespace app {

enum class MarkKind : std::uint8_t { step, error, coach, touch, tool, undo, event, bookmark };
/// For people, by kind.
inline constexpr std::array<std::string_view, 8> kMarkNames{"step",       "error", "coach", "touch",
                                                            "instrument", "undo",  "event", "bookmark"};

struct SessionMark {
  double t_s = 0.0;
  MarkKind kind = MarkKind::event;
  std::string what;
};

struct StorySample {
  float t_s = 0.0F;
  glm::vec3 at_P_mm{0.0F};       ///< the proxy
  float force_N = 0.0F;          ///< of the model
  float clearance_mm = 1e6F;     ///< to the structure that is nearest to its red band
  assets::RiskLevel level = {};  ///< of the most urgent
  bool drilling = false;
};

enum class TrailColour : std::uint8_t { none, force, clearance };

class SessionStory {
 public:
  static constexpr double kBetweenSamples_s = 0.02;

  /// Borrows the structures.
  SessionStory(std::vector<SessionEvent> events, const assets::RiskStructures& risks)
      : events_(std::move(events)), risks_(risks) {}

  /// Every tick, in order.
  void follow(const haptics::Tick& tick, const haptics::Command& command);

  /// In order of time.
  const std::vector<SessionMark>& marks() const { return marks_; }
  std::span<const StorySample> samples() const { return samples_; }
  /// Those of the last `length_s` before a moment.
  std::span<const StorySample> samplesBefore(double t_s, double length_s) const;
  double mostForce_N() const { return most_force_N_; }

 private:
  void note(const haptics::Tick& tick, const SessionEvent& event);

  std::vector<SessionEvent> events_;
  const assets::RiskStructures& risks_;
  std::size_t next_event_ = 0;
  std::vector<SessionMark> marks_;
  std::vector<StorySample> samples_;
  double most_force_N_ = 0.0, next_sample_s_ = 0.0, restored_mm3_ = 0.0;
  std::optional<haptics::Tool> tool_;
};

/// The way of the tool as small balls, green to red by force (1, 2, 4 N) or by clearance (its bands).
std::vector<render::Bead> trailOf(std::span<const StorySample> samples, TrailColour colour);

}  // namespace app
