// How it stands with a session's voice, for pages and lines. Plain.
#pragma once

namespace app {

struct VoiceState {
  double level_db = -100.0;  ///< of full scale
  bool speech = false;
  double quiet_s = 0.0;   ///< since somebody spoke
  bool reminder = false;  ///< quiet for too long, and nothing was said since
  double green_s = 0.0;   ///< of speech so far, within the level that is recorded well
};

}  // namespace app
