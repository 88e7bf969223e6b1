#include "app/station/unplug_watch.h"

#include <utility>

#include "haptics/device/usb/presence.h"

namespace app {
namespace {

std::unique_ptr<haptics::PresenceMonitor> onTheUsb(haptics::PresenceListener listener) {
  return std::make_unique<haptics::PresenceMonitor>(std::move(listener));
}

}  // namespace

UnplugWatch::UnplugWatch(Workstation& workstation)
    : UnplugWatch([&workstation] { workstation.emergencyStop(); }, onTheUsb) {}

UnplugWatch::UnplugWatch(std::function<void()> stop, const Monitoring& monitoring) {
  haptics::PresenceListener listener;
  listener.left = [this, stop = std::move(stop)](const haptics::PresentDevice& gone) {
    if (!haptics::isClosed(gone.kind)) return;
    stop();
    unplugged_.store(true);
  };
  listener.ended = [this] { blind_.store(true); };
  try {
    monitor_ = monitoring(std::move(listener));
  } catch (const haptics::DeviceError& error) {
    trouble_ = error.what();
    blind_.store(true);
  }
}

UnplugWatch::~UnplugWatch() = default;

std::optional<std::string> UnplugWatch::takeNews() {
  if (unplugged_.load() && !std::exchange(said_, true))
    return "the device was unplugged: the motors are off; plug it in, end and start again";
  if (blind_.load() && !std::exchange(said_blind_, true))
    return trouble_ + "; an unplugged unit is noticed by its library only";
  return std::nullopt;
}

}  // namespace app
