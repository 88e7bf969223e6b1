// A device under one constant force, for checking it: through the whole safety layer and the motor gate, like any other
// force. Frame D; N. push(), rearm(), newest(): one other thread. The force counts as active by nature, so the
// passivity controller does not withhold it; every other limit holds.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

#include "haptics/latest.h"
#include "haptics/loop/device_loop.h"
#include "haptics/safety/safety_layer.h"

namespace app {

class ConstantForceLoop final : public haptics::DeviceLoop {
 public:
  struct Seen {
    haptics::HandleState state;
    haptics::SafetyState safety = haptics::SafetyState::off;
    glm::dvec3 pushed_D_N{0.0};  ///< delivered force …
    glm::dvec3 lately_D_N{0.0};  ///< … and its mean over the last quarter of a second
    std::uint32_t tripped = 0;   ///< faults ever, as bits
    std::uint64_t ticks = 0;
  };

  /// Borrows the device. Throws DeviceError when it does not support the rate.
  ConstantForceLoop(haptics::ServedDevice served, double rate_Hz);
  ~ConstantForceLoop() override { stop(); }

  void push(const glm::dvec3& force_D_N) { requested_D_N_.publish(force_D_N); }
  /// Clears latched faults whose cause is over.
  void rearm() { rearm_.fetch_add(1); }
  const Seen& newest() { return newest_.read(); }

  const haptics::SafetyLimits& limits() const { return limits_; }

  /// Lets the device tick for this time: stepped, or by waiting.
  void wait(std::chrono::milliseconds time);
  using DeviceLoop::now_ns;

 private:
  Answer answer(const haptics::HandleState& state, const haptics::TickTiming& timing) noexcept override;

  const bool is_stepped_;
  const haptics::SafetyLimits limits_;
  haptics::Latest<glm::dvec3> requested_D_N_{glm::dvec3(0.0)};
  haptics::Latest<Seen> newest_;
  std::atomic<std::uint64_t> rearm_{0};

  // Of the device's thread.
  haptics::SafetyLayer safety_;
  Seen seen_;
  glm::dvec3 last_mm_{0.0};
  bool has_last_ = false;
};

}  // namespace app
