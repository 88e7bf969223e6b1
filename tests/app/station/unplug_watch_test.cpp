#include "app/station/unplug_watch.h"

#include <gtest/gtest.h>

#include <thread>

#include "haptics/device/usb/presence.h"

namespace app {
namespace {

using haptics::KnownDevice;

/// The USB as far as the watch hears of it.
struct Usb {
  haptics::PresenceListener listener;
  int stops = 0;

  std::unique_ptr<UnplugWatch> watch() {
    return std::make_unique<UnplugWatch>([this] { ++stops; },
                                         [this](haptics::PresenceListener told) {
                                           listener = std::move(told);
                                           return std::unique_ptr<haptics::PresenceMonitor>();
                                         });
  }
  /// From a thread of its own, as the monitor tells it.
  void leaves(KnownDevice kind) {
    std::thread([&] { listener.left({kind, {}}); }).join();
  }
};

TEST(UnplugWatch, StopsTheMotorsAtOnceAndReportsItOnce) {
  Usb usb;
  const auto watch = usb.watch();
  EXPECT_EQ(watch->takeNews(), std::nullopt);
  usb.leaves(KnownDevice::touch_hid);
  EXPECT_EQ(usb.stops, 1) << "before anybody asks";
  EXPECT_EQ(watch->takeNews(), "the device was unplugged: the motors are off; plug it in, end and start again");
  EXPECT_EQ(watch->takeNews(), std::nullopt);
}

TEST(UnplugWatch, IgnoresDevicesThatMolarDrivesOverUsb) {
  Usb usb;
  const auto watch = usb.watch();
  usb.leaves(KnownDevice::falcon);
  usb.leaves(KnownDevice::wooden_haptics);
  EXPECT_EQ(usb.stops, 0);
  EXPECT_EQ(watch->takeNews(), std::nullopt);
}

TEST(UnplugWatch, StopsAgainWhateverLeavesNext) {
  Usb usb;
  const auto watch = usb.watch();
  usb.leaves(KnownDevice::touch_serial);
  usb.leaves(KnownDevice::touch_serial);
  EXPECT_EQ(usb.stops, 2);
}

TEST(UnplugWatch, ReportsThatMonitoringFailedOrEnded) {
  UnplugWatch none([] {},
                   [](haptics::PresenceListener) -> std::unique_ptr<haptics::PresenceMonitor> {
                     throw haptics::DeviceError("USB: nobody tells", haptics::DeviceTrouble::no_resources);
                   });
  EXPECT_EQ(none.takeNews(), "USB: nobody tells; an unplugged unit is noticed by its library only");
  EXPECT_EQ(none.takeNews(), std::nullopt);

  Usb usb;
  const auto watch = usb.watch();
  std::thread([&] { usb.listener.ended(); }).join();
  EXPECT_EQ(watch->takeNews(), "USB: memory ran out; an unplugged unit is noticed by its library only");
  EXPECT_EQ(watch->takeNews(), std::nullopt);
  EXPECT_EQ(usb.stops, 0);
}

}  // namespace
}  // namespace app
