#include "app/rehearsal/rehearsal_outputs.h"

#include <exception>
#include <string>

namespace app {

RehearsalOutputs::RehearsalOutputs(const RehearsalPlan& plan) {
  if (!plan.snapshot.empty()) last_.emplace(plan.snapshot, plan.overwrite);
  if (!plan.first_snapshot.empty()) first_.emplace(plan.first_snapshot, plan.overwrite);
}

void RehearsalOutputs::takeFirst(LivePicture& picture, const render::Frame& frame,
                                 std::span<const std::uint8_t> solid) {
  if (first_) picture.take(*first_, frame, solid);
}

void RehearsalOutputs::takeLast(LivePicture& picture, const render::Frame& frame, std::span<const std::uint8_t> solid) {
  if (last_) picture.take(*last_, frame, solid);
}

void takeSnapshot(LivePicture& picture, const render::Frame& frame, bool is_watched, Journal& journal) {
  if (!is_watched) {
    picture.display().renderer();
    picture.bringBone();
    picture.showInstrument();
    picture.show(frame);
  }
  try {
    const std::string path = saveNextSnapshot(picture.newest());
    journal.note("snapshot", path);
    journal.say("snapshot " + path);
  } catch (const std::exception& error) {
    journal.say(error.what());
  }
}

int answerOf(const RehearsalFigures& figures) { return figures.recording && !figures.recording->isWhole() ? 1 : 0; }

}  // namespace app
