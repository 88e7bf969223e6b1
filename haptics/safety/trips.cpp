#include "haptics/safety/trips.h"

#include <algorithm>
#include <bit>

namespace haptics {
namespace {

constexpr std::string_view kNothing = "Nothing needs to be done.";

const std::array<StateText, 6> kStates = {{
    {"off", "The force is off for the rest of the session.", "End the rehearsal and start it again."},
    {"calibrate", "The device is not calibrated yet.",
     "Put the handle into its inkwell, or move it as the device requires."},
    {"ready", "There is no force yet.", "Take the tool out of the tissue and hold it still for a moment."},
    {"armed", "There will be force as soon as a hand is detected.", "Take hold of the handle."},
    {"active", "The hand feels the tissue.", kNothing},
    {"fault", "The force is off because something failed.",
     "Remove the cause, then clear the fault in the instructor's panel."},
}};

}  // namespace

const std::array<TripText, kTripKinds> kTrips = {{
    {Fault::bad_pose, "bad_pose", "The device reported an impossible pose of the hand.",
     "If it comes again, check the cable and calibrate the device."},
    {Fault::bad_force, "bad_force", "The force law gave a force that is not finite.",
     "Choose another law or other settings, and keep the session for a report."},
    {Fault::clamped, "clamped", "The requested force was above the limit.", kNothing},
    {Fault::slewed, "slewed", "The requested force changed faster than the limit.", kNothing},
    {Fault::device, "device", "The device reported a failure or was disconnected.",
     "Check its cable and power, then clear the fault in the instructor's panel."},
    {Fault::joints, "joints", "The requested force was more than the arm's joints can bear there.", kNothing},
    {Fault::hot, "hot", "The motors are warm, so the force is lowered.", "Press less, or rest for half a minute."},
    {Fault::stale, "stale", "The device sent no data for some milliseconds.",
     "If it comes again, check the cable and what else runs on this machine."},
    {Fault::resumed, "resumed", "The haptic loop paused and restarted without force.",
     "Take the tool out of the tissue and hold it still for a moment."},
    {Fault::braked, "braked", "The hand was fast and was braked.", "Move more slowly."},
    {Fault::too_fast, "too_fast", "The hand was too fast; the force was off for a tenth of a second.",
     "Move more slowly."},
    {Fault::buzz, "buzz", "The contact oscillated, so the force was lowered.",
     "Hold the handle more firmly; if it comes again, lower the stiffness of the law."},
    {Fault::overdrawn, "overdrawn", "The hand got more energy than it had put in, so the force was released.",
     "If it comes again with this law, lower its stiffness."},
    {Fault::let_go, "let_go", "The handle was released, so the force was lowered to zero.",
     "Take hold of it outside the tissue."},
    {Fault::latched, "latched", "The force stays off until the instructor lifts the fault.",
     "Remove the cause, then clear the fault in the instructor's panel."},
    {Fault::stopped, "stopped", "An emergency stop switched the force off for the rest of the session.",
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
