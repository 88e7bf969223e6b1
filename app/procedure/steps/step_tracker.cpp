#include "app/procedure/steps/step_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "app/session/touch_event.h"
#include "assets/tissue.h"
#include "haptics/body/bodies.h"

namespace app {
namespace {

constexpr std::array<std::string_view, kStepErrors> kErrorWords = {
    "neighbour tooth touched",  "mandibular canal touched", "bur on soft tissue", "cutting dry",
    "fulcrum on another tooth", "other instrument used",    "too near the nerve", "pressed too hard",
    "pulled too hard",          "too much bone removed"};

int piecesOut(const haptics::Tick& tick) {
  int out = 0;
  for (std::size_t n = 0; n < tick.pieces; ++n) out += haptics::Bodies::isAside(tick.X_PQ[n]) ? 1 : 0;
  return out;
}

/// One rule of a step: how far it is, and in words what is missing.
struct RuleState {
  bool in_words = false;
  bool holds = true;
  std::string words;
};

/// `words`: makes a string.
template <class Words>
void require(RuleState& state, bool holds, const Words& words) {
  if (holds) return;
  state.holds = false;
  if (state.in_words) state.words += (state.words.empty() ? "" : ", ") + words();
}

void requireShare(RuleState& state, const std::optional<double>& wanted, const std::optional<double>& known,
                  const char* what) {
  if (!wanted) return;
  require(state, known && *known >= *wanted,
          [&] { return fmt::format("{} {:.0f} of {:.0f} %", what, 100.0 * known.value_or(0.0), 100.0 * *wanted); });
}

void requireVolume(RuleState& state, const std::optional<double>& wanted, double is_mm3, const char* what) {
  if (!wanted) return;
  require(state, is_mm3 >= *wanted, [&] { return fmt::format("{} {:.0f} of {:.0f} mm³", what, is_mm3, *wanted); });
}

/// Of a socket that was looked at.
void requireAtMost(RuleState& state, const std::optional<double>& wanted, const std::optional<SocketFacts>& socket,
                   double SocketFacts::*which, double scale, const char* what, const char* unit) {
  if (!wanted) return;
  require(state, socket && (*socket).*which <= *wanted, [&] {
    return socket ? fmt::format("{} {:.1f} of {:.1f} {} at most", what, scale * (*socket).*which, scale * *wanted, unit)
                  : fmt::format("{} not looked at", what);
  });
}

bool isParted(const haptics::Tick& tick) { return tick.pieces >= 2 || piecesOut(tick) > 0; }

std::string bridgeWords(const std::optional<double>& bridge_mm, double most_mm) {
  return bridge_mm ? fmt::format("bridge {:.1f} mm, {:.1f} at most", *bridge_mm, most_mm)
                   : fmt::format("leave {:.1f} mm at most", most_mm);
}

RuleState stateOf(const DoneWhen& when, const haptics::Tick& tick, const StepFacts& facts, bool in_words = false) {
  RuleState state{.in_words = in_words, .words = {}};
  const int out = piecesOut(tick),
            wanted_out = when.all_out ? std::max<int>(1, tick.pieces) : when.pieces_out.value_or(0);
  if (when.in_hand) require(state, facts.in_hand == *when.in_hand, [&] { return "take the " + nameOf(*when.in_hand); });
  const FlapFacts flap = facts.flap.value_or(FlapFacts{});
  if (when.incision_mm)
    require(state, flap.full_incision_mm >= *when.incision_mm, [&] {
      return fmt::format("incision to the bone {:.0f} of {:.0f} mm", flap.full_incision_mm, *when.incision_mm);
    });
  requireShare(state, when.flap_raised, flap.raised_share, "flap raised");
  if (when.flap_held)
    require(state, flap.is_held, [] { return std::string("the flap is not held: A calls the assistant"); });
  requireShare(state, when.gutter_removed, facts.gutter_removed, "gutter");
  requireShare(state, when.crown_bared, facts.crown_bared, "crown bared");
  requireVolume(state, when.bone_mm3, boneRemoved_mm3(tick), "bone");
  requireVolume(state, when.tooth_mm3, toothRemoved_mm3(tick), "tooth");
  if (when.bridge_mm)
    require(state, isParted(tick) || (facts.bridge_mm && *facts.bridge_mm <= *when.bridge_mm),
            [&] { return bridgeWords(facts.bridge_mm, *when.bridge_mm); });
  // What is out was loose.
  requireShare(state, when.torn, out > 0 ? 1.0 : tick.torn_share, "ligament torn");
  if (when.pieces)
    require(state, tick.pieces >= *when.pieces,
            [&] { return fmt::format("{} of {} pieces", std::max<int>(1, tick.pieces), *when.pieces); });
  requireAtMost(state, when.chips_mm3, facts.socket, &SocketFacts::chips_mm3, 1.0, "chips", "mm³");
  requireAtMost(state, when.follicle_left, facts.socket, &SocketFacts::follicle_left, 100.0, "follicle", "%");
  requireAtMost(state, when.edges_mm, facts.socket, &SocketFacts::edges_mm, 1.0, "sharp edges", "mm");
  if (when.socket_clean)
    require(state, facts.socket && facts.socket->is_clean, [] { return std::string("the socket is not clean"); });
  if (when.stitches) {
    const int made = facts.socket ? facts.socket->stitches : 0;
    require(state, made >= *when.stitches, [&] { return fmt::format("{} of {} stitches", made, *when.stitches); });
  }
  if (wanted_out > 0) require(state, out >= wanted_out, [&] { return fmt::format("{} of {} out", out, wanted_out); });
  return state;
}

/// Something that no hand can take back.
bool isFinal(const DoneWhen& when) { return when.pieces || when.pieces_out || when.all_out; }

}  // namespace

std::string_view wordsOf(StepError error) { return kErrorWords[static_cast<std::size_t>(error)]; }

double boneRemoved_mm3(const haptics::Tick& tick) {
  double sum_mm3 = 0.0;
  for (std::size_t n = 0; n < tick.removed_total_mm3.size(); ++n) {
    const auto label = static_cast<std::uint8_t>(n);
    if (assets::isHard(label) && !assets::isTooth(label)) sum_mm3 += tick.removed_total_mm3[n];
  }
  return sum_mm3;
}

double toothRemoved_mm3(const haptics::Tick& tick) {
  double sum_mm3 = 0.0;
  for (std::size_t n = 0; n < tick.removed_total_mm3.size(); ++n)
    if (assets::isTooth(static_cast<std::uint8_t>(n))) sum_mm3 += tick.removed_total_mm3[n];
  return sum_mm3;
}

StepTracker::StepTracker(const StepPlan& plan) : plan_(plan) {
  for (const Step& step : plan_.steps) records_.push_back({.key = step.key, .title = step.title});
  last_s_.fill(-std::numeric_limits<double>::infinity());
}

std::optional<std::size_t> StepTracker::current() const {
  return current_ < records_.size() ? std::optional(current_) : std::nullopt;
}

void StepTracker::begin(std::size_t step) {
  current_ = step;
  if (step >= records_.size()) return;
  records_[step].state = StepState::open;
  records_[step].begin_s = now_s_;
  events_.push_back(stepBeginText(records_[step]));
}

void StepTracker::end(StepState state) {
  StepRecord& record = records_[current_];
  record.state = state;
  record.duration_s = now_s_ - record.begin_s.value_or(now_s_);
  events_.push_back(stepEndText(record));
  if (state == StepState::given) given_.push_back(plan_.steps[current_].done_when.given);
  begin(current_ + 1);
}

/// Ends all before `next`.
void StepTracker::passOver(std::size_t next) {
  while (current_ < next) {
    const DoneWhen& when = plan_.steps[current_].done_when;
    if (!when.given.empty())
      end(StepState::given);
    else
      end(stateOf(when, *newest_, facts_).holds ? StepState::met : StepState::omitted);
  }
}

void StepTracker::follow(const haptics::Tick& tick, const StepFacts& facts) {
  newest_ = tick;
  facts_ = facts;
  now_s_ = tick.t_s + tick.dt_s;
  if (!records_.front().begin_s) begin(0);
  followErrors(tick, facts);
  for (std::size_t later = records_.size(); later-- > current_ + 1;) {
    const DoneWhen& when = plan_.steps[later].done_when;
    if (!isFinal(when) || !stateOf(when, tick, facts).holds) continue;
    passOver(later);
    break;
  }
  while (current_ < records_.size()) {
    const DoneWhen& when = plan_.steps[current_].done_when;
    if (!when.given.empty())
      end(StepState::given);
    else if (stateOf(when, tick, facts).holds)
      end(StepState::met);
    else
      break;
  }
}

bool StepTracker::usesOtherInstrument() const {
  if (current_ >= records_.size() || !newest_) return false;
  const Step& step = plan_.steps[current_];
  const haptics::Tick& tick = *newest_;
  const bool in_use = tick.gripped != 0 || (tick.drilling && tick.depth_mm > 0.0) || tick.lever.piece != 0;
  return step.errors.wrong_instrument && in_use &&
         std::ranges::find(step.instruments, facts_.in_hand) == step.instruments.end();
}

void StepTracker::followErrors(const haptics::Tick& tick, const StepFacts& facts) {
  if (current_ >= records_.size()) return;
  const Step& step = plan_.steps[current_];
  const StepErrorRules& rules = step.errors;
  const bool cuts = tick.drilling && tick.depth_mm > 0.0;
  const auto check = [&](StepError error, bool is_on) {
    if (!is_on) return;
    double& last_s = last_s_[static_cast<std::size_t>(error)];
    if (now_s_ - last_s > kTouchPause_s) note(error);
    last_s = now_s_;
  };
  check(StepError::soft_tissue, rules.soft_tissue && tick.soft.bur_cuts != assets::SoftTissue::none);
  check(StepError::dry, rules.dry && cuts && !facts.irrigating);
  check(StepError::fulcrum, rules.fulcrum && tick.lever.restsOnTeeth());
  check(StepError::wrong_instrument, usesOtherInstrument());
  check(StepError::near_nerve, rules.nerve_mm && cuts && facts.nerve_mm && *facts.nerve_mm < *rules.nerve_mm);
  check(StepError::pressed_hard, rules.cutting_N && cuts && glm::length(tick.law_force_P_N.xyz) > *rules.cutting_N);
  check(StepError::pulled_hard,
        rules.pull_N && tick.gripped != 0 && glm::length(tick.grip_force_P_N.xyz) > *rules.pull_N);
  check(StepError::bone_beyond_limit, rules.bone_mm3 && boneRemoved_mm3(tick) > *rules.bone_mm3);
}

void StepTracker::note(StepError error) {
  records_[current_].count(std::string(wordsOf(error)));
  events_.push_back(stepErrorText(records_[current_], std::string(wordsOf(error)), now_s_));
}

void StepTracker::blame(StepError error) {
  if (current_ >= records_.size() || !records_[current_].begin_s) return;
  const StepErrorRules& rules = plan_.steps[current_].errors;
  if (error == StepError::neighbour ? rules.neighbour : error == StepError::canal && rules.canal) note(error);
}

bool StepTracker::skip() {
  if (current_ >= records_.size() || !records_[current_].begin_s) return false;
  end(StepState::skipped);
  return true;
}

void StepTracker::finish() {
  for (std::size_t n = current_; n < records_.size(); ++n) {
    StepRecord& record = records_[n];
    if (record.begin_s) record.duration_s = now_s_ - *record.begin_s;
    events_.push_back(stepEndText(record));
  }
}

bool StepTracker::asksForBone() const {
  return std::any_of(plan_.steps.begin() + static_cast<std::ptrdiff_t>(std::min(current_, plan_.steps.size())),
                     plan_.steps.end(),
                     [](const Step& step) { return step.done_when.gutter_removed || step.done_when.crown_bared; });
}

std::string StepTracker::missing() const {
  if (current_ >= records_.size() || !newest_) return "";
  return stateOf(plan_.steps[current_].done_when, *newest_, facts_, true).words;
}

std::vector<std::string> StepTracker::takeGiven() { return std::exchange(given_, {}); }

std::vector<std::string> StepTracker::takeEvents() { return std::exchange(events_, {}); }

}  // namespace app
