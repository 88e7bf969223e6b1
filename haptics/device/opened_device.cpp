#include "haptics/device/opened_device.h"

namespace haptics {

std::function<bool(const std::string&)> waitPrompt(const DeviceOptions& options) {
  return [tell = options.tell, given_up = options.given_up, said = std::string()](const std::string& words) mutable {
    if (words != said) tell(words);
    said = words;
    return !given_up();
  };
}

}  // namespace haptics
