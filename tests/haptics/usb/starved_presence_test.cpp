#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "haptics/device/usb/presence.h"
#include "tests/haptics/starved_threads.h"
#include "tests/haptics/usb/simulated_usb.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

class Mute final : public simulated_usb::Device {
 public:
  void onOut(std::uint8_t, std::span<const std::uint8_t>, double) override {}
  std::optional<simulated_usb::Bytes> onIn(std::uint8_t, double) override { return {}; }
  std::optional<simulated_usb::Bytes> onControl(const simulated_usb::Setup&, std::span<const std::uint8_t>,
                                                double) override {
    return {};
  }
};

TEST(StarvedPresence, EndsAndReportsIt) {
  if (!simulated_usb::Bus::available()) GTEST_SKIP() << "umockdev is not there: run under umockdev-wrapper";
  Mute inside;
  simulated_usb::Bus bus;
  simulated_usb::Description touch;
  touch.vendor = 0x2988;
  touch.product = 0x0302;
  touch.device_class = 2;
  touch.port.assign(1, '1');
  touch.number = 2;
  bus.plug(touch, inside);

  std::atomic<bool> ended{false}, arrived{false};
  PresenceListener listener;
  listener.arrived = [&](const PresentDevice&) { arrived.store(true); };
  listener.ended = [&] { ended.store(true); };
  starve(true);
  {
    const PresenceMonitor monitor(listener);
    // As long as it takes on a busy machine.
    for (int i = 0; i < 30'000 && !ended.load(); ++i) std::this_thread::sleep_for(1ms);
    EXPECT_TRUE(ended.load());
    EXPECT_FALSE(arrived.load());
  }
  starve(false);
}

}  // namespace
}  // namespace haptics
