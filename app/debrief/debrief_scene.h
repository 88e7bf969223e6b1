// The sessions of a debrief at one moment, side by side in one picture, seen from one place. Render thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/debrief/debrief_picture.h"
#include "app/debrief/debrief_plan.h"
#include "app/debrief/debrief_run.h"
#include "app/view/desk_view.h"
#include "render/image.h"

namespace app {

/// While a hand drags along the time line or jumps, and the processor draws: the moment, not its beauty.
inline constexpr render::Quality kScrubQuality{render::Antialias::none, false, false, 1.0, 4, false, false};

class DebriefScene {
 public:
  /// Opens the sessions, some seconds.
  explicit DebriefScene(const DebriefPlan& plan);

  /// With the context of the back-end current.
  void open(const render::RenderOptions& options);

  std::vector<std::unique_ptr<DebriefRun>>& runs() { return runs_; }
  /// Of the longer one.
  double length_s() const;
  /// Runs about `most_s` more of each; false: all are prepared.
  bool prepare(double most_s);
  /// Runs all until that moment at least.
  void prepareTo(double t_s);
  double preparedShare() const;
  bool isPrepared() const;

  /// All runs, as far as they are prepared.
  void goTo(double t_s);
  /// To moments near it that are at hand, for a hand that scrubs.
  void goNear(double t_s);

  PictureChoice choice;

  void turn(const glm::dvec2& by_px) { view_->turn(by_px); }
  void magnify(int steps) { view_->magnify(steps); }
  void backToFirst() { view_->backToFirst(); }

  /// Draws all pictures; `px`: of all of them together.
  void draw(glm::ivec2 px, const render::Quality& quality, DebriefRun::Look look = DebriefRun::Look::now);
  /// By session, as drawn.
  std::vector<std::optional<double>> edges_mm() const;
  /// Into the current window, the upper left corner of all at `corner_px` from the window's.
  void showOnWindow(glm::ivec2 corner_px, glm::ivec2 window_px);
  /// As drawn, side by side.
  render::Image image();

 private:
  glm::ivec2 sizeOfOne(glm::ivec2 px) const;

  std::vector<std::unique_ptr<DebriefRun>> runs_;
  std::vector<std::unique_ptr<DebriefPicture>> pictures_;
  double loupes_;
  glm::ivec2 first_px_;
  std::optional<DeskView> view_;
  glm::ivec2 drawn_px_{0};  ///< of one
};

}  // namespace app
