#include "app/evaluation/participant_terminal.h"

#include <cstdio>
#include <limits>
#include <string_view>

#include "app/evaluation/evaluator_terminal.h"
#include "app/text/message.h"
#include "app/text/parse_number.h"

namespace app {
namespace {

void askStream(EvaluationCourse& course, const std::string& stream, const ClockNs& now_ns) {
  for (;;) {
    const auto line = askedAtTerminal(stream + ": may it be kept? y or n:");
    if (!line) return;
    if (*line != "y" && *line != "n") continue;
    course.take({now_ns(), {}, "participant", "consent", {{"stream", stream}, {"given", *line == "y"}}});
    return;
  }
}

/// " 1 Effort, 2 Frustration".
std::string choicesOf(const QuestionItem& item) {
  std::string text;
  for (std::size_t n = 0; n < item.choices.size(); ++n)
    text += (n == 0 ? " " : ", ") + std::to_string(n + 1) + " " + item.choices[n];
  return text;
}

}  // namespace

void askConsentAtTerminal(EvaluationCourse& course, const std::string& text, const ClockNs& now_ns) {
  std::fprintf(stderr, "\n%s\n", text.c_str());
  for (const std::string_view stream : kConsentStreams) askStream(course, std::string(stream), now_ns);
}

void askAtTerminal(EvaluationCourse& course, const Questionnaire& questionnaire, const ClockNs& now_ns) {
  std::fprintf(stderr, "\n%s\n", questionnaire.title.c_str());
  if (!questionnaire.isOfWords())
    std::fprintf(stderr, "%d %s … %d %s, empty: no answer\n", questionnaire.low, questionnaire.scale.front().c_str(),
                 questionnaire.high, questionnaire.scale.back().c_str());
  for (const QuestionItem& item : questionnaire.items)
    for (bool is_taken = false; !is_taken;) {
      const auto line = askedAtTerminal(item.says + choicesOf(item) + ":");
      if (!line) return;
      LogEvent answer{now_ns(), {}, "participant", "answer", {{"questionnaire", questionnaire.id}, {"item", item.id}}};
      if (questionnaire.isOfWords()) {
        answer.data.emplace_back("words", *line);
      } else if (!line->empty()) {
        // What is no number is out of every range.
        answer.data.emplace_back("value",
                                 parseNumber<double>(*line).value_or(std::numeric_limits<double>::quiet_NaN()));
      }
      const auto refused = course.take(answer);
      if (refused) printMessage(*refused);
      is_taken = !refused;
    }
  course.take({now_ns(), {}, "participant", "submit", {{"questionnaire", questionnaire.id}}});
}

}  // namespace app
