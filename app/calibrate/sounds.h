// Short tones for the technician, who looks through the mirror: touch taken, touch rejected, next target, end. Through
// PortAudio; without a sound card it is silent and reports that in one line. Construction and destruction at start-up
// only, up to a second while sound cards are searched; library output on stderr is suppressed. play(): one thread,
// never waits, no allocation.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/calibrate/wizard_view.h"

namespace app {

/// Mono samples, -1..1, starting and ending at zero.
std::vector<float> soundSamples(WizardSound sound, double rate_Hz);

class Sounds {
 public:
  /// `report`: called once if there will be no sound.
  explicit Sounds(const std::function<void(const std::string& line)>& report);
  ~Sounds();
  Sounds(const Sounds&) = delete;
  Sounds& operator=(const Sounds&) = delete;

  bool isAvailable() const;
  /// Queued after those still playing; dropped if more than a few wait.
  void play(WizardSound sound);

 private:
  struct Player;
  std::unique_ptr<Player> player_;
};

}  // namespace app
