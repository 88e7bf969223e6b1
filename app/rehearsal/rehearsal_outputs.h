// What a rehearsal leaves behind besides its recording and summary: pictures on the way, the program's answer. Main
// thread.
#pragma once

#include "app/rehearsal/event_log.h"
#include "app/rehearsal/live_view.h"
#include "app/rehearsal/rehearsal_summary.h"

namespace app {

/// The newest picture under the first free name; says where, or why not. Where nobody watches the frame is drawn for
/// it.
void takeSnapshot(LiveView& picture, const render::Frame& frame, bool is_real_time, EventLog& event_log);

/// The program's answer: 1 where a recording was asked for and is not whole.
int exitStatus(const RehearsalFigures& figures);

}  // namespace app
