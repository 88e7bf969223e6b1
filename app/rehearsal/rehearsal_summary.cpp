#include "app/rehearsal/rehearsal_summary.h"

#include <numeric>

#include <fmt/core.h>

#include "app/device/trip_reporter.h"

namespace app {
namespace {

/// "real-time priority, core 3, memory locked".
std::string grantsText(const haptics::RealtimeGrants& grants) {
  const std::string core = grants.core ? fmt::format(", core {}", *grants.core) : ", no core of its own";
  return std::string(grants.priority ? "real-time priority" : "no real-time priority") + core +
         (grants.memory_locked ? ", memory locked" : ", memory not locked");
}

std::string timeText(const RehearsalStatus& last) {
  std::string text = fmt::format("  servo            {} ticks at {:.0f} Hz, {} deadlines missed, {} by its own work\n",
                                 last.servo.ticks, last.servo_rate_Hz, last.servo.missed, last.servo.overruns);
  text += fmt::format("  wake-up          late by p50 {:.0f} µs, p99 {:.0f} µs, at most {:.0f} µs\n",
                      last.servo.late_p50_us, last.servo.late_p99_us, last.servo.late_max_us);
  text += fmt::format("  work per tick    p50 {:.0f} µs, p99 {:.0f} µs, p99.9 {:.0f} µs, max {:.0f} µs\n",
                      last.servo.work_p50_us, last.servo.work_p99_us, last.servo.work_p999_us, last.servo.work_max_us);
  text += fmt::format("  granted          {}\n", grantsText(last.servo.grants));
  return text;
}

std::string steppedText(const RehearsalStatus& last) {
  return fmt::format("  servo            {} ticks at {:.0f} Hz, stepped as fast as the machine can\n", last.servo.ticks,
                     last.servo_rate_Hz);
}

}  // namespace

std::string punctualityText(const haptics::LoopFigures& servo) {
  return fmt::format(
             "{} ticks, {} deadlines missed, {} by its own work; late by {:.0f} µs, 99 % below {:.0f}, at most "
             "{:.0f}; ",
             servo.ticks, servo.missed, servo.overruns, servo.late_p50_us, servo.late_p99_us, servo.late_max_us) +
         grantsText(servo.grants);
}

std::string summaryText(const RehearsalFigures& f) {
  std::string text = "Rehearsal\n";
  text += fmt::format("  patient          {}\n", f.last.patient_title);
  text += fmt::format("  bur              {} mm\n", f.last.bur);
  text += "  calibration      " + calibrationText(f.last.calibration) + "\n";
  text += fmt::format("  duration         {:.1f} s\n", f.last.tick.t_s + f.last.tick.dt_s);
  text +=
      fmt::format("  removed          {:.1f} mm³\n", std::accumulate(f.removed_mm3.begin(), f.removed_mm3.end(), 0.0));
  for (std::size_t l = 0; l < f.removed_mm3.size(); ++l)
    if (f.removed_mm3[l] >= 0.05)
      text += fmt::format("    {:14} {:.1f} mm³\n", assets::kTissues[l].name, f.removed_mm3[l]);
  text += f.ticking == Ticking::realtime ? timeText(f.last) : steppedText(f.last);
  text += fmt::format("  safety           {}\n", tripsText(f.last.trips));
  if (f.last.servo.watchdog_trips > 0)
    text += fmt::format("  supervisor       switched the motors off {} times: no tick for 50 ms\n",
                        f.last.servo.watchdog_trips);
  if (f.ticking == Ticking::realtime) {
    text += fmt::format("  frames           {}, one every {:.0f} ms, the first after {:.1f} s\n", f.frames, f.frame_ms,
                        f.first_frame_s);
    text += fmt::format("  display          {}, quality: {}\n", f.last.display, f.last.quality);
  }
  if (f.latency && f.slow_latency)
    text += fmt::format("  latency          {}, 95 % below {:.0f} ms\n", latencyText(*f.latency),
                        f.slow_latency->total_ms());
  if (f.recording)
    text += fmt::format("  recorded         {} ticks, {} lost, in {}{}{}\n", f.recording->ticks, f.recording->lost,
                        f.recording->file, f.recording->trouble ? "; " : "", f.recording->trouble.value_or(""));
  return text;
}

}  // namespace app
