// Shared by the tests of the OpenHaptics back-end: a fresh stand-in library for each, and a servo that pushes.
#pragma once

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <thread>

#include "haptics/device/openhaptics/open_haptics.h"
#include "haptics/safety/motor_gate.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/stand_in_hd/stand_in_hd.h"

namespace haptics::open_haptics_bench {

/// Pushes with a constant force and keeps the states.
class Pusher final : public DeviceServo {
 public:
  explicit Pusher(const glm::dvec3& force_N = {}) : gate_(strong()), force_N_(force_N) {}

  void begin() noexcept override { ++begun; }
  MotorCommand tick(const HandleState& state, const TickTiming& timing) noexcept override {
    {
      const std::lock_guard lock(mutex_);
      state_ = state;
    }
    if (ticks == slow_at_tick) std::this_thread::sleep_for(std::chrono::milliseconds(slow_ms));
    for (held_up = ticks == hold_at_tick; held_up && ticks == hold_at_tick;)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    held_up = false;
    max_speed_mm_per_s = std::max(max_speed_mm_per_s.load(), state.velocity_D_mm_per_s.xyz.x);
    if (ticks == 100) allocations_at_100 = allocation_count::now();
    if (ticks == 500) allocations_at_500 = allocation_count::now();
    missed += static_cast<long>(timing.missed);
    late_max_us = std::max(late_max_us.load(), timing.late_us);
    unhealthy += state.healthy ? 0 : 1;
    uncalibrated += state.calibrated ? 0 : 1;
    ++ticks;
    return gate_.admit({{force_N_}, {}}, glm::dmat3(0.0), pushes);
  }
  HandleState state() {
    const std::lock_guard lock(mutex_);
    return state_;
  }

  std::atomic<long> ticks{0}, missed{0}, unhealthy{0}, uncalibrated{0}, slow_at_tick{-1}, hold_at_tick{-1};
  std::atomic<int> begun{0}, slow_ms{0};
  std::atomic<double> late_max_us{0.0}, max_speed_mm_per_s{0.0};
  std::atomic<bool> pushes{true}, held_up{false};
  std::atomic<std::size_t> allocations_at_100{0}, allocations_at_500{0};  ///< of the whole process

 private:
  static DeviceCapabilities strong() {
    DeviceCapabilities device;
    device.peak_force_N = 100.0;
    return device;
  }

  MotorGate gate_;
  glm::dvec3 force_N_;
  std::mutex mutex_;
  HandleState state_;
};

class OpenHapticsBench : public testing::Test {
 protected:
  OpenHapticsBench() { door.reset(); }
  ~OpenHapticsBench() override {
    EXPECT_THAT(door.seen.violations, testing::IsEmpty());
    EXPECT_EQ(door.open_devices(), 0);
  }

  static stand_in::StandIn& open() {
    void* loaded = dlopen(STAND_IN_FOLDER "/whole/libHD.so.3.5", RTLD_NOW | RTLD_LOCAL);
    return *reinterpret_cast<stand_in::StandIn* (*)()>(dlsym(loaded, "standIn"))();
  }

  /// Independent of the load of the machine.
  static void until(const std::function<bool()>& done) {
    for (int i = 0; i < 20'000 && !done(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_TRUE(done());
  }
  static void runFor(Pusher& servo, long more) {
    const long then = servo.ticks + more;
    until([&] { return servo.ticks >= then; });
  }
  double forceNow_N() const {
    return std::hypot(door.seen.force_N[0].load(), door.seen.force_N[1].load(), door.seen.force_N[2].load());
  }
  double strongest_N() const {
    return std::hypot(door.seen.strongest_N[0].load(), door.seen.strongest_N[1].load(),
                      door.seen.strongest_N[2].load());
  }
  bool saw(const std::string& event) const { return std::ranges::count(door.seen.events, event) > 0; }

  HdLibrary library{STAND_IN_FOLDER "/whole/libHD.so.3.5"};
  stand_in::StandIn& door = open();
};

}  // namespace haptics::open_haptics_bench
