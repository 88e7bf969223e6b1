#include "app/evaluation/terminal_people.h"

#include <utility>

#include "app/evaluation/participant_terminal.h"
#include "app/text/message.h"

namespace app {

std::vector<Said> TerminalPeople::take(std::string_view, double) {
  std::vector<Said> said;
  if (keys_)
    for (LogEvent& event : keys_->take(parts_.clock.now_ns())) said.push_back({std::move(event), ""});
  return said;
}

void TerminalPeople::ask(Phase phase) {
  const ClockNs now_ns = [this] { return parts_.clock.now_ns(); };
  keys_.reset();
  if (phase == Phase::consent) askConsentAtTerminal(parts_.course, parts_.consent_text, now_ns);
  if (phase == Phase::tasks && isTerminalThere()) {
    std::vector<std::string> prompts;
    for (const PromptTemplate& prompt : parts_.study.prompts) prompts.push_back(prompt.id);
    keys_.emplace(std::move(prompts));
    printMessage(std::string(kEvaluatorKeys));
  }
  if (phase != Phase::debrief && phase != Phase::questionnaires) return;
  for (const AskedQuestionnaire* asked : parts_.study.questionnairesFor(parts_.group))
    if (asked->questionnaire.isOfWords() == (phase == Phase::debrief))
      askAtTerminal(parts_.course, asked->questionnaire, now_ns);
}

}  // namespace app
