#include "app/check_page/import_stages.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

/// What is done of a stage that takes about as long as 1: straight at first, then ever slower.
double shareAfter(double time) {
  constexpr double kStraight = 0.8, kRest = 1.0 - kStraight;
  return time < kStraight ? time : 1.0 - kRest * std::exp(-(time - kStraight) / kRest);
}

}  // namespace

void ImportStages::end(double at_s) {
  for (ImportStage& stage : stages_)
    if (stage.state == ImportStage::State::runs)
      stage.state = ImportStage::State::done, stage.took_s = at_s - stage.begun_s;
}

void ImportStages::begin(std::string_view name, double at_s) {
  end(at_s);
  const auto waits = [](const ImportStage& stage) { return stage.state == ImportStage::State::waits; };
  const auto first = std::ranges::find_if(stages_, waits);
  auto here = std::find_if(first, stages_.end(), [&](const ImportStage& stage) { return stage.name == name; });
  if (here == stages_.end())
    here = stages_.insert(first, {.name = std::string(name)});
  else
    here = stages_.erase(first, here);
  here->state = ImportStage::State::runs, here->begun_s = at_s;
}

const ImportStage* ImportStages::running() const {
  const auto running = std::ranges::find(stages_, ImportStage::State::runs, &ImportStage::state);
  return running == stages_.end() ? nullptr : &*running;
}

double ImportStages::slowness() const {
  constexpr double kTelling_s = 0.5, kMost = 50.0;
  double usual_s = 0.0, took_s = 0.0;
  for (const ImportStage& stage : stages_)
    if (stage.state == ImportStage::State::done && stage.usual_s > 0.0)
      usual_s += stage.usual_s, took_s += stage.took_s;
  return usual_s < kTelling_s ? 1.0 : std::clamp(took_s / usual_s, 1.0 / kMost, kMost);
}

double ImportStages::secondsOf(const ImportStage& stage, double at_s) const {
  return stage.state == ImportStage::State::runs ? at_s - stage.begun_s : stage.took_s;
}

double ImportStages::shareOf(const ImportStage& stage, double at_s) const {
  if (stage.state != ImportStage::State::runs) return stage.state == ImportStage::State::done ? 1.0 : 0.0;
  if (stage.usual_s <= 0.0) return 0.0;
  return shareAfter((at_s - stage.begun_s) / (stage.usual_s * slowness()));
}

double ImportStages::share(double at_s) const {
  double done_s = 0.0, all_s = 0.0;
  for (const ImportStage& stage : stages_) done_s += stage.usual_s * shareOf(stage, at_s), all_s += stage.usual_s;
  return all_s > 0.0 ? done_s / all_s : 0.0;
}

std::vector<ImportStage> expectedImportStages() {
  std::vector<ImportStage> stages;
  const auto expect = [&stages](const char* name, double usual_s) {
    stages.push_back({.name = name, .usual_s = usual_s});
  };
  expect("files", 0.5);
  expect("pictures", 2.5);
  expect("grey values", 8.0);
  expect("shading", 4.5);
  expect("row of teeth", 1.0);
  expect("lower jaw", 5.0);
  expect("teeth", 4.0);
  expect("tooth surfaces", 2.0);
  expect("tissues", 0.5);
  expect("right canal", 1.5);
  expect("left canal", 1.5);
  expect("labels", 5.0);
  expect("gum", 5.0);
  expect("face", 4.5);
  expect("writing", 10.0);
  return stages;
}

}  // namespace app
