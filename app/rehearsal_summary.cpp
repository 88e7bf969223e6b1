#include "app/rehearsal_summary.h"

#include <cstdarg>
#include <cstdio>
#include <numeric>

namespace app {
namespace {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace

std::string summaryText(const RehearsalFigures& f) {
  std::string text = "Rehearsal\n";
  text += line("  patient          %s\n", f.patient_title.c_str());
  text += line("  bur              %s mm\n", f.bur.c_str());
  text += line("  duration         %.1f s\n", f.duration_s);
  text += line("  removed          %.1f mm³\n", std::accumulate(f.removed_mm3.begin(), f.removed_mm3.end(), 0.0));
  for (std::size_t l = 0; l < f.removed_mm3.size(); ++l)
    if (f.removed_mm3[l] >= 0.05)
      text += line("    %-14s %.1f mm³\n", std::string(assets::kTissues[l].name).c_str(), f.removed_mm3[l]);
  text += line("  servo            %llu ticks at %.0f Hz, %llu deadlines missed, latest wake-up %.0f µs\n",
               static_cast<unsigned long long>(f.servo.ticks), f.rate_Hz,
               static_cast<unsigned long long>(f.servo.missed), f.servo.latest_us);
  text += line("  work per tick    p50 %.0f µs, p99 %.0f µs, max %.0f µs%s\n", f.servo.work_p50_us, f.servo.work_p99_us,
               f.servo.work_max_us, f.servo.realtime ? "" : " (no real-time priority granted)");
  text += line("  pictures         %llu, one every %.0f ms, the first after %.1f s\n",
               static_cast<unsigned long long>(f.frames), f.frame_ms, f.first_picture_s);
  text += line("  display          %s, quality: %s\n", f.display.c_str(), f.quality.c_str());
  if (f.latency && f.slow_latency)
    text += line("  latency          %s, 95 %% below %.0f ms\n", photonText(*f.latency).c_str(),
                 f.slow_latency->total_ms());
  if (f.recording)
    text += line("  recorded         %llu ticks, %llu lost%s%s\n", static_cast<unsigned long long>(f.recording->ticks),
                 static_cast<unsigned long long>(f.recording->lost), f.recording->trouble ? "; " : "",
                 f.recording->trouble.value_or("").c_str());
  return text;
}

}  // namespace app
