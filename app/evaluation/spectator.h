// Who looks on at a rehearsal: sees each frame after it was drawn, may ask for its picture, and may end it. Main
// thread, once a frame; what it costs is the spectator's.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "haptics/loop/loop_statistics.h"
#include "haptics/servo/tick.h"
#include "render/image.h"

namespace app {

/// No spectator needs it larger; what the processor has drawn comes as it is.
inline constexpr glm::ivec2 kSpectatorPicture_px{960, 540};

class Spectator {
 public:
  struct Frame {
    const haptics::Tick& newest;
    std::optional<double> clearance_mm;  ///< of the tool to the nearest structure at risk
    double rate_Hz = 1000.0;             ///< of the servo
    /// Why nothing is recorded any more.
    const std::function<std::optional<std::string>()>& recording_trouble;
    /// Made at each call: some 10 µs; some milliseconds. The picture: of the surgeon, of one eye, as it was when it was
    /// first asked for; none where nothing was drawn, and while it is on its way from the graphics card.
    const std::function<haptics::LoopFigures()>& servo;
    const std::function<render::Image()>& picture;
  };

  virtual ~Spectator() = default;
  virtual void see(const Frame& frame) = 0;
  virtual bool endsRehearsal() const = 0;
};

}  // namespace app
