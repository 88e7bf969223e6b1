#include "haptics/device/usb/usb_devices.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <thread>

#include "tests/haptics/usb/simulated_usb.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

class Nothing final : public simulated_usb::Device {
  void onOut(std::uint8_t, std::span<const std::uint8_t>, double) override {}
  std::optional<simulated_usb::Bytes> onIn(std::uint8_t, double) override { return {}; }
};

TEST(UsbBus, ListsWhatIsPluggedInAndWhatComesAndGoes) {
  if (!simulated_usb::Bus::available()) GTEST_SKIP() << "umockdev is not there: run under umockdev-wrapper";
  Nothing inside;
  simulated_usb::Bus rig;
  const UsbBus bus;
  EXPECT_TRUE(bus.devices().empty());

  simulated_usb::Description pen;
  pen.vendor = 0x2988;
  pen.product = 0x0302;
  pen.device_class = 2;
  pen.interface_class = 10;
  pen.maker = "3D Systems";
  pen.name = "Touch";
  pen.serial = "0123456789ab";
  pen.port = "4";
  pen.number = 7;
  rig.plug(pen, inside);
  const auto sees = [&](std::size_t count) {
    for (int i = 0; i < 10'000 && bus.devices().size() != count; ++i) std::this_thread::sleep_for(1ms);
    return bus.devices().size() == count;
  };
  ASSERT_TRUE(sees(1));
  const UsbDevice found = bus.devices().front();
  EXPECT_EQ(found.id(), "2988:0302");
  EXPECT_EQ(found.location(), "USB 1-4, 2988:0302");
  EXPECT_EQ(found.name, "Touch");
  EXPECT_EQ(found.serial, "0123456789ab");
  EXPECT_EQ(found.device_class, 2);
  EXPECT_EQ(found.interface_classes, std::vector<std::uint8_t>{10});
  EXPECT_TRUE(found.may_open);

  pen.port = "2";
  pen.number = 8;
  rig.plug(pen, inside);
  ASSERT_TRUE(sees(2));
  EXPECT_EQ(bus.devices().front().path, "1-2");
  rig.unplug("4");
  ASSERT_TRUE(sees(1));
  EXPECT_EQ(bus.devices().front().path, "1-2");
}

}  // namespace
}  // namespace haptics
