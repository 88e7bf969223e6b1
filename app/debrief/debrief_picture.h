// A moment of a session as a picture: the surgeon's view or a free one, with layers, the way of the tool, and the line
// that the surgeon read. Render thread, with the context current of the back-end it was made for; the cost of drawing.
#pragma once

#include <memory>
#include <optional>

#include "app/debrief/debrief_run.h"
#include "app/rehearsal/clearance_watch.h"
#include "app/rehearsal/head_up.h"
#include "app/view/brick_upload.h"
#include "app/view/head_up_line.h"
#include "render/frame_renderer.h"

namespace app {

struct PictureChoice {
  render::ViewMode mode = render::ViewMode::iso;
  render::Layers layers;
  render::DisplayMode display = render::DisplayMode::mono;
  TrailColour trail = TrailColour::none;
  bool has_line = true;      ///< of text
  bool other_ghost = false;  ///< the other session's tool in the place of the ghost
  bool edges = false;        ///< sharp ones of bone, once a piece of the tooth is out

  bool operator==(const PictureChoice& other) const;
};

class DebriefPicture {
 public:
  static constexpr double kTrail_s = 3.0;

  /// Borrows the run.
  DebriefPicture(DebriefRun& run, const render::RenderOptions& options);

  /// The run's moment seen with a rig: its `screen.px` is the size of the picture. `other_tick`: of the other session,
  /// whose tool is drawn as a ghost, in the form of this one's; null: of none.
  void update(const PictureChoice& choice, const calibration::Rig& rig, double face_window_mm,
              const haptics::Tick* other_tick = nullptr, DebriefRun::Look look = DebriefRun::Look::now);
  /// Of the sharp edges that are shown; none: they are not chosen, or not known at this moment.
  std::optional<double> edges_mm() const { return edges_mm_; }
  void draw(const render::Quality& quality);
  render::FrameRenderer& renderer() { return *renderer_; }

  /// Where the patient lies before the surgeon; `px`: of the picture.
  static calibration::Rig firstRig(const DebriefRun& run, glm::ivec2 px, double loupes);

 private:
  void showLeft(const haptics::Tick& tick);
  void showSecondHand(const haptics::Tick& tick);
  void showEdges(DebriefRun::Look look);

  DebriefRun& run_;
  std::unique_ptr<render::FrameRenderer> renderer_;
  BrickUploader uploader_;
  std::optional<haptics::Tool> shown_tool_;
  std::optional<assets::SecondInstrument> shown_second_;
  std::optional<double> edges_mm_;
  render::Frame frame_;
  ClearanceWatch clearance_;
  std::vector<assets::MetalFragment> shown_fragments_;
  HeadUp head_up_;
  HeadUpLine line_;
};

}  // namespace app
