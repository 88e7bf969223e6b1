#include "app/rehearsal/rehearsal_outputs.h"
#include "app/text/said.h"

#include <exception>
#include <string>

namespace app {

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
    say("snapshot " + path);
  } catch (const std::exception& error) {
    say(error.what());
  }
}

int answerOf(const RehearsalFigures& figures) { return figures.recording && !figures.recording->isWhole() ? 1 : 0; }

}  // namespace app
