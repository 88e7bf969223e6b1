// The sound of a rehearsal while it goes on: ticks of each frame in, samples out on the sound card's thread, some 20 ms
// later, so that it never runs dry between two frames. The card is looked for on a thread of its own: nobody waits for
// it. Without one there is silence and one line. follow() and isMuted: main thread, no allocation after construction.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "app/sound/played_sound.h"
#include "app/sound/work_sound.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

class LiveSound {
 public:
  /// `played`: gets all that the card gets, where it is given.
  explicit LiveSound(PlayedSound* played = nullptr);
  ~LiveSound();
  LiveSound(const LiveSound&) = delete;
  LiveSound& operator=(const LiveSound&) = delete;

  /// `warning`: of a structure it beats while the drill is on, of an apex locator always.
  void follow(std::span<const haptics::Tick> ticks, const haptics::Command& in_force, const SoundWarning& warning = {});
  void mute(bool muted);
  bool isMuted() const;
  /// Why there is no sound, once, when that is known; else empty.
  std::string takeTrouble();
  /// "sound: 38 ms from the frame to the ear, 20 ms of them in the card", means; empty: nothing was heard.
  std::string latencyText() const;

 private:
  struct Player;
  std::unique_ptr<Player> player_;
};

}  // namespace app
