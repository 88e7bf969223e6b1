#include "tests/haptics/stand_in_hd/stand_in_machine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace stand_in {
namespace {

// An Omni's mass and friction, and a light grip (reference/devices 4.3).
constexpr double kMass_kg = 0.1, kFriction_Ns_per_mm = 0.01, kGrip_N_per_mm = 0.3, kHandStep_mm = 0.3;
constexpr hd::DeviceId kDevice = 7;
constexpr hd::ScheduleId kSchedule = 3;

std::string hex(unsigned number) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%04X", number);
  return text;
}

}  // namespace

Machine& Machine::only() {
  static Machine machine;
  return machine;
}

void Machine::reset() {
  Script& s = door_.script;
  s.model = "PHANTOM Omni";
  s.init_error = s.error_code = s.refused_rate_Hz = s.schedule_error = 0;
  s.calibration_style = 2;
  s.calibrated = s.docked_value = s.held = true;
  s.docked = s.garbage = s.hangs = false;
  s.buttons = s.slow_ms = 0;
  s.input_dof = 6;
  s.update_rate_Hz = 1000;
  s.max_force_N = 3.3;
  s.heat = 0.1;
  const std::array<double, 3> inkwell_mm{0.0, -65.5, -88.1};
  for (std::size_t i = 0; i < 3; ++i) {
    s.hand_mm[i] = door_.seen.position_mm[i] = hand_mm_[i] = inkwell_mm[i];
    s.joints_rad[i] = s.gimbal_rad[i] = door_.seen.force_N[i] = door_.seen.strongest_N[i] = 0.0;
    force_N_[i] = velocity_mm_per_s_[i] = 0.0;
  }
  for (std::size_t i = 0; i < 16; ++i) s.turn[i] = i % 5 == 0 ? 1.0 : 0.0;
  for (auto& property : s.unknown_properties) property = 0;
  s.slow_at_tick = -1;
  s.unplugged = false;
  s.error_times = 1;
  Seen& seen = door_.seen;
  seen.ticks = seen.frames = seen.calibration_updates = 0;
  seen.motors_on = seen.hanging = false;
  seen.events.clear();
  seen.violations.clear();
  open_ = in_frame_ = pushing_ = false;
  errors_.clear();
  callback_ = nullptr;
  rate_Hz_ = 1000;
}

void Machine::note(const std::string& event) {
  const std::lock_guard lock(texts_);
  door_.seen.events.push_back(event);
}

void Machine::breach(const std::string& what) {
  const std::lock_guard lock(texts_);
  if (door_.seen.violations.size() < 50) door_.seen.violations.push_back(what);
}

void Machine::enter(const char* call, bool needs_frame) {
  if (!open_) return breach(std::string(call) + " without a device");
  if (running_ && std::this_thread::get_id() != thread_.get_id())
    return breach(std::string(call) + " from another thread while the scheduler runs");
  if (needs_frame && !in_frame_) breach(std::string(call) + " outside a frame");
}

void Machine::raise(unsigned code) {
  if (errors_.size() < 100) errors_.push_back(code);
}

hd::ErrorInfo Machine::takeError() {
  if (running_ && std::this_thread::get_id() != thread_.get_id()) breach("hdGetError from another thread");
  if (errors_.empty()) return {0, 0, hd::kNoDevice};
  const unsigned code = errors_.back();
  errors_.pop_back();
  return {code, -static_cast<int>(code), kDevice};
}

hd::DeviceId Machine::init(const char* name) {
  note(std::string("init ") + (name ? name : "default"));
  if (open_) breach("a second initialisation");
  if (const unsigned code = door_.script.init_error) {
    raise(code);
    return hd::kNoDevice;
  }
  open_ = true;
  return kDevice;
}

void Machine::disableDevice(hd::DeviceId id) {
  enter("hdDisableDevice");
  note("disable device");
  if (id != kDevice) breach("disabling a device that is none");
  if (running_) breach("device disabled while the scheduler runs");
  if (door_.seen.motors_on) breach("device disabled with its motors on");
  if (callback_) breach("device disabled with a callback in place");
  open_ = false;
}

void Machine::beginFrame(hd::DeviceId id) {
  enter("hdBeginFrame");
  if (id != kDevice) raise(0x0104);
  if (in_frame_) {
    breach("hdBeginFrame inside a frame");
    raise(0x0400);
  }
  if (running_ && frames_this_tick_++ > 0) breach("a second frame in one tick");
  in_frame_ = true;
  force_N_ = {};
  if (door_.script.unplugged) raise(hd::kCommunicationError);
}

void Machine::endFrame(hd::DeviceId id) {
  enter("hdEndFrame");
  if (id != kDevice) raise(0x0104);
  if (!in_frame_) {
    breach("hdEndFrame without hdBeginFrame");
    raise(0x0401);
    return;
  }
  in_frame_ = false;
  Script& s = door_.script;
  Seen& seen = door_.seen;
  const double length_N = std::hypot(force_N_[0], force_N_[1], force_N_[2]);
  const bool pushes = length_N > 0.0;
  if (pushes && !seen.motors_on) breach("a force while the motors are off");
  if (length_N > s.max_force_N) raise(0x0201);
  if (pushes != pushing_) note(pushes ? "force begins" : "force ends");
  pushing_ = pushes;
  const double strongest_N = std::hypot(seen.strongest_N[0], seen.strongest_N[1], seen.strongest_N[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    seen.force_N[i] = force_N_[i];
    if (length_N > strongest_N) seen.strongest_N[i] = force_N_[i];
  }
  if (s.unplugged) raise(hd::kCommunicationError);
  if (const unsigned code = s.error_code.exchange(0))
    for (int i = 0; i < s.error_times; ++i) raise(code);
  ++seen.frames;
}

void Machine::switchMotors(hd::Enum what, bool on) {
  enter(on ? "hdEnable" : "hdDisable");
  note((on ? "enable " : "disable ") + hex(what));
  if (what != hd::kForceOutput) return;
  if (!on && pushing_) breach("motors off in the middle of a force");
  door_.seen.motors_on = on;
}

void Machine::setForce(const double* force_N) {
  enter("hdSetDoublev", true);
  std::copy_n(force_N, 3, force_N_.begin());
  for (double part : force_N_)
    if (!std::isfinite(part)) breach("a force that is not a number");
}

hd::Enum Machine::calibration() {
  enter("hdCheckCalibration", true);
  const Script& s = door_.script;
  if (s.calibrated) return hd::kCalibrationOk;
  const bool waits_for_hand = s.calibration_style == 1 || (s.calibration_style == 4 && !s.docked);
  return waits_for_hand ? hd::kCalibrationNeedsManualInput : hd::kCalibrationNeedsUpdate;
}

void Machine::updateCalibration(hd::Enum style) {
  enter("hdUpdateCalibration", true);
  note("update calibration " + std::to_string(style));
  Script& s = door_.script;
  if (style == 0 || (static_cast<unsigned>(s.calibration_style) & style) != style) breach("an update of another style");
  ++door_.seen.calibration_updates;
  s.calibrated = true;
}

bool Machine::isUnknown(hd::Enum property) {
  for (const auto& unknown : door_.script.unknown_properties)
    if (unknown == property) {
      raise(0x0100);
      return true;
    }
  return false;
}

void Machine::setRate(unsigned long rate_Hz) {
  enter("hdSetSchedulerRate");
  if (rate_Hz == door_.script.refused_rate_Hz) return raise(0x0101);
  rate_Hz_ = rate_Hz;
}

hd::ScheduleId Machine::schedule(hd::Callback callback, void* data, unsigned short priority) {
  enter("hdScheduleAsynchronous");
  note("schedule " + std::to_string(priority));
  if (const unsigned code = door_.script.schedule_error) raise(code);
  callback_ = callback;
  data_ = data;
  return kSchedule;
}

void Machine::unschedule(hd::ScheduleId id) {
  enter("hdUnschedule");
  note("unschedule");
  if (id != kSchedule || !callback_) breach("unscheduling what is not scheduled");
  callback_ = nullptr;
}

void Machine::startScheduler() {
  enter("hdStartScheduler");
  note("start");
  if (running_) return breach("a second start of the scheduler");
  door_.seen.ticks = 0;
  // The thread compares itself with thread_, so it waits until that is set.
  const std::lock_guard lock(texts_);
  running_ = true;
  thread_ = std::thread([this] { run(); });
}

void Machine::stopScheduler() {
  if (running_ && std::this_thread::get_id() == thread_.get_id()) return breach("the scheduler stopped by itself");
  note("stop");
  running_ = false;
  if (thread_.joinable()) thread_.join();
}

void Machine::run() {
  { const std::lock_guard lock(texts_); }
  auto due = std::chrono::steady_clock::now();
  while (running_) {
    const Script& s = door_.script;
    door_.seen.hanging = s.hangs.load();
    if (!s.hangs) {
      if (door_.seen.ticks == s.slow_at_tick) std::this_thread::sleep_for(std::chrono::milliseconds(s.slow_ms));
      frames_this_tick_ = 0;
      if (callback_ && callback_(data_) == hd::kCallbackDone) callback_ = nullptr;
      if (in_frame_) breach("a callback that leaves its frame open");
      move();
      ++door_.seen.ticks;
    }
    due = std::max(due + std::chrono::nanoseconds(1'000'000'000 / rate_Hz_), std::chrono::steady_clock::now());
    std::this_thread::sleep_until(due);
  }
}

/// A tick of a mass on the grip's spring, with the force of the last frame; implicit in the velocity.
void Machine::move() {
  Script& s = door_.script;
  Seen& seen = door_.seen;
  const double dt_s = 1.0 / static_cast<double>(rate_Hz_);
  const double mass_t = 1e-3 * kMass_kg;  // tonnes: N s²/mm
  for (std::size_t i = 0; i < 3; ++i) {
    hand_mm_[i] += std::clamp(s.hand_mm[i] - hand_mm_[i], -kHandStep_mm, kHandStep_mm);
    const double force_N = seen.motors_on ? seen.force_N[i].load() : 0.0;
    const double pull_N = kGrip_N_per_mm * (hand_mm_[i] - seen.position_mm[i]);
    const double momentum = mass_t * velocity_mm_per_s_[i] + dt_s * (force_N + pull_N);
    velocity_mm_per_s_[i] = momentum / (mass_t + dt_s * kFriction_Ns_per_mm);
    seen.position_mm[i] = seen.position_mm[i] + dt_s * velocity_mm_per_s_[i];
  }
}

}  // namespace stand_in
