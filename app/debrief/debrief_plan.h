// What a debrief is to show, as plain values. Made by a command before anything runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/debrief/bookmarks.h"
#include "app/debrief/debrief_picture.h"
#include "app/evaluation/debrief_guide.h"
#include "app/evaluation/voice/voice_files.h"
#include "render/render_options.h"

namespace app {

struct DebriefPlan {
  std::vector<std::string> sessions;  ///< one, or two that are shown side by side
  std::string patient;                ///< folder of an imported one; empty: not named
  glm::ivec2 size_px{1280, 900};      ///< of the window, or of the pictures
  std::optional<render::Backend> backend;
  PictureChoice choice;
  double loupes = 4.0;
  double at_s = 0.0;
  bool full_screen = false;
  std::optional<int> monitor;      ///< index of render::monitors()
  SegmentOpener voice_opener;      ///< of a voice that is sealed; none: it stays closed
  std::vector<Bookmark> unsealed;  ///< of the first session, by whoever has the key: shown, and stored nowhere
};

struct DebriefExport {
  std::string snapshot;  ///< PNG file; empty: none
  std::string clip;      ///< folder of PNG files; empty: none
  double from_s = 0.0, to_s = 0.0, frames_per_s = 25.0;
  bool overwrite = false;
};

/// Of a clip: at 25 a second 13 minutes.
inline constexpr std::size_t kMostClipPictures = 20'000;

/// Plays in a window until it is closed, or until the guide ends it. Throws GpuError without one.
int showDebrief(const DebriefPlan& plan, DebriefGuide* guide = nullptr);

/// Without a window: what is drawn is for the guide alone, who ends it.
void followDebriefUnseen(const DebriefPlan& plan, DebriefGuide& guide);

/// Without a window. Progress goes to stderr, figures to stdout.
int exportDebrief(const DebriefPlan& plan, const DebriefExport& wanted);

}  // namespace app
