// Refines the picture when nothing in it moves: after 0.3 s it is drawn once at the best quality and kept, only its
// text is composed anew, and it is refined again where water, blood or spray have changed; whatever moves is drawn at
// the live quality again, in the same frame. A hand that rests on the desk or in its inkwell still trembles: smaller
// motions than kStill_mm and kStill_rad are none. Has no clock. Main thread; comparing costs under a microsecond.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "app/view/surgeon_display.h"
#include "render/frame.h"

namespace app {

/// How a frame was shown: drawn at its own quality, drawn at the best one, or the refined picture again.
enum class FrameDrawing : std::uint8_t { live, refined, kept };

/// A tenth of a pixel at 1:1, half of one under the usual loupes.
inline constexpr double kStill_mm = 0.03, kStill_rad = 0.002;

/// Whether both frames show the same scene from the same place, but for the quality and the tremble of a resting hand.
bool showSameScene(const render::Frame& a, const render::Frame& b);

class StillPicture {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::chrono::milliseconds kStillFor{300};

  /// `frame` with its live quality. `changed`: something outside of the frame, since the last call: bone, warnings.
  FrameDrawing next(const render::Frame& frame, bool changed, Time now);
  /// Begins anew, with a live picture.
  void forget() {
    still_.reset();
    newest_ = FrameDrawing::live;
  }
  FrameDrawing newest() const { return newest_; }

 private:
  std::optional<render::Frame> still_;  ///< the first one since something moved
  Time since_{};
  FrameDrawing newest_ = FrameDrawing::live;
};

/// Shows the frame as `step` says.
void show(SurgeonDisplay& display, render::Frame frame, FrameDrawing step);

}  // namespace app
