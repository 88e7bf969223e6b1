#include "haptics/device/usb/presence.h"

#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include "haptics/device/haptic_device.h"
#include "tests/haptics/usb/simulated_usb.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

UsbDevice usb(std::uint16_t vendor, std::uint16_t product, std::uint8_t device_class = 0,
              std::vector<std::uint8_t> interface_classes = {}) {
  UsbDevice device;
  device.vendor = vendor;
  device.product = product;
  device.path = "1-3";
  device.device_class = device_class;
  device.interface_classes = std::move(interface_classes);
  return device;
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(KnownDevices, DistinguishesTheKindsOfTouchByTheirClasses) {
  EXPECT_EQ(knownAs(usb(0x2988, 0x0302, 2)), KnownDevice::touch_serial);
  EXPECT_EQ(knownAs(usb(0x2988, 0x0302, 0, {2, 10})), KnownDevice::touch_serial);
  EXPECT_EQ(knownAs(usb(0x2988, 0x0304, 0, {3})), KnownDevice::touch_hid);
  EXPECT_EQ(knownAs(usb(0x2988, 0x7777, 0, {3})), KnownDevice::touch_hid);
  EXPECT_EQ(knownAs(usb(0x2988, 0x0302, 0, {0xFF})), KnownDevice::touch_of_another_kind);
  EXPECT_EQ(knownAs(usb(0x2988, 0x0302)), KnownDevice::touch_of_another_kind);
}

TEST(KnownDevices, KnowsAnEarlyTouchWithSwappedIds) {
  const UsbDevice early = usb(0x0301, 0x2988, 2, {2, 10});
  ASSERT_EQ(knownAs(early), KnownDevice::touch_serial);
  const FoundDevice found = described(KnownDevice::touch_serial, early);
  EXPECT_EQ(found.location, "USB 1-3, 0301:2988 (ids swapped)");
  EXPECT_FALSE(knownAs(usb(0x0301, 0x0302)));
  EXPECT_FALSE(knownAs(usb(0x0302, 0x2988)));
}

TEST(KnownDevices, NamesTheDriverAndNoAddressOfAClosedDevice) {
  for (const KnownDevice kind : {KnownDevice::touch_serial, KnownDevice::touch_hid, KnownDevice::touch_of_another_kind,
                                 KnownDevice::force_dimension}) {
    EXPECT_TRUE(isClosed(kind));
    const FoundDevice found = described(kind, usb(0x2988, 0x0302));
    EXPECT_EQ(found.address, "");
    EXPECT_EQ(found.provenance, Provenance::vendor_library);
    EXPECT_NE(found.advice, "");
  }
  EXPECT_TRUE(says(described(KnownDevice::touch_serial, usb(0x2988, 0x0302)).advice, "serial kind"));
  EXPECT_TRUE(says(described(KnownDevice::touch_serial, usb(0x2988, 0x0302)).advice, "ModemManager"));
  EXPECT_TRUE(says(described(KnownDevice::touch_hid, usb(0x2988, 0x0302)).advice, "HID kind"));
  EXPECT_TRUE(says(described(KnownDevice::force_dimension, usb(0x1451, 0x0402)).driver, "SDK would be needed"));
}

TEST(KnownDevices, KnowsTheOthersAndNothingElse) {
  EXPECT_EQ(knownAs(usb(0x1451, 0x0402)), KnownDevice::force_dimension);
  EXPECT_EQ(knownAs(usb(0x0403, 0xCB48)), KnownDevice::falcon);
  EXPECT_EQ(knownAs(usb(0x1234, 0x0006)), KnownDevice::wooden_haptics);
  // FTDI's own serial bridge, a mouse, a Teensy of any purpose.
  EXPECT_FALSE(knownAs(usb(0x0403, 0x6001, 0, {0xFF})));
  EXPECT_FALSE(knownAs(usb(0x046D, 0xC077, 0, {3})));
  EXPECT_FALSE(knownAs(usb(0x16C0, 0x0486, 0, {3})));
}

/// Refuses to be spoken to, and remembers who tried.
class Closed final : public simulated_usb::Device {
 public:
  void onOut(std::uint8_t, std::span<const std::uint8_t>, double) override { ++spoken_to; }
  std::optional<simulated_usb::Bytes> onIn(std::uint8_t, double) override {
    ++spoken_to;
    return {};
  }
  std::optional<simulated_usb::Bytes> onControl(const simulated_usb::Setup&, std::span<const std::uint8_t>,
                                                double) override {
    ++spoken_to;
    return {};
  }
  int spoken_to = 0;
};

simulated_usb::Description touch(const std::string& port, int number, bool hid) {
  simulated_usb::Description d;
  d.vendor = 0x2988;
  d.product = 0x0302;
  d.device_class = hid ? 0 : 2;
  d.interface_class = hid ? 3 : 10;
  d.maker = "3D Systems";
  d.name = "Touch";
  d.port = port;
  d.number = number;
  return d;
}

/// What the monitor said, in its order: "+1-2 …" came, "-1-2 …" went.
class Heard {
 public:
  PresenceListener listener() {
    return {[this](const PresentDevice& device) { add("+", device); },
            [this](const PresentDevice& device) { add("-", device); }};
  }
  /// However busy the machine is.
  bool soon(std::size_t count) {
    for (int i = 0; i < 20'000 && all().size() < count; ++i) std::this_thread::sleep_for(1ms);
    return all().size() == count;
  }
  std::vector<std::string> all() {
    const std::lock_guard lock(mutex_);
    return said_;
  }
  std::vector<PresentDevice> devices() {
    const std::lock_guard lock(mutex_);
    return devices_;
  }

 private:
  void add(const std::string& sign, const PresentDevice& device) {
    const std::lock_guard lock(mutex_);
    said_.push_back(sign + device.found.location);
    devices_.push_back(device);
  }
  std::mutex mutex_;
  std::vector<std::string> said_;
  std::vector<PresentDevice> devices_;
};

class PresenceOnTheBus : public testing::Test {
 protected:
  void SetUp() override {
    if (!simulated_usb::Bus::available()) GTEST_SKIP() << "umockdev is not there: run under umockdev-wrapper";
    bus.emplace();
  }
  Closed inside;
  std::optional<simulated_usb::Bus> bus;
  Heard heard;
};

TEST_F(PresenceOnTheBus, ReportsWhatIsPresentWhatArrivesAndWhatLeaves) {
  bus->plug(touch("1", 2, false), inside);
  const PresenceMonitor monitor(heard.listener());
  ASSERT_TRUE(heard.soon(1));
  bus->plug(touch("2", 3, true), inside);
  ASSERT_TRUE(heard.soon(2));
  bus->unplug("1");
  ASSERT_TRUE(heard.soon(3));
  bus->unplug("2");
  ASSERT_TRUE(heard.soon(4));
  EXPECT_EQ(heard.all(), (std::vector<std::string>{"+USB 1-1, 2988:0302", "+USB 1-2, 2988:0302", "-USB 1-1, 2988:0302",
                                                   "-USB 1-2, 2988:0302"}));
  EXPECT_EQ(heard.devices()[2].kind, KnownDevice::touch_serial);
  EXPECT_EQ(heard.devices()[3].kind, KnownDevice::touch_hid);
}

TEST_F(PresenceOnTheBus, ReportsAUnitThatIsReplugged) {
  bus->plug(touch("1", 2, false), inside);
  const PresenceMonitor monitor(heard.listener());
  ASSERT_TRUE(heard.soon(1));
  bus->unplug("1");
  bus->plug(touch("1", 3, false), inside);
  ASSERT_TRUE(heard.soon(3));
  EXPECT_EQ(heard.all()[1].front(), '-');
  EXPECT_EQ(heard.all()[2].front(), '+');
}

TEST_F(PresenceOnTheBus, SendsNothingToAnyDeviceAndIgnoresOthers) {
  simulated_usb::Description mouse = touch("5", 9, true);
  mouse.vendor = 0x046D;
  mouse.product = 0xC077;
  bus->plug(mouse, inside);
  bus->plug(touch("1", 2, false), inside);
  {
    const PresenceMonitor monitor(heard.listener());
    ASSERT_TRUE(heard.soon(1));
    bus->unplug("5");
    bus->unplug("1");
    ASSERT_TRUE(heard.soon(2));
  }
  EXPECT_EQ(inside.spoken_to, 0);
  for (const std::string& said : heard.all()) EXPECT_TRUE(says(said, "1-1")) << said;
}

TEST_F(PresenceOnTheBus, StartsAndStopsCleanlyAndIsSilentAfterwards) {
  for (int i = 0; i < 10; ++i) {
    bus->plug(touch("1", 2 + i, i % 2 == 0), inside);
    {
      const PresenceMonitor monitor(heard.listener());
      if (i % 3 == 0) std::this_thread::sleep_for(2ms);
      if (i % 2 == 0) bus->unplug("1");
    }
    const std::size_t said = heard.all().size();
    if (i % 2 == 1) bus->unplug("1");
    std::this_thread::sleep_for(2ms);
    EXPECT_EQ(heard.all().size(), said);
  }
}

TEST_F(PresenceOnTheBus, TheSearchListsTheClosedOnesWithTheNextStep) {
  bus->plug(touch("1", 2, false), inside);
  simulated_usb::Description omega = touch("2", 3, false);
  omega.vendor = 0x1451;
  omega.product = 0x0402;
  omega.name = "omega.x haptic device";
  bus->plug(omega, inside);
  simulated_usb::Description falcon = touch("3", 4, false);
  falcon.vendor = 0x0403;
  falcon.product = 0xCB48;
  bus->plug(falcon, inside);
  const auto found = findClosed();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "3D Systems Touch (USB serial)");
  EXPECT_EQ(found[0].driver, "OpenHaptics by 3D Systems");
  EXPECT_EQ(found[1].name, "Force Dimension omega.x haptic device");
  EXPECT_EQ(found[1].advice, "is not driven by Molar, use another device");
}

}  // namespace
}  // namespace haptics
