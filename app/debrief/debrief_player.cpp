#include "app/debrief/debrief_player.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "app/text/elapsed.h"
#include "app/text/message.h"
#include "assets/load_error.h"

namespace app {
namespace {

constexpr double kStill_s = 0.25;
constexpr double kPrepareFor_s = 0.15;  ///< wall time between two drawings
constexpr double kPart_s = 0.2;         ///< of the session
constexpr double kFrame_s = 1.0 / 20.0;
constexpr std::chrono::seconds kBetweenUnprepared{2};

}  // namespace

DebriefPlayer::DebriefPlayer(const DebriefPlan& plan) : plan_(plan), scene_(plan) {
  transport_.setLength(scene_.length_s());
}

void DebriefPlayer::open(const render::RenderOptions& options, bool on_processor) {
  on_processor_ = on_processor;
  scene_.open(options);
  ladder_.emplace(kFrame_s, on_processor ? static_cast<int>(render::kQualitySteps.size()) - 1 : 0);
}

bool DebriefPlayer::advance(double passed_s) {
  if (!scene_.isPrepared()) return prepare();
  transport_.advance(passed_s);
  followVoice();
  return false;
}

bool DebriefPlayer::prepare() {
  const Clock::time_point from = Clock::now();
  while (secondsBetween(from, Clock::now()) < kPrepareFor_s && scene_.prepare(kPart_s)) {
  }
  share_ = scene_.isPrepared() ? 1.0 : std::min(0.999, scene_.preparedShare());
  if (!scene_.isPrepared()) return false;
  std::size_t bytes = 0, keyframes = 0;
  for (const auto& run : scene_.runs()) {
    bytes += run->moments().bytes(), keyframes += run->moments().keyframes();
    for (const std::string& remark : run->remarks()) printMessage(run->name() + ": " + remark);
  }
  printMessage(fmt::format("run again in {:.1f} s: {} keyframes, {:.0f} MB", secondsBetween(begun_, Clock::now()),
                           keyframes, static_cast<double>(bytes) / 1e6));
  transport_.setLength(scene_.length_s());
  transport_.goTo(plan_.at_s);
  openVoice();
  shown_.reset();
  return true;
}

/// Of the first session.
void DebriefPlayer::openVoice() {
  const DebriefRun& run = *scene_.runs().front();
  try {
    voice_.emplace(run.path(), run.moments().start().dt_s, plan_.voice_opener);
  } catch (const assets::LoadError& damage) {
    printMessage(damage.what());
  }
}

void DebriefPlayer::followVoice() {
  if (!voice_) return;
  const bool plays_along = transport_.isPlaying() && !transport_.isBackwards() && transport_.speed() == 1.0;
  voice_->follow(transport_.position_s(), plays_along, scrubs_);
}

bool DebriefPlayer::draw(glm::ivec2 px, const PictureChoice& choice) {
  const Clock::time_point now = Clock::now();
  const double position_s = transport_.position_s();
  const bool is_same = shown_ && shown_->position_s == position_s && shown_->px == px && shown_->choice == choice &&
                       !view_changed_ && (scene_.isPrepared() || now - drawn_at_ < kBetweenUnprepared);
  const bool lets_go = is_same && shown_->is_near && !scrubs_;
  if (is_same && !lets_go && (shown_->is_refined || secondsBetween(drawn_at_, now) < kStill_s)) return false;
  // A hand on the time line is followed at once and roughly; where it rests comes the moment itself.
  if (is_same && scrubs_ && !shown_->is_near) return false;
  const bool jumps = !is_same && shown_ && !transport_.isPlaying() && shown_->position_s != position_s;
  const bool is_near = scrubs_ && !is_same, refines = is_same && !scrubs_ && scene_.isPrepared();
  if (scene_.isPrepared() && (!refines || shown_->is_near)) {
    if (jumps) jump_at_ = now;
    is_near ? scene_.goNear(position_s) : scene_.goTo(position_s);
  }
  scene_.choice = choice;
  const Clock::time_point begun = Clock::now();
  const bool is_rough = on_processor_ && (is_near || jumps);
  const auto look = refines                                         ? DebriefRun::Look::now
                    : transport_.isPlaying() && scene_.isPrepared() ? DebriefRun::Look::each_second
                                                                    : DebriefRun::Look::never;
  scene_.draw(px,
              refines    ? render::kQualitySteps.front().quality
              : is_rough ? kScrubQuality
                         : ladder_->quality(),
              look);
  if (!refines && !is_near && !is_rough) ladder_->add(secondsBetween(begun, Clock::now()), true);
  shown_ = Shown{position_s, px, choice, refines, is_near};
  view_changed_ = false;
  drawn_at_ = Clock::now();
  return true;
}

render::Image DebriefPlayer::fullPicture(glm::ivec2 px, std::optional<double> at_s) {
  scene_.goTo(at_s.value_or(transport_.position_s()));  // a dragging hand left it at a keyframe
  scene_.draw(px, render::kQualitySteps.front().quality);
  shown_.reset();
  return scene_.image();
}

void DebriefPlayer::noteShown() {
  if (jump_at_) jumps_ms_.push_back(1e3 * secondsBetween(*std::exchange(jump_at_, std::nullopt), Clock::now()));
}

std::string DebriefPlayer::jumpsText() const {
  if (jumps_ms_.empty()) return "";
  std::vector<double> sorted = jumps_ms_;
  std::ranges::sort(sorted);
  return fmt::format("{} jumps: median {:.0f} ms, longest {:.0f} ms until shown", sorted.size(),
                     sorted[sorted.size() / 2], sorted.back());
}

}  // namespace app
