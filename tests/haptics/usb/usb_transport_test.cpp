#include "haptics/device/usb/usb_transport.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "haptics/device/haptic_device.h"
#include "haptics/device/monotonic_clock.h"
#include "tests/haptics/usb/simulated_usb.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;
using simulated_usb::Bus;
using simulated_usb::Bytes;

/// Says the last bytes it was told, a count in front, once per millisecond; remembers everything it was told.
class Echo : public simulated_usb::Device {
 public:
  void onOut(std::uint8_t, std::span<const std::uint8_t> bytes, double) override {
    told.emplace_back(bytes.begin(), bytes.end());
  }
  std::optional<Bytes> onIn(std::uint8_t, double t_s) override {
    if (t_s < next_s) return {};
    next_s = t_s + 1e-3;
    Bytes said(report_bytes);
    if (!said.empty()) said[0] = static_cast<std::uint8_t>(++count);
    if (!told.empty() && said.size() > 1) said[1] = told.back().at(0);
    return said;
  }
  std::optional<Bytes> onControl(const simulated_usb::Setup& setup, std::span<const std::uint8_t> data,
                                 double) override {
    if (setup.request == 99) return {};
    if ((setup.type & 0x80) != 0) return Bytes{setup.request, static_cast<std::uint8_t>(setup.value & 0xff)};
    controlled.assign(data.begin(), data.end());
    return Bytes{};
  }
  std::vector<Bytes> told;
  Bytes controlled;
  std::size_t report_bytes = 4;
  int count = 0;
  double next_s = 0.0;
};

simulated_usb::Description interruptDevice() {
  simulated_usb::Description d;
  d.vendor = 0x1234;
  d.product = 6;
  d.serial = "FS0001";
  return d;
}

UsbReport report(std::uint8_t first, std::size_t size = 4) {
  Bytes bytes(size);
  bytes[0] = first;
  return UsbReport(bytes);
}

UsbStream echoStream() {
  UsbStream stream;
  stream.report_bytes = 4;
  stream.rest = report(0);
  return stream;
}

/// However busy the machine is.
template <class Condition>
bool soon(const Condition& holds) {
  for (int i = 0; i < 10'000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

class UsbTransportOnTheBus : public testing::Test {
 protected:
  void SetUp() override {
    if (!Bus::available()) GTEST_SKIP() << "umockdev is not there: run under umockdev-wrapper";
    bus.emplace();
    bus->plug(interruptDevice(), echo);
  }
  template <class T>
  T now(const T& value) {
    T copy{};
    bus->locked([&] { copy = value; });
    return copy;
  }
  Echo echo;
  std::optional<Bus> bus;
};

TEST_F(UsbTransportOnTheBus, ReadsPipesFromTheDescriptors) {
  UsbTransport usb({0x1234, 6});
  EXPECT_EQ(usb.inPacketBytes(), 64u);
  EXPECT_EQ(usb.outPacketBytes(), 64u);
  EXPECT_EQ(usb.path(), "1-1");
  EXPECT_EQ(usb.serialNumber(), "FS0001");
}

TEST_F(UsbTransportOnTheBus, CarriesReportsBothWays) {
  UsbTransport usb({0x1234, 6});
  usb.run(echoStream());
  std::uint64_t serial = 0;
  for (int i = 1; i <= 100; ++i) {
    usb.send(report(static_cast<std::uint8_t>(i)), usb.rests());
    ASSERT_TRUE(soon([&] { return usb.newestReport().bytes[1] == i; })) << i;
    EXPECT_GT(usb.newestReport().serial, serial);
    serial = usb.newestReport().serial;
  }
  EXPECT_EQ(usb.state(), UsbState::ok);
  EXPECT_EQ(usb.counters().reports_out, 100u);
}

}  // namespace
}  // namespace haptics
