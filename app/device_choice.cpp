#include "app/device_choice.h"

#include <algorithm>
#include <array>

#include "app/usage_error.h"
#include "haptics/device/openhaptics/open_haptics.h"
#include "haptics/device/usb/falcon.h"
#include "haptics/device/usb/wooden_haptics.h"

namespace app {
namespace {

constexpr std::array<std::string_view, 3> kKinds = {"openhaptics", "falcon", "usb"};

/// "falcon:1-2" as "falcon" and "1-2".
struct Address {
  std::string kind, rest;
};
Address split(const std::string& address) {
  const std::size_t colon = address.find(':');
  if (colon == std::string::npos) return {address, {}};
  return {address.substr(0, colon), address.substr(colon + 1)};
}

/// Says the same thing once.
std::function<void(const std::string&)> once(std::function<void(const std::string&)> tell) {
  return [tell = std::move(tell), said = std::string()](const std::string& words) mutable {
    if (words != said) tell(words);
    said = words;
  };
}

/// What `open` throws, with the name of the device before it.
template <class Open>
auto named(const std::string& name, Open open) {
  try {
    return open();
  } catch (const haptics::DeviceError& error) {
    const std::string what = error.what();
    throw haptics::DeviceError(what.find(name) == std::string::npos ? name + ", " + what : what);
  }
}

std::string firstOnTheUsb() {
  for (const auto& search : {haptics::findWoodenHaptics, haptics::findFalcon})
    for (const haptics::FoundDevice& found : search())
      if (!found.address.empty()) return found.address;
  throw haptics::DeviceError("--device usb: no device that Molar drives is on the USB, see molar devices");
}

}  // namespace

bool namesRealDevice(const std::string& address) {
  return std::ranges::count(kKinds, split(address).kind) != 0 || haptics::woodenAddressed(address);
}

OpenedDevice openDevice(const std::string& address, const DeviceOptions& options) {
  OpenedDevice opened;
  opened.address = address == "usb" ? firstOnTheUsb() : address;
  const Address asked = split(opened.address);
  if (auto wooden = haptics::woodenAddressed(opened.address)) {
    wooden->tell = [say = once(options.tell), given_up = options.given_up](const std::string& words) mutable {
      say(words);
      return given_up() ? haptics::HomingAnswer::give_up : haptics::HomingAnswer::wait;
    };
    opened.device = named("WoodenHaptics", [&] { return std::make_unique<haptics::WoodenHaptics>(*wooden); });
  } else if (asked.kind == "openhaptics") {
    opened.library = std::make_unique<haptics::HdLibrary>();
    opened.device = std::make_unique<haptics::OpenHaptics>(
        *opened.library,
        haptics::OpenHapticsSettings{.configuration = asked.rest, .docked_value = options.docked_value});
  } else if (asked.kind == "falcon") {
    haptics::FalconSettings settings;
    settings.path = asked.rest;
    settings.program = options.falcon_program;
    settings.scale = options.falcon_scale;
    settings.tell = [say = once(options.tell), given_up = options.given_up](const std::string& words, double) mutable {
      say(words);
      return !given_up();
    };
    opened.device = named("Novint Falcon", [&] { return std::make_unique<haptics::Falcon>(settings); });
  } else {
    throw UsageError("--device " + address +
                     ": it is not the address of a device, see molar devices for those that are there");
  }
  return opened;
}

}  // namespace app
