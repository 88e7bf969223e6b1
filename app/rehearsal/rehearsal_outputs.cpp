#include "app/rehearsal/rehearsal_outputs.h"
#include "app/text/message.h"

#include <exception>
#include <string>

namespace app {

void takeSnapshot(LiveView& picture, const render::Frame& frame, bool is_real_time, EventLog& event_log) {
  if (!is_real_time) {
    picture.display().renderer();
    picture.uploadBone();
    picture.showInstrument();
    picture.show(frame);
  }
  try {
    const std::string path = saveNextSnapshot(picture.newest());
    event_log.note("snapshot", path);
    printMessage("snapshot " + path);
  } catch (const std::exception& error) {
    printMessage(error.what());
  }
}

int exitStatus(const RehearsalFigures& figures) { return figures.recording && !figures.recording->isWhole() ? 1 : 0; }

}  // namespace app
