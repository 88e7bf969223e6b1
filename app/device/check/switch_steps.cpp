#include <chrono>
#include <cmath>

#include <fmt/core.h>

#include "app/device/check/check_steps.h"

namespace app {
namespace {

std::string yesNo(bool first, bool then) {
  return std::string(first ? "yes" : "no") + ", then " + (then ? "yes" : "no");
}

std::string bitsOf(std::uint32_t buttons) { return buttons == 0 ? "none" : fmt::format("bits {:x}", buttons); }

}  // namespace

bool checkInkwell(CheckBench& bench) {
  if (!bench.device.has_inkwell) {
    bench.sawNone("inkwell");
    return bench.confirm(OwnerTask::hold, "Take the handle into your hand.");
  }
  if (!bench.confirm(OwnerTask::rest, "Put the stylus into its inkwell.")) return false;
  const ConstantForceLoop::Seen inside = stateAtRest(bench);
  if (!bench.confirm(OwnerTask::hold, "Take it out and hold it in the middle of its room.")) return false;
  const ConstantForceLoop::Seen outside = stateAtRest(bench);
  bench.saw("inkwell says docked", "yes, then no", yesNo(inside.state.docked, outside.state.docked),
            inside.state.docked && !outside.state.docked, Evidence::inkwell);
  const bool is_calibrated = outside.state.calibrated;
  bench.saw("pose is calibrated", "yes", is_calibrated ? "yes" : "no", is_calibrated, Evidence::calibration);
  return true;
}

bool checkDeadman(CheckBench& bench) {
  if (!bench.device.has_deadman) {
    bench.sawNone("deadman");
    return true;
  }
  if (!bench.confirm(OwnerTask::hold, "Hold the stylus as you would at work.")) return false;
  const bool held = stateAtRest(bench).state.held;
  if (!bench.confirm(OwnerTask::let_go, "Let go of it.")) return false;
  const bool left = stateAtRest(bench).state.held;
  if (!bench.confirm(OwnerTask::hold, "Hold it again.")) return false;
  bench.saw("deadman feels a hand", "yes, then no", yesNo(held, left), held && !left, Evidence::deadman);
  return true;
}

bool checkButtons(CheckBench& bench) {
  const std::uint32_t before = bench.hand.newest().state.buttons;
  if (!bench.confirm(OwnerTask::first_button, "Hold the first button down.")) return false;
  const std::uint32_t first = stateAtRest(bench).state.buttons;
  if (!bench.confirm(OwnerTask::second_button,
                     "Hold the second button down, the first one not; if there is none, nothing."))
    return false;
  const std::uint32_t second = stateAtRest(bench).state.buttons;
  if (!bench.confirm(OwnerTask::hold, "Let the buttons go.")) return false;
  const bool is_right = before == 0 && first == 1 && (second == 2 || second == 0);
  bench.saw("buttons: free, first, second", "none, bits 1, bits 2",
            bitsOf(before) + ", " + bitsOf(first) + ", " + bitsOf(second), is_right);
  return true;
}

bool checkAxes(CheckBench& bench) {
  if (!bench.confirm(OwnerTask::upper_corner,
                     "Bring the handle to the right, upward and towards you, as far as it goes easily."))
    return false;
  const glm::dvec3 upper_mm = stateAtRest(bench).state.X_DH.translation_mm;
  if (!bench.confirm(OwnerTask::lower_corner, "Now to the left, downward and away from you.")) return false;
  const glm::dvec3 lower_mm = stateAtRest(bench).state.X_DH.translation_mm;
  if (!bench.confirm(OwnerTask::hold, "Bring it back to the middle.")) return false;
  stateAtRest(bench);

  const glm::dvec3 way_mm = upper_mm - lower_mm;
  const glm::dvec3 found_mm(glm::dot(way_mm, bench.axes.right_D), glm::dot(way_mm, bench.axes.up_D),
                            glm::dot(way_mm, bench.axes.towards_D));
  constexpr double kMin_mm = 20.0;
  const bool is_right = found_mm.x > kMin_mm && found_mm.y > kMin_mm && found_mm.z > kMin_mm;
  bench.saw("from corner to corner: right, up, towards you", "more than 20 mm each",
            fmt::format("{:.0f}, {:.0f}, {:.0f} mm", found_mm.x, found_mm.y, found_mm.z), is_right, Evidence::axes);
  return true;
}

bool checkRate(CheckBench& bench, double rate_Hz, double seconds) {
  bench.dialogue.say(fmt::format("  Hold it quietly for {:g} s.", seconds));
  const std::uint64_t ticks_before = bench.hand.ticks();
  const std::int64_t begun_ns = bench.hand.now_ns();
  bench.hand.wait(std::chrono::milliseconds(std::llround(1e3 * seconds)));
  const double taken_s = 1e-9 * static_cast<double>(bench.hand.now_ns() - begun_ns);
  const double found_Hz = static_cast<double>(bench.hand.ticks() - ticks_before) / taken_s;
  const haptics::LoopFigures figures = bench.hand.figures();
  const bool is_right = std::abs(found_Hz - rate_Hz) < 0.02 * rate_Hz;
  bench.saw("rate", fmt::format("{:.0f} Hz", rate_Hz), fmt::format("{:.1f} Hz", found_Hz), is_right, Evidence::rate);
  bench.saw("a tick wakes late", "under 1000 µs",
            fmt::format("{:.0f} µs in the middle, {:.0f} µs at 99 %, {:.0f} µs at worst, {} ticks missed",
                        figures.late_p50_us, figures.late_p99_us, figures.late_max_us, figures.missed),
            figures.late_p99_us < 1000.0);
  return true;
}

}  // namespace app
