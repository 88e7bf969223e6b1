#include "app/rehearsal/rehearsal_summary.h"

#include <numeric>

#include <fmt/core.h>

#include "app/device/trip_reporter.h"
#include "app/options/bur_name.h"
#include "app/text/clock_text.h"
#include "app/view/head_up_line.h"

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

/// "12.3 mm³ (cortical bone 8.1, trabecular bone 4.2)"; empty: nothing to speak of.
template <class Belongs>
std::string removedText(const RehearsalFigures& f, const Belongs& belongs) {
  double sum_mm3 = 0.0;
  std::string parts;
  for (std::size_t l = 0; l < f.removed_mm3.size(); ++l) {
    if (!belongs(static_cast<std::uint8_t>(l))) continue;
    sum_mm3 += f.removed_mm3[l];
    if (f.removed_mm3[l] >= 0.05)
      parts += fmt::format("{}{} {:.1f}", parts.empty() ? "" : ", ", assets::kTissues[l].name, f.removed_mm3[l]);
  }
  return parts.empty() ? "" : fmt::format("{:.1f} mm³ ({})", sum_mm3, parts);
}

std::string surgeonsText(const RehearsalFigures& f) {
  std::string text = "Rehearsal\n";
  const auto line = [&](const char* name, const std::string& words) {
    if (!words.empty()) text += fmt::format("  {:16} {}\n", name, words);
  };
  line("patient", f.last.patient_title);
  line("instrument", toolName(f.last.command.tool));
  const std::string cutting =
      f.times.cutting_s < 1.0 ? ""
      : f.times.dry_s < 1.0
          ? fmt::format(", cutting {}", clockText(f.times.cutting_s))
          : fmt::format(", cutting {}, {} of it without water", clockText(f.times.cutting_s), clockText(f.times.dry_s));
  line("time", clockText(f.last.tick.t_s + f.last.tick.dt_s) + cutting);
  const auto is_bone = [](std::uint8_t label) { return !assets::isTooth(label) && assets::isHard(label); };
  // Of the gingiva the scan has a rough share a voxel, and what is drawn and felt is its surface: where the bur turned
  // on it is told below.
  const auto is_other = [&](std::uint8_t label) {
    return !assets::isTooth(label) && !is_bone(label) && label != static_cast<std::uint8_t>(assets::Tissue::gingiva);
  };
  const std::string bone = removedText(f, is_bone);
  line("bone removed", bone.empty() ? "none" : bone);
  line("tooth removed", removedText(f, assets::isTooth));
  line("other removed", removedText(f, is_other));
  if (f.exposed_share) line("crown exposed", fmt::format("{:.0f} % of what is planned", 100.0 * *f.exposed_share));
  line("tooth", f.tooth);
  line("luxation", f.luxation);
  line("root canals", f.canals);
  if (!f.way.empty()) line("way out", f.way);
  if (!f.drawn.empty()) line("own plan", f.drawn);
  if (f.flap) line("flap", flapInWords(*f.flap));
  if (f.socket) line("socket", socketInWords(*f.socket));
  if (f.procedure) {
    const double end_s = f.procedure->end_s().value_or(f.last.tick.t_s + f.last.tick.dt_s);
    line("predicted", predictionInWords(f.prediction, end_s));
    line("procedure", procedureInWords(*f.procedure));
    for (const std::string& step : stepsInWords(*f.procedure)) line("", step);
  }
  line("touched", f.touched.empty() ? "no tooth, no canal" : touchesText(f.touched));
  line("came as near as", f.clearance);
  line("soft tissue", softTouchesText(f.soft_touches.touched));
  line("bur turned on", softTouchesText(f.soft_touches.cut));
  std::string warnings;
  for (const Warnings::Count& count : f.warnings)
    warnings += fmt::format("{}{} {}", warnings.empty() ? "" : ", ", count.name,
                            count.times == 1 ? std::string("once") : fmt::format("{} times", count.times));
  line("warnings", warnings.empty() ? "none" : warnings);
  return text + recordingText(f);
}

std::string engineersText(const RehearsalFigures& f) {
  std::string text = "  calibration      " + calibrationText(f.last.calibration) + "\n";
  text += fmt::format("  duration         {:.1f} s\n", f.last.tick.t_s + f.last.tick.dt_s);
  text +=
      fmt::format("  removed          {:.1f} mm³\n", std::accumulate(f.removed_mm3.begin(), f.removed_mm3.end(), 0.0));
  text += f.ticking == Ticking::realtime ? timeText(f.last) : steppedText(f.last);
  text += fmt::format("  safety           {}\n", tripsText(f.last.trips));
  if (f.has_motors && f.last.servo.watchdog_trips > 0)
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
  if (f.recording) text += fmt::format("  recorded         {} ticks, {} lost\n", f.recording->ticks, f.recording->lost);
  return text;
}

}  // namespace

std::string punctualityText(const haptics::LoopFigures& servo) {
  return fmt::format(
             "{} ticks, {} deadlines missed, {} by its own work; late by {:.0f} µs, 99 % below {:.0f}, at most "
             "{:.0f}; ",
             servo.ticks, servo.missed, servo.overruns, servo.late_p50_us, servo.late_p99_us, servo.late_max_us) +
         grantsText(servo.grants);
}

std::string recordingText(const RehearsalFigures& f) {
  if (!f.recording) return "";
  std::string recorded = f.recording->file.empty() ? "nothing" : f.recording->file;
  if (f.recording->lost > 0) recorded += fmt::format(", {} ticks lost", f.recording->lost);
  if (f.recording->trouble) recorded += "; " + *f.recording->trouble;
  return fmt::format("  {:<16} {}\n", "recorded in", recorded);
}

std::string summaryText(const RehearsalFigures& f) {
  std::string text = surgeonsText(f);
  if (f.for_engineers) text += "\n" + engineersText(f);
  return text;
}

}  // namespace app
