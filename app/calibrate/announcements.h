// The current message to the technician, and the sounds since the last view. Plain data; one thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/calibrate/wizard_view.h"

namespace app {

struct Announcements {
  ShownMessage message;
  std::vector<WizardSound> sounds;

  void say(std::string text) { message = {std::move(text), Tone::info}; }
  void praise(std::string text, WizardSound sound = WizardSound::ok) {
    message = {std::move(text), Tone::good};
    sounds.push_back(sound);
  }
  void refuse(std::string text) {
    message = {std::move(text), Tone::reject};
    sounds.push_back(WizardSound::reject);
  }
};

}  // namespace app
