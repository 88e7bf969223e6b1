#include "app/session/measures/onlooker.h"

#include <array>
#include <string>

namespace app {
namespace {

constexpr double kBetweenEnds_s = 0.1;
constexpr double kAway_mm = 400.0, kHalfApart_mm = 31.5;  ///< a usual surgeon's eyes

constexpr auto kSight = std::to_array<MeasureName>({
    {"S7", "share of removal out of sight of both eyes", ""},
    {"M10.mirror", "share of removal that an eye saw in the mirror", ""},
    {"M10.mirror_view", "time an eye saw the working end in the mirror", "s"},
    {"M10.hold", "steadiness of the force that holds the retractor", "N"},
});

EyesPlace usualEyes(const glm::dvec3& site_P_mm, const glm::dvec3& sight_P) {
  const glm::dvec3 aside = kHalfApart_mm * glm::normalize(glm::cross(sight_P, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 middle = site_P_mm + kAway_mm * sight_P;
  return {middle - aside, middle + aside};
}

}  // namespace

std::vector<MeasureValue> noSight(std::string_view why) { return untold(kSight, why); }

void Onlooker::add(const haptics::Command& in_force, double t_s) {
  const HeldFrom now{t_s, in_force.assistant_holds, in_force.flap_aside};
  if (held_.empty() || held_.back().assistant_holds != now.assistant_holds || held_.back().flap_aside != now.flap_aside)
    held_.push_back(now);
}

void Onlooker::add(const SessionEvent& event, double t_s) {
  if (event.kind == kEyesEvent)
    if (const auto eyes = eyesFrom(event.text)) eyes_.push_back({eyes_.empty() ? 0.0 : t_s, *eyes});
  if (event.kind == kSecondHandNamed) has_second_hand_ = true;
  if (event.kind != kSecondHandEvent) return;
  const auto place = secondHandFrom(event.text);
  if (!place) return;
  second_hand_.add(t_s, *place);
  has_mirror_ = has_mirror_ || place->instrument == assets::SecondInstrument::mirror;
}

void Onlooker::add(const haptics::Tick& tick) {
  if (!has_mirror_ || has(tick.faults, haptics::Fault::bad_pose)) return;
  if (ends_.empty() || tick.t_s - ends_.back().t_s >= kBetweenEnds_s) ends_.push_back({tick.t_s, 0.0, tick.proxy_P.mm});
  ends_.back().dt_s += tick.dt_s;
}

std::string_view Onlooker::whyNoMirror() const {
  if (!second_hand_.isEmpty()) return "the other hand held no mirror";
  return has_second_hand_ ? "recorded before the place of the other hand was" : "nothing was in the other hand";
}

std::vector<MeasureValue> Onlooker::values(const Session& session) const {
  const bool is_recorded = !eyes_.empty();
  const StoredStart& start = session.start;
  std::string_view why;
  if (session.clock == nullptr)
    why = "the bone at the end is not known";
  else if (!is_recorded && (!start.setup.site || session.about.sight_P == glm::dvec3(0.0)))
    why = "where the eyes were is not recorded";
  std::vector<MeasureValue> values = untold(kSight, why);
  MeasureValue &hidden = values[0], &in_mirror = values[1], &view = values[2];
  values[3].why = "the other hand's instrument feels no force";
  if (!has_mirror_) in_mirror.why = view.why = whyNoMirror();
  if (!why.empty()) return values;

  std::vector<EyesFrom> eyes = eyes_;
  if (!is_recorded) eyes.push_back({0.0, usualEyes(start.setup.site->centre_P_mm, session.about.sight_P)});
  const SightOfWork sight =
      sightOfWork(*session.clock, {start.solid, session.after, start.soft_tissue, eyes, held_, start.is_tooth,
                                   session.out_s, has_mirror_ ? &second_hand_ : nullptr, ends_});
  const std::string by = is_recorded ? "eyes as recorded" : "eyes of a usual surgeon, as they were not recorded";
  constexpr std::string_view kNoBur = "no bur removed anything";
  hidden.value = sight.hidden;
  if (!sight.hidden) hidden.why = kNoBur;
  hidden.conditions = by + (has_mirror_ ? "; the mirror counted" : "; no mirror: " + std::string(whyNoMirror()));
  if (!has_mirror_) return values;
  in_mirror.value = sight.in_mirror;
  if (!sight.in_mirror) in_mirror.why = kNoBur;
  view.value = sight.mirror_view_s;
  in_mirror.conditions = view.conditions = by + "; by its place: the picture reflects nothing";
  return values;
}

}  // namespace app
