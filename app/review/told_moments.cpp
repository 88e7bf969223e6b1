#include "app/review/told_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "app/report/markup.h"

namespace app {
namespace {

class Told {
 public:
  void add(double t_s, const std::string& what) {
    const auto same = std::ranges::find_if(
        moments_, [&](const ToldMoment& moment) { return std::abs(moment.t_s - t_s) < kSameMoment_s; });
    if (same != moments_.end()) {
      if (same->what.find(what) == std::string::npos) same->what += "; " + what;
    } else if (moments_.size() < kMostTold) {
      moments_.push_back({t_s, what});
    }
  }
  std::vector<ToldMoment> byTime() {
    std::ranges::stable_sort(moments_, {}, &ToldMoment::t_s);
    return std::move(moments_);
  }

 private:
  std::vector<ToldMoment> moments_;
};

}  // namespace

std::vector<ToldMoment> toldMoments(const SessionMetrics& metrics, const SessionCourse& course) {
  struct Words {
    std::string_view id, before, after;
    bool is_told_at_zero;
  };
  // Errors first, then how near.
  constexpr std::array kNamed{Words{"O5.area", "lingual plate broken through", "", false},
                              Words{"O10.second_molar", "second molar cut", "", false},
                              Words{"S1.canal", "nearest to the mandibular canal, ", " mm", true},
                              Words{"S1.lingual", "nearest to the outer lingual surface, ", " mm", true},
                              Words{"S1.second_molar", "nearest to the second molar, ", " mm", true}};
  Told told;
  for (const Words& words : kNamed) {
    const MeasureValue* const measure = measureOf(metrics, words.id);
    if (measure == nullptr || !measure->value || !measure->t_s) continue;
    if (!words.is_told_at_zero && !(*measure->value > 0.0)) continue;
    std::string what(words.before);
    if (!words.after.empty()) what += fixedText(*measure->value, 2) + std::string(words.after);
    if (!measure->is_confirmed) what += " (not confirmed)";
    told.add(*measure->t_s, what);
  }
  for (const MarkKind kind : {MarkKind::touch, MarkKind::error, MarkKind::coach}) {
    std::set<std::string> seen;
    for (const SessionMark& mark : course.marks)
      if (mark.kind == kind && seen.insert(mark.what).second)
        told.add(mark.t_s, (kind == MarkKind::coach ? "coach: " : "") + mark.what);
  }
  return told.byTime();
}

std::optional<std::size_t> pictureOf(std::span<const MomentPicture> pictures, double t_s) {
  const auto shown = std::ranges::find_if(
      pictures, [&](const MomentPicture& picture) { return std::abs(picture.moment.t_s - t_s) < kSameMoment_s; });
  if (shown == pictures.end()) return {};
  return static_cast<std::size_t>(shown - pictures.begin());
}

}  // namespace app
