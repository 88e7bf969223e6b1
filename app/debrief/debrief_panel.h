// The strip below the pictures of a debrief, drawn with Dear ImGui: time, speed, a time line with marks and force for
// each session, layers, keys. Independent of window and OpenGL. Main thread; well under a millisecond.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "app/debrief/debrief_picture.h"
#include "app/debrief/session_story.h"
#include "app/debrief/transport.h"

namespace app {

struct DebriefPanelRun {
  std::string name;
  double length_s = 0.0;
  std::vector<SessionMark> marks;  ///< in order of time
  std::span<const StorySample> samples;
  double most_force_N = 0.0;
  std::optional<double> edges_mm = {};  ///< sharp, at this moment; none: not known or not shown
};

struct DebriefPanelState {
  Transport transport;
  std::vector<DebriefPanelRun> runs;
  PictureChoice choice;
  double prepared_share = 1.0;      ///< below 1: nothing can be played yet
  std::optional<std::string> note;  ///< of a bookmark, while it is written
  std::string said;                 ///< just now; empty: nothing
  std::optional<double> clip_from_s, clip_to_s;
  bool keys_shown = false;
};

struct DebriefPanelInput {
  std::optional<double> go_to_s;  ///< on the time line, as long as the button is held there
  std::optional<PictureChoice> choice;
  bool plays = false;  ///< the button was pressed
};

/// Height of the strip.
int debriefPanelHeight_px(std::size_t runs);

/// Between ImGui's NewFrame and Render. The pictures lie above, from kDebriefHeader_px on.
DebriefPanelInput drawDebriefPanel(const DebriefPanelState& state, glm::ivec2 window_px);

/// Names over pictures that lie side by side, and the sheet of keys.
inline constexpr int kDebriefHeader_px = 34;

}  // namespace app
