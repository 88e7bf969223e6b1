#include "app/rehearsal/rehearsal_summary.h"

#include <numeric>

#include "app/device/trip_teller.h"
#include "app/text/printed.h"

namespace app {

RehearsalStatus statusOf(const RehearsalPlan& plan) {
  RehearsalStatus status;
  status.patient_title = plan.patient.title;
  status.calibration = plan.calibration;
  status.remarks = plan.remarks;
  if (!plan.recording) return status;
  status.recording = RecordingState::running;
  status.recording_path = plan.recording->path;
  return status;
}

std::string grantsText(const haptics::RealtimeGrants& grants) {
  const std::string core = grants.core ? printed(", core %d", *grants.core) : ", no core of its own";
  return std::string(grants.priority ? "real-time priority" : "no real-time priority") + core +
         (grants.memory_locked ? ", memory locked" : ", memory not locked");
}

std::string punctualityText(const haptics::LoopFigures& servo) {
  return printed(
             "%llu ticks, %llu deadlines missed, %llu by its own work; late by %.0f µs, 99 %% below %.0f, at most "
             "%.0f; ",
             static_cast<unsigned long long>(servo.ticks), static_cast<unsigned long long>(servo.missed),
             static_cast<unsigned long long>(servo.overruns), servo.late_p50_us, servo.late_p99_us, servo.latest_us) +
         grantsText(servo.grants);
}

namespace {

/// How well the servo kept time.
std::string timeText(const RehearsalStatus& last) {
  std::string text =
      printed("  servo            %llu ticks at %.0f Hz, %llu deadlines missed, %llu by its own work\n",
              static_cast<unsigned long long>(last.servo.ticks), last.servo_rate_Hz,
              static_cast<unsigned long long>(last.servo.missed), static_cast<unsigned long long>(last.servo.overruns));
  text += printed("  wake-up          late by p50 %.0f µs, p99 %.0f µs, at most %.0f µs\n", last.servo.late_p50_us,
                  last.servo.late_p99_us, last.servo.latest_us);
  text += printed("  work per tick    p50 %.0f µs, p99 %.0f µs, p99.9 %.0f µs, max %.0f µs\n", last.servo.work_p50_us,
                  last.servo.work_p99_us, last.servo.work_p999_us, last.servo.work_max_us);
  text += printed("  granted          %s\n", grantsText(last.servo.grants).c_str());
  return text;
}

/// There was no time to keep.
std::string steppedText(const RehearsalStatus& last) {
  return printed("  servo            %llu ticks at %.0f Hz, stepped as fast as the machine can\n",
                 static_cast<unsigned long long>(last.servo.ticks), last.servo_rate_Hz);
}

}  // namespace

std::string summaryText(const RehearsalFigures& f) {
  std::string text = "Rehearsal\n";
  text += printed("  patient          %s\n", f.last.patient_title.c_str());
  text += printed("  bur              %s mm\n", f.last.bur.c_str());
  text += "  calibration      " + calibrationWords(f.last.calibration) + "\n";
  text += printed("  duration         %.1f s\n", f.last.tick.t_s + f.last.tick.dt_s);
  text += printed("  removed          %.1f mm³\n", std::accumulate(f.removed_mm3.begin(), f.removed_mm3.end(), 0.0));
  for (std::size_t l = 0; l < f.removed_mm3.size(); ++l)
    if (f.removed_mm3[l] >= 0.05)
      text += printed("    %-14s %.1f mm³\n", std::string(assets::kTissues[l].name).c_str(), f.removed_mm3[l]);
  text += f.ticking == Ticking::by_itself ? timeText(f.last) : steppedText(f.last);
  text += printed("  safety           %s\n", tripsText(f.last.trips).c_str());
  if (f.last.servo.silences > 0)
    text += printed("  supervisor       switched the motors off %llu times: no tick for 50 ms\n",
                    static_cast<unsigned long long>(f.last.servo.silences));
  if (f.ticking == Ticking::by_itself) {
    text += printed("  pictures         %llu, one every %.0f ms, the first after %.1f s\n",
                    static_cast<unsigned long long>(f.frames), f.frame_ms, f.first_picture_s);
    text += printed("  display          %s, quality: %s\n", f.last.display.c_str(), f.last.quality.c_str());
  }
  if (f.latency && f.slow_latency)
    text += printed("  latency          %s, 95 %% below %.0f ms\n", photonText(*f.latency).c_str(),
                    f.slow_latency->total_ms());
  if (f.recording)
    text +=
        printed("  recorded         %llu ticks, %llu lost, in %s%s%s\n",
                static_cast<unsigned long long>(f.recording->ticks), static_cast<unsigned long long>(f.recording->lost),
                f.recording->file.c_str(), f.recording->trouble ? "; " : "", f.recording->trouble.value_or("").c_str());
  return text;
}

}  // namespace app
