// What the technician hears while looking through the mirror: short tones for a touch that counts, one that does not,
// the next target, the end. Through PortAudio; where there is no sound card it is silent and says so in one line.
// Construction and destruction: start-up only, up to a second while sound cards are looked for; what libraries print on
// stderr meanwhile is thrown away. play(): one thread, never waits, no allocation; the sound's own thread mixes.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/calibrate/wizard_view.h"

namespace app {

/// Mono, -1..1; begins and ends in silence.
std::vector<float> soundSamples(WizardSound sound, double rate_Hz);

class Sounds {
 public:
  /// `tell`: once, why nothing will be heard.
  explicit Sounds(const std::function<void(const std::string& line)>& tell);
  ~Sounds();
  Sounds(const Sounds&) = delete;
  Sounds& operator=(const Sounds&) = delete;

  bool isAvailable() const;
  /// After those that still sound; more than a few are dropped.
  void play(WizardSound sound);

 private:
  struct Player;
  std::unique_ptr<Player> player_;
};

}  // namespace app
