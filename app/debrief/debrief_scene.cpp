#include "app/debrief/debrief_scene.h"

#include <algorithm>

#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr int kBetween_px = 4;

}  // namespace

DebriefScene::DebriefScene(const DebriefPlan& plan)
    : choice(plan.choice), loupes_(plan.loupes), first_px_(plan.size_px) {
  for (const std::string& session : plan.sessions) runs_.push_back(std::make_unique<DebriefRun>(session, plan.patient));
  const StoredStart& first = runs_.front()->moments().start();
  for (const auto& run : runs_)
    if (!(run->moments().start().grid == first.grid) || run->moments().start().label != first.label)
      throw UsageError(run->path() + ": is of another case than " + runs_.front()->path() +
                       ", name two sessions of one case");
}

void DebriefScene::open(const render::RenderOptions& options) {
  pictures_.clear();
  for (const auto& run : runs_) pictures_.push_back(std::make_unique<DebriefPicture>(*run, options));
  const calibration::Rig first = DebriefPicture::firstRig(*runs_.front(), sizeOfOne(first_px_), loupes_);
  view_.emplace(first, first.X_WP * calibration::Point<calibration::Patient>{runs_.front()->patient().focus_P_mm()});
}

double DebriefScene::length_s() const {
  double length_s = 0.0;
  for (const auto& run : runs_) length_s = std::max(length_s, run->length_s());
  return length_s;
}

bool DebriefScene::prepare(double most_s) {
  bool goes_on = false;
  for (const auto& run : runs_) goes_on = run->prepare(most_s) || goes_on;
  return goes_on;
}

void DebriefScene::prepareTo(double t_s) {
  constexpr double kPart_s = 1.0;
  for (const auto& run : runs_)
    while (run->preparedTo_s() <= t_s && run->prepare(kPart_s)) {
    }
}

bool DebriefScene::isPrepared() const {
  return std::ranges::all_of(runs_, [](const auto& run) { return run->isPrepared(); });
}

double DebriefScene::preparedShare() const {
  double all_s = 1e-9, done_s = 0.0;
  for (const auto& run : runs_) {
    all_s += run->length_s();
    done_s += run->isPrepared() ? run->length_s() : run->preparedTo_s();
  }
  return std::min(1.0, done_s / all_s);
}

void DebriefScene::goTo(double t_s) {
  for (const auto& run : runs_) run->goTo(t_s);
}

void DebriefScene::goNear(double t_s) {
  for (const auto& run : runs_) run->goNear(t_s);
}

glm::ivec2 DebriefScene::sizeOfOne(glm::ivec2 px) const {
  const auto count = static_cast<int>(runs_.size());
  return glm::max(glm::ivec2((px.x - (count - 1) * kBetween_px) / count, px.y), glm::ivec2(16));
}

void DebriefScene::draw(glm::ivec2 px, const render::Quality& quality, DebriefRun::Look look) {
  drawn_px_ = sizeOfOne(px);
  calibration::Rig rig = view_->rig();
  // Square pixels whatever the window's shape: as high as at first.
  const calibration::Rig shaped = DebriefPicture::firstRig(*runs_.front(), drawn_px_, loupes_ * view_->magnified());
  rig.screen = shaped.screen;
  for (std::size_t n = 0; n < pictures_.size(); ++n) {
    const haptics::Tick* const other = runs_.size() == 2 ? &runs_[1 - n]->moments().tick() : nullptr;
    pictures_[n]->update(choice, rig, view_->faceWindow_mm(), other, look);
    pictures_[n]->draw(quality);
  }
}

std::vector<std::optional<double>> DebriefScene::edges_mm() const {
  std::vector<std::optional<double>> lengths_mm;
  for (const auto& picture : pictures_) lengths_mm.push_back(picture->edges_mm());
  return lengths_mm;
}

void DebriefScene::showOnWindow(glm::ivec2 corner_px, glm::ivec2 window_px) {
  for (std::size_t n = 0; n < pictures_.size(); ++n) {
    const int left_px = corner_px.x + static_cast<int>(n) * (drawn_px_.x + kBetween_px);
    pictures_[n]->renderer().showOnWindow(
        {.size_px = drawn_px_, .corner_px = {left_px, window_px.y - corner_px.y - drawn_px_.y}});
  }
}

render::Image DebriefScene::image() {
  if (pictures_.size() == 1) return pictures_.front()->renderer().readImage();
  render::Image all;
  for (std::size_t n = 0; n < pictures_.size(); ++n) {
    const render::Image one = pictures_[n]->renderer().readImage();
    if (n == 0) {
      all.w = one.w * static_cast<int>(pictures_.size()) + kBetween_px * (static_cast<int>(pictures_.size()) - 1);
      all.h = one.h;
      all.rgba.assign(4 * static_cast<std::size_t>(all.w) * static_cast<std::size_t>(all.h), 255);
    }
    const std::size_t row = 4 * static_cast<std::size_t>(one.w);
    for (int y = 0; y < one.h; ++y) {
      const auto from = one.rgba.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row);
      const std::size_t left = 4 * n * static_cast<std::size_t>(one.w + kBetween_px);
      std::copy_n(from, row,
                  all.rgba.begin() + static_cast<std::ptrdiff_t>(
                                         4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(all.w) + left));
    }
  }
  return all;
}

}  // namespace app
