// Who steers a debrief from elsewhere, as the evaluator does at the page while the surgeon looks at the display: told
// what is shown, asked where to go. Main thread, once a frame; what it costs is the guide's.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/moment_values.h"
#include "render/image.h"

namespace app {

/// Scrub: a hand drags there, roughly is enough; seek: the moment itself. s; speed: 0.25 to 4.
enum class DebriefSteer : std::uint8_t { play, pause, seek, scrub, speed };
inline constexpr std::array<std::string_view, 5> kDebriefSteers{"play", "pause", "seek", "scrub", "speed"};
inline constexpr double kLeastDebriefSpeed = 0.25, kMostDebriefSpeed = 4.0;

class DebriefGuide {
 public:
  struct Mark {
    double t_s = 0.0;
    std::string what;
  };
  struct Shown {
    double t_s = 0.0, length_s = 0.0, tick_s = 0.001;
    double prepared_share = 0.0;  ///< below 1: the session is run again, nothing can be played yet
    bool plays = false;
    double speed = 1.0;
    MomentValues values;
    std::span<const Mark> incidents;  ///< errors and touches of the session, in order of time
    /// Another picture than the one before was drawn: it, made at each call, some milliseconds.
    bool is_new_picture = false;
    const std::function<render::Image()>& picture;
  };
  struct Steered {
    DebriefSteer what = DebriefSteer::pause;
    double value = 0.0;
  };

  virtual ~DebriefGuide() = default;
  virtual void follow(const Shown& shown) = 0;
  /// Since the last call, in order.
  virtual std::vector<Steered> takeSteered() = 0;
  /// What was said may be heard, by the newest word on it.
  virtual bool allowsVoice() const = 0;
  virtual bool isOver() const = 0;
};

}  // namespace app
