// What a rehearsal leaves behind besides its recording: pictures before the first cut, on the way and at the end, the
// summary, the program's answer. Pictures with a name are claimed before the work. Main thread.
#pragma once

#include <cstdio>
#include <optional>
#include <span>

#include "app/rehearsal/journal.h"
#include "app/rehearsal/live_picture.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/rehearsal_summary.h"
#include "app/view/snapshot.h"

namespace app {

class RehearsalOutputs {
 public:
  /// Refuses (LoadError) what is there already.
  explicit RehearsalOutputs(const RehearsalPlan& plan);

  /// As far as asked for.
  void takeFirst(LivePicture& picture, const render::Frame& frame, std::span<const std::uint8_t> solid);
  void takeLast(LivePicture& picture, const render::Frame& frame, std::span<const std::uint8_t> solid);

 private:
  std::optional<EyePictures> first_, last_;
};

/// The newest picture under the first free name; says where, or why not. Where nobody watches the frame is drawn for
/// it.
void takeSnapshot(LivePicture& picture, const render::Frame& frame, bool is_watched, Journal& journal);

/// The program's answer: 1 where a recording was asked for and is not whole.
int answerOf(const RehearsalFigures& figures);

}  // namespace app
