#include "app/debrief/log_bookmarks.h"

namespace app {

std::vector<Bookmark> logBookmarks(const std::vector<LogEvent>& events, double tick_s, bool with_words) {
  std::vector<Bookmark> all;
  for (const LogEvent& event : events) {
    if (event.type != "note" && event.type != "bookmark" && event.type != "problem") continue;
    const auto t_s = event.tick ? std::optional(static_cast<double>(*event.tick) * tick_s) : event.number("moment_s");
    if (!t_s) continue;
    const char* const key = event.type == "note" ? "text" : event.type == "problem" ? "title" : "label";
    const std::string words = with_words ? event.textOr(key) : "";
    all.push_back({*t_s, event.type + (words.empty() ? "" : ": " + words)});
  }
  return all;
}

}  // namespace app
