// What the participant is asked at the terminal, where no script speaks: consent, stream by stream, and questionnaires,
// item by item. Main thread; as long as it takes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "app/evaluation/evaluation_course.h"

namespace app {

using ClockNs = std::function<std::int64_t()>;

/// Shows the text; ends early where the terminal closes.
void askConsentAtTerminal(EvaluationCourse& course, const std::string& text, const ClockNs& now_ns);
/// And submits it. A refused answer is asked for again.
void askAtTerminal(EvaluationCourse& course, const Questionnaire& questionnaire, const ClockNs& now_ns);

}  // namespace app
