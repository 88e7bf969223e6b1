#include "haptics/safety/trips.h"

#include <algorithm>
#include <bit>

namespace haptics {
namespace {

constexpr std::string_view kNothing = "Nothing needs to be done.";

const std::array<StateText, 6> kStates = {{
    {"off", "The force is off for good.", "End the rehearsal and start it again."},
    {"calibrate", "The device does not know yet where its handle is.",
     "Put the handle into its inkwell, or move it as the device asks."},
    {"ready", "There is no force yet.", "Take the tool out of the tissue and hold it still for a moment."},
    {"armed", "There will be force as soon as a hand is felt.", "Take hold of the handle."},
    {"active", "The hand feels the tissue.", kNothing},
    {"fault", "The force is off because something failed.", "See to the cause, then lift the fault at the desk."},
}};

}  // namespace

const std::array<TripText, kTripKinds> kTrips = {{
    {Fault::bad_pose, "bad_pose", "The device said that the hand is where no hand can be.",
     "If it comes again, check the cable and calibrate the device."},
    {Fault::bad_force, "bad_force", "The force law gave no number.",
     "Choose another law or other settings, and keep the session for a report."},
    {Fault::clamped, "clamped", "The force asked for was above the limit.", kNothing},
    {Fault::slewed, "slewed", "The force asked for changed faster than the limit.", kNothing},
    {Fault::device, "device", "The device reported trouble, or is gone.",
     "Check its cable and power, then lift the fault at the desk."},
    {Fault::joints, "joints", "The force asked for was more than the arm's joints can bear there.", kNothing},
    {Fault::hot, "hot", "The motors are warm, so the force is lowered.", "Press less, or rest for half a minute."},
    {Fault::stale, "stale", "The device fell silent for some milliseconds.",
     "If it comes again, check the cable and what else runs on this machine."},
    {Fault::resumed, "resumed", "The haptic loop had paused; it begins anew, without force.",
     "Take the tool out of the tissue and hold it still for a moment."},
    {Fault::braked, "braked", "The hand was fast and was braked.", "Move more slowly."},
    {Fault::too_fast, "too_fast", "The hand was so fast that the force was taken away for a tenth of a second.",
     "Move more slowly."},
    {Fault::buzz, "buzz", "The contact shook, so the force was lowered.",
     "Hold the handle more firmly; if it comes again, lower the stiffness of the law."},
    {Fault::overdrawn, "overdrawn", "The hand was given more energy than it had put in, so the force was let go of.",
     "If it comes again with this law, lower its stiffness."},
    {Fault::let_go, "let_go", "The handle was let go of, so the force was let down.",
     "Take hold of it outside the tissue."},
    {Fault::latched, "latched", "The force stays off until the instructor lifts the fault.",
     "See to the cause, then lift the fault at the desk."},
    {Fault::stopped, "stopped", "An emergency stop took the force away for good.",
     "End the rehearsal and start it again."},
}};

const StateText& textOf(SafetyState state) {
  return kStates[std::min(static_cast<std::size_t>(state), kStates.size() - 1)];
}

void TripCounter::add(std::uint64_t tick, Fault faults) noexcept {
  for (std::size_t bit = 0; bit < kTripKinds; ++bit) {
    const auto one = static_cast<Fault>(std::uint32_t{1} << bit);
    if (!has(faults, one)) continue;
    Entry& entry = entries_[bit];
    if (entry.times == 0) entry.first_tick = tick;
    if (!has(last_, one)) ++entry.times;
    entry.last_tick = tick;
  }
  last_ = faults;
}

const TripCounter::Entry& TripCounter::of(Fault one) const noexcept {
  const int bit = std::countr_zero(static_cast<std::uint32_t>(one));
  return entries_[std::min(static_cast<std::size_t>(bit), kTripKinds - 1)];
}

}  // namespace haptics
