// A stepped simulated device: the same twice, and the same as on its own thread.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "haptics/device/simulated/pose_list_device.h"
#include "haptics/device/simulated/scripted_device.h"
#include "haptics/device/simulated/simulated_phantom.h"
#include "haptics/device/simulated/work_cycle.h"
#include "haptics/servo/haptic_loop.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;

assets::PlannedCut shortCut() {
  assets::StraightCut cut;
  cut.outward_P = {0.0, 0.0, 1.0};
  cut.lateral_P = {0.0, 1.0, 0.0};
  cut.length_mm = 6.0;
  cut.depth_mm = 1.0;
  return assets::plannedAlong(cut);
}

const CuttingMotion kQuickly{.speed_mm_per_s = 20.0, .clearance_mm = 3.0};

std::unique_ptr<SimulatedDevice> scripted() { return std::make_unique<ScriptedDevice>(shortCut(), kQuickly); }

std::unique_ptr<SimulatedDevice> simulatedTouch() {
  const PhantomMechanics& touch = *findSimulatedPhantom("touch");
  const auto rest_DH = touch.rest_DH();
  const WorkCycle round(TroughPath(shortCut(), kQuickly), {rest_DH.translation_mm, rest_DH.rotation, false, 0, true},
                        {{0.0, 0.0, 40.0}});
  return std::make_unique<SimulatedPhantom>(touch, [round](double t_s) { return round.at(t_s); });
}

std::unique_ptr<SimulatedDevice> posed() {
  std::vector<TimedHandlePose> holds;
  for (int n = 0; n < 60; ++n)
    holds.push_back(
        {0.1 * n, {glm::angleAxis(0.02 * n, glm::dvec3(0, 1, 0)), {n % 2 - 0.5, 0.0, 3.0 - 0.05 * n}}, n > 10});
  return std::make_unique<PoseListDevice>(holds);
}

struct Hand {
  const char* name;
  std::function<std::unique_ptr<SimulatedDevice>()> make;
};
const std::vector<Hand> kHands = {{"scripted", scripted}, {"simulated:touch", simulatedTouch}, {"poses", posed}};

Bodies bone() { return halfSpace(7.0, 0.25).bodies(1); }

LoopSettings ordinary() {
  LoopSettings settings;
  settings.priority = std::nullopt;
  return settings;
}

std::vector<Tick> stepped(SimulatedDevice& device, std::uint64_t ticks, std::uint64_t at_once) {
  Bodies block = bone();
  Servo servo(block);
  Latest<Command> commands(limitedTo(device.capabilities(), 1000.0, {}));
  TickLog log(ticks);
  Latest<Tick> newest;
  HapticLoop loop(servo, ServedDevice::steppedManually(device), commands, log, newest, ordinary());
  loop.start();
  for (std::uint64_t n = 0; n < ticks; n += at_once) loop.step(std::min(at_once, ticks - n));
  loop.stop();
  std::vector<Tick> out;
  log.drainInto(out);
  return out;
}

std::vector<Tick> ticking(SimulatedDevice& device, std::uint64_t ticks) {
  Bodies block = bone();
  Servo servo(block);
  Latest<Command> commands(limitedTo(device.capabilities(), 1000.0, {}));
  TickLog log(20 * ticks);
  Latest<Tick> newest;
  HapticLoop loop(servo, device, commands, log, newest, ordinary());
  loop.start();
  // However long a busy machine takes.
  while (loop.ticks() < ticks) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  loop.stop();
  std::vector<Tick> out;
  log.drainInto(out);
  return out;
}

/// Every column but the CPU time.
auto columns(const Tick& t) {
  return std::tuple(t.index, t.t_s, t.dt_s, t.command_serial, t.hand.X_PT.translation_mm, t.hand.X_PT.rotation,
                    t.hand.velocity_P_mm_per_s.xyz, t.hand.drill_pedal, t.hand.gap_s, t.hand.motor_heat, t.proxy_P.mm,
                    t.law_force_P_N.xyz, t.law_torque_P_Nmm.xyz, t.commanded_force_P_N.xyz,
                    t.commanded_torque_P_Nmm.xyz, t.energy_Nmm, t.spindle_rad_per_s, t.overlap_mm3, t.depth_mm,
                    t.removed_mm3, t.bone_digest, t.contact_tissue, t.drilling, t.drill_inhibit, t.strokes, t.state,
                    t.faults);
}

TEST(SteppedDevice, MakesTheSameTicksForAnyStepSize) {
  for (const Hand& hand : kHands) {
    SCOPED_TRACE(hand.name);
    const auto one = hand.make(), other = hand.make();
    const std::vector<Tick> first = stepped(*one, 5000, 16), second = stepped(*other, 5000, 1);
    ASSERT_EQ(first.size(), 5000u);
    ASSERT_EQ(second.size(), 5000u);
    double removed_mm3 = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      ASSERT_EQ(columns(first[i]), columns(second[i])) << i;
      ASSERT_EQ(first[i].work_us, 0.0f);
      removed_mm3 += first[i].removed_mm3;
    }
    EXPECT_GT(removed_mm3, 0.1) << "it does something";
  }
}

/// Pushes and pulls by the number of the tick, and keeps what was sensed.
class Scribe final : public DeviceServo {
 public:
  Scribe(const DeviceCapabilities& can, std::size_t room) : gate_(can) { sensed.reserve(room); }
  MotorCommand tick(const HandleState& state, const TickTiming&) noexcept override {
    if (sensed.size() < sensed.capacity()) sensed.push_back(state);
    const double phase = 0.01 * static_cast<double>(ticks.fetch_add(1));
    return gate_.admit({{{0.5 * std::sin(phase), 0.3 * std::cos(phase), 0.2}}, {}}, state.jacobian_D_mm, true);
  }
  std::atomic<std::uint64_t> ticks{0};
  std::vector<HandleState> sensed;

 private:
  MotorGate gate_;
};

auto columns(const HandleState& s) {
  return std::tuple(s.X_DH.translation_mm, s.X_DH.rotation, s.velocity_D_mm_per_s.xyz, s.jacobian_D_mm, s.joints_rad,
                    s.has_joints, s.buttons, s.pedal, s.fresh, s.docked, s.held, s.calibrated, s.healthy, s.motor_heat);
}

TEST(SteppedDevice, SensesTheSameOnItsOwnThreadAtAnyLateness) {
  constexpr std::size_t kTicks = 600;
  for (const Hand& hand : kHands) {
    SCOPED_TRACE(hand.name);
    const auto by_itself = hand.make(), by_hand = hand.make();
    Scribe real(by_itself->capabilities(), kTicks), fast(by_hand->capabilities(), kTicks);
    by_itself->start(real, 1000.0);
    while (real.ticks.load() < kTicks) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    by_itself->stop();
    by_hand->startStepped(fast, 1000.0);
    by_hand->step(kTicks);
    by_hand->stop();
    for (std::size_t i = 0; i < kTicks; ++i) ASSERT_EQ(columns(real.sensed[i]), columns(fast.sensed[i])) << i;
  }
}

TEST(SteppedDevice, GetsTheSameAnswersSteppedAndOnItsOwnThread) {
  for (const Hand& hand : kHands) {
    SCOPED_TRACE(hand.name);
    const auto by_itself = hand.make();
    const std::vector<Tick> real = ticking(*by_itself, 600);
    ASSERT_GE(real.size(), 600u);
    // Late or not: the tick is a function of what went in.
    Bodies block = bone();
    Servo servo(block);
    const auto same = hand.make();
    const Command command = limitedTo(same->capabilities(), 1000.0, {});
    for (const Tick& tick : real) ASSERT_EQ(columns(servo.step(tick.hand, command, tick.dt_s)), columns(tick));
  }
}

}  // namespace
}  // namespace haptics
