#include "app/calibrate/touch_round.h"

#include <algorithm>
#include <cmath>

#include "app/calibrate/number_text.h"
#include "app/calibrate/tilt_text.h"
#include "calibration/fit/touch_checks.h"
#include "calibration/median.h"

namespace app {
namespace {

constexpr double kMostTiltOff_deg = 10.0;
constexpr double kMostOffUnmeasured_mm = 60.0;  // a stand put down by eye, arm as its model
constexpr double kSamePlace_mm = 3.0, kSameTilt_deg = 5.0;
constexpr double kUsualInterval_s = 6.0;
constexpr double kHeard_s = 0.7, kSameBreath_s = 0.7;
constexpr double kIdle_s = 0.5;  // of the clock while nothing came: it was not worked then

/// How far apart two touches of the same target may be while the device counts the same.
double sameCount_mm(const calibration::TouchPrecision& precision) { return 0.6 + 4.0 * precision.in_plane_mm; }

ChoiceMenu pauseMenu() {
  return ChoiceMenu({"go on", "start these touches again", "leave; the old calibration stays"});
}

}  // namespace

const char* nounOf(const calibration::TargetPlan& plan) {
  if (plan.method.starts_with("rest")) return "mark";
  if (plan.kind == calibration::TargetKind::pit) return "pit";
  return plan.kind == calibration::TargetKind::cross ? "cross" : "place";
}

TouchRound::TouchRound(calibration::TargetPlan plan, const calibration::MeasuredArm& assumed, double max_distance_mm,
                       Announcements& announcements)
    : plan_(std::move(plan)),
      arm_(assumed),
      max_distance_mm_(max_distance_mm),
      announcements_(announcements),
      still_(plan_.kind == calibration::TargetKind::cross ? kCrossStillness : kPitStillness),
      taken_(plan_.targets.size()) {}

TouchRound::TouchEvent TouchRound::update(const StylusSample& sample, Press press, double pressed_s) {
  keepTime(sample.t_s);
  now_ = sample;
  still_.update(sample);

  // Putting the stylus away pauses, taking it up continues.
  if (sample.docked && !docked_) pause_ = pauseMenu();
  if (!sample.docked && docked_) pause_.reset();
  docked_ = sample.docked;
  if (pause_) return pause(press);

  if (press == Press::long_press) return undo();
  if (isComplete()) return TouchEvent::nothing;
  if (press == Press::short_press && dwelt_at_s_ && pressed_s - *dwelt_at_s_ < kSameBreath_s)
    return TouchEvent::nothing;
  if (press == Press::short_press) {
    std::string why;
    const auto taken = still_.before(pressed_s, why);
    if (taken) return take(*taken, true);
    announcements_.refuse("Not taken: " + why + ".");
    return TouchEvent::nothing;
  }
  const auto held_still = still_.heldStill();
  if (!held_still) return TouchEvent::nothing;
  dwelt_at_s_ = sample.t_s;
  return take(*held_still, false);
}

TouchRound::TouchEvent TouchRound::take(const StillReading& take, bool pressed) {
  if (!pressed) still_.waitForMove();
  if (confirming_) return confirm(take);

  const std::size_t index = *next();
  bool tilt_is_wrong = false;
  if (const std::string why = objection(index, take.raw_rad, tilt_is_wrong); !why.empty()) {
    const bool insisted = pressed && objected_ == index && now_->t_s - objected_at_s_ > kHeard_s;
    const bool never = why.starts_with("This is where");
    if (never || !insisted) {
      objected_ = never ? std::nullopt : std::optional(index);
      objected_at_s_ = now_->t_s;
      announcements_.refuse(why + (never ? "." : ". Press again to take it anyway."));
      return TouchEvent::nothing;
    }
  }

  still_.waitForMove();
  objected_.reset();
  last_rad_ = take.raw_rad;
  taken_[index] = Taken{take.raw_rad, tilt_is_wrong, false};
  order_.push_back(index);
  intervals_s_.push_back(busy_s_ - taken_at_s_);
  taken_at_s_ = busy_s_;
  announcements_.praise("Taken: " + std::string(nounOf(plan_)) + " " + std::to_string(index + 1) +
                            (tilt_is_wrong ? ", with a wrong tilt." : "."),
                        isComplete() ? WizardSound::next : WizardSound::ok);
  return TouchEvent::taken;
}

std::string TouchRound::objection(std::size_t index, const calibration::RawJoints& raw_rad, bool& tilt_is_wrong) const {
  const calibration::Target& target = plan_.targets[index];
  const auto along_W = heldAlong_W(raw_rad);
  const glm::dvec3 tip_mm = arm_.tip_W(raw_rad).mm;
  const double off_deg = angleBetween_deg(along_W.xyz, target.stylus_W.xyz);
  tilt_is_wrong = !any_tilt_ && off_deg > kMostTiltOff_deg;
  const std::string noun = nounOf(plan_);

  if (last_rad_ && glm::length(tip_mm - arm_.tip_W(*last_rad_).mm) < kSamePlace_mm &&
      angleBetween_deg(along_W.xyz, heldAlong_W(*last_rad_).xyz) < kSameTilt_deg)
    return "This is where the last touch was: go to the glowing " + noun;

  // Further away than the uncertainty of the arm.
  const double off_mm = glm::length(tip_mm - target.position_W.mm);
  if (off_mm > (max_distance_mm_ > 0.0 ? max_distance_mm_ : kMostOffUnmeasured_mm)) {
    const auto nearest = std::ranges::min_element(
        plan_.targets, {}, [&](const calibration::Target& one) { return glm::distance(tip_mm, one.position_W.mm); });
    std::string why = "This seems " + mmText(off_mm) + " from the glowing " + noun;
    if (glm::distance(nearest->position_W.mm, target.position_W.mm) > 1.0)
      why += ", nearer to " + noun + " " + std::to_string(nearest - plan_.targets.begin() + 1);
    return why;
  }
  if (!tilt_is_wrong) return {};
  const std::string words = tiltText(along_W, target.stylus_W);
  return "Tilted " + fixedText(off_deg, 0) + "° away from the shown direction" + (words.empty() ? "" : ": " + words);
}

TouchRound::TouchEvent TouchRound::confirm(const StillReading& take) {
  still_.waitForMove();
  const calibration::RawJoints& before = taken_[*confirming_]->raw_rad;
  const auto along_W = heldAlong_W(take.raw_rad), along_before_W = heldAlong_W(before);
  if (!any_tilt_ && angleBetween_deg(along_W.xyz, along_before_W.xyz) > kMostTiltOff_deg) {
    const std::string words = tiltText(along_W, along_before_W);
    announcements_.refuse("Tilt it as before" + (words.empty() ? "." : ": " + words + "."));
    return TouchEvent::nothing;
  }
  // Aiming at a cross is inexact along the line of sight.
  glm::dvec3 apart_mm = arm_.tip_W(take.raw_rad).mm - arm_.tip_W(before).mm;
  if (plan_.kind == calibration::TargetKind::cross) apart_mm.z = 0.0;
  confirming_.reset();
  if (glm::length(apart_mm) <= sameCount_mm(plan_.precision)) {
    last_rad_ = take.raw_rad;
    announcements_.praise("The zero of the device is unchanged: go on.");
    return TouchEvent::nothing;
  }
  retakeAll();
  announcements_.refuse("The zero of the device has changed since it was silent (" + mmText(glm::length(apart_mm)) +
                        " apart): these touches start again.");
  return TouchEvent::started_again;
}

TouchRound::TouchEvent TouchRound::pause(Press press) {
  const auto chosen = pause_->update(press);
  if (!chosen) return TouchEvent::nothing;
  // In the inkwell the menu stays: going on is taking the stylus up.
  if (*chosen == 0) {
    if (docked_)
      announcements_.say("Take the stylus out of its inkwell to go on.");
    else
      pause_.reset();
    return TouchEvent::nothing;
  }
  if (!docked_) pause_.reset();
  if (*chosen == 2) return TouchEvent::left;
  retakeAll();
  announcements_.say("All touches of this page start again.");
  return TouchEvent::started_again;
}

TouchRound::TouchEvent TouchRound::undo() {
  objected_.reset();
  if (order_.empty()) {
    pause_ = pauseMenu();
    return TouchEvent::nothing;
  }
  const std::size_t index = order_.back();
  order_.pop_back();
  taken_[index].reset();
  confirming_.reset();
  last_rad_.reset();
  announcements_.say("Undone: " + std::string(nounOf(plan_)) + " " + std::to_string(index + 1) + ".");
  return TouchEvent::undone;
}

void TouchRound::lost() {
  still_.forget();
  objected_.reset();
  if (!order_.empty()) confirming_ = order_.back();
}

void TouchRound::keepTime(double t_s) {
  const double passed_s = t_s - seen_s_;
  if (now_ && !pause_ && passed_s < kIdle_s) busy_s_ += passed_s;
  seen_s_ = t_s;
}

void TouchRound::show(WizardView& view) const {
  const std::string noun = nounOf(plan_);
  view.target_kind = plan_.kind;
  view.zero_parallax = plan_.kind == calibration::TargetKind::cross;
  const auto glowing = confirming_ ? confirming_ : next();
  for (std::size_t i = 0; i < plan_.targets.size(); ++i) {
    TargetState state = TargetState::pending;
    if (taken_[i]) state = taken_[i]->doubtful ? TargetState::doubtful : TargetState::done;
    if (glowing == i) state = TargetState::next;
    view.targets.push_back({plan_.targets[i].position_W, plan_.targets[i].stylus_W, state, std::to_string(i + 1)});
  }

  if (now_ && !docked_) view.tip_W = arm_.tip_W(now_->raw_rad);
  if (now_ && glowing && !any_tilt_) {
    TiltCue cue{plan_.targets[*glowing].stylus_W, heldAlong_W(now_->raw_rad), 0.0, false, {}};
    cue.off_deg = angleBetween_deg(cue.present_W.xyz, cue.wanted_W.xyz);
    cue.met = cue.off_deg <= kMostTiltOff_deg;
    if (!cue.met) cue.words = tiltText(cue.present_W, cue.wanted_W);
    view.tilt = cue;
  }

  view.count = std::to_string(order_.size()) + " of " + std::to_string(taken_.size());
  view.progress = static_cast<double>(order_.size()) / static_cast<double>(std::max<std::size_t>(1, taken_.size()));
  const double interval_s = intervals_s_.empty() ? kUsualInterval_s : calibration::medianOf(intervals_s_);
  view.time_left_s = interval_s * static_cast<double>(taken_.size() - order_.size());

  if (pause_) {
    view.sentence = docked_ ? "Paused. Take the stylus out to go on." : "Nothing to undo. Go on?";
    pause_->show(view);
    return;
  }
  view.capture = still_.progress();
  view.button = {"take this " + noun, order_.empty() ? "pause" : "undo the last", "takes it automatically"};
  if (confirming_)
    view.sentence = "The device was silent. Touch " + noun + " " + std::to_string(*confirming_ + 1) +
                    " once more, to check the zero of the device.";
}

std::optional<std::size_t> TouchRound::next() const {
  for (std::size_t i = 0; i < taken_.size(); ++i)
    if (!taken_[i]) return i;
  return std::nullopt;
}

bool TouchRound::isComplete() const { return !next() && !confirming_; }

std::vector<calibration::Touch> TouchRound::touches() const {
  std::vector<calibration::Touch> touches;
  for (std::size_t i = 0; i < taken_.size(); ++i)
    if (taken_[i]) touches.push_back({plan_.targets[i].id, taken_[i]->raw_rad, plan_.targets[i].position_W, true});
  return touches;
}

double TouchRound::tiltSpread_deg() const {
  std::vector<glm::dvec3> directions;
  for (const auto& taken : taken_)
    if (taken) directions.push_back(heldAlong_W(taken->raw_rad).xyz);
  return calibration::pairSpread_deg(directions);
}

std::vector<std::size_t> TouchRound::wronglyTilted() const {
  std::vector<std::size_t> wrong;
  std::size_t touch = 0;
  for (const auto& taken : taken_)
    if (taken) {
      if (taken->wrongly_tilted) wrong.push_back(touch);
      ++touch;
    }
  return wrong;
}

void TouchRound::setArm(const calibration::MeasuredArm& arm, double max_distance_mm) {
  arm_ = arm;
  max_distance_mm_ = max_distance_mm;
}

void TouchRound::setDoubtful(const std::vector<bool>& doubtful) {
  std::size_t touch = 0;
  for (auto& taken : taken_)
    if (taken && touch < doubtful.size()) taken->doubtful = doubtful[touch++];
}

void TouchRound::again(std::size_t touch) {
  const std::size_t index = planIndex(touch);
  taken_[index].reset();
  std::erase(order_, index);
  last_rad_.reset();
  objected_.reset();
}

void TouchRound::retakeAll() {
  std::fill(taken_.begin(), taken_.end(), std::nullopt);
  order_.clear();
  intervals_s_.clear();
  last_rad_.reset();
  objected_.reset();
  confirming_.reset();
}

std::string TouchRound::nameOf(std::size_t touch) const {
  return std::string(nounOf(plan_)) + " " + std::to_string(planIndex(touch) + 1);
}

bool TouchRound::isDoubtful(std::size_t touch) const {
  const auto& taken = taken_[planIndex(touch)];
  return taken && taken->doubtful;
}

std::size_t TouchRound::planIndex(std::size_t touch) const {
  for (std::size_t i = 0; i < taken_.size(); ++i)
    if (taken_[i] && touch-- == 0) return i;
  return taken_.size() - 1;
}

calibration::Vector<calibration::World> TouchRound::heldAlong_W(const calibration::RawJoints& raw_rad) const {
  return {arm_.X_WH(raw_rad).rotation * -glm::normalize(arm_.correction.tip_H_mm)};
}

}  // namespace app
