// Sessions played: where they stand, which pictures are due and how good, what was said at that moment. Whoever owns
// the window, or has none, gives it time. Render thread; a call is one frame, while it is prepared 0.15 s.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "app/debrief/debrief_plan.h"
#include "app/debrief/debrief_scene.h"
#include "app/debrief/debrief_voice.h"
#include "app/debrief/transport.h"
#include "render/quality_ladder.h"

namespace app {

class DebriefPlayer {
 public:
  /// Opens the sessions, some seconds.
  explicit DebriefPlayer(const DebriefPlan& plan);
  /// With the context of the back-end current. `on_processor`: pictures are slow.
  void open(const render::RenderOptions& options, bool on_processor);

  DebriefScene& scene() { return scene_; }
  Transport& transport() { return transport_; }
  const Transport& transport() const { return transport_; }
  bool isPrepared() const { return scene_.isPrepared(); }
  double preparedShare() const { return share_; }

  /// Wall time has passed: runs some more of the sessions, or plays on. True: all of them have been run just now.
  bool advance(double passed_s);
  /// A hand drags along the time line: it is followed roughly, with a grain of sound.
  void setScrubbing(bool scrubs) { scrubs_ = scrubs; }
  void forgetVoice() { voice_.reset(); }

  /// Draws where something has changed: roughly where it jumps, better once nothing has changed for a while. False: the
  /// picture was kept.
  bool draw(glm::ivec2 px, const PictureChoice& choice);
  /// The next picture is another one.
  void changeView() { view_changed_ = true; }
  /// At full quality, of the moment itself, or of another.
  render::Image fullPicture(glm::ivec2 px, std::optional<double> at_s = {});
  /// The picture that was asked for is on the display.
  void noteShown();
  /// Jumps so far, until shown: "12 jumps: …"; empty: none.
  std::string jumpsText() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool prepare();
  void openVoice();
  void followVoice();

  const DebriefPlan& plan_;
  DebriefScene scene_;
  Transport transport_;
  bool on_processor_ = false;
  std::optional<render::QualityLadder> ladder_;
  std::optional<DebriefVoice> voice_;
  double share_ = 0.0;
  Clock::time_point begun_ = Clock::now(), drawn_at_{};
  struct Shown {
    double position_s = -1.0;
    glm::ivec2 px{0};
    PictureChoice choice;
    bool is_refined = false, is_near = false;  ///< at full quality; of a moment beside it
  };
  std::optional<Shown> shown_;
  bool view_changed_ = false, scrubs_ = false;
  std::optional<Clock::time_point> jump_at_;
  std::vector<double> jumps_ms_;
};

}  // namespace app
