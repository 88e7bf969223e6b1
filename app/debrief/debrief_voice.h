// The voice of a session in its debrief, on the sound card (voice_along). A session without a voice, one that is
// sealed, or a machine without a card: silence. Main thread, once a frame; the card's thread takes what is there.
#pragma once

#include <memory>
#include <string>

#include "app/evaluation/voice/voice_files.h"

namespace app {

class DebriefVoice {
 public:
  /// `recording`: the session's file, beside which its voice lies. Throws LoadError: that is damaged.
  DebriefVoice(const std::string& recording, double tick_s, SegmentOpener opener = {});
  ~DebriefVoice();
  DebriefVoice(const DebriefVoice&) = delete;
  DebriefVoice& operator=(const DebriefVoice&) = delete;

  bool isThere() const { return player_ != nullptr; }
  /// `plays_along`: forwards, at the speed of life; `scrubs`: a hand drags, each new position is a grain of sound.
  void follow(double position_s, bool plays_along, bool scrubs = false);

 private:
  struct Player;
  std::unique_ptr<Player> player_;
};

}  // namespace app
