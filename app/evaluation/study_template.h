// A cooperative evaluation as its designer writes it once, TOML: the case, tasks with rules, prompts, questionnaires
// (example.toml). Strict: what is wrong, misspelt or missing is refused in one line with file, line and key. Lengths in
// s. Plain values; start-up only.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/evaluation/rule.h"
#include "app/study/questionnaire.h"

namespace app {

/// What the participant allows, each by itself.
inline constexpr std::array<std::string_view, 5> kConsentStreams{"log", "audio", "picture", "quotes", "reuse"};

/// When its time is over: the evaluator is asked, or it ends with that result.
enum class AtTimeBox : std::uint8_t { ask, partly, failed };

struct TaskTemplate {
  std::string id, say;
  std::string tool;  ///< put into the hand as the task begins; empty: what is in it stays
  double time_box_s = 0.0;
  Rule success;
  std::optional<Rule> fail;
  double hold_s = 0.0;  ///< a rule has to hold that long
  AtTimeBox at_time_box = AtTimeBox::ask;
};

struct PromptTemplate {
  std::string id, say;
};

struct AskedQuestionnaire {
  std::string use;  ///< as questionnaireNamed() takes it
  Questionnaire questionnaire;
  std::vector<std::string> groups;  ///< it is for these; empty: for everybody
};

enum class OrderKind : std::uint8_t { as_written, latin_square, shuffled };

/// What is done to one tooth, as `molar rehearse` takes it; empty: as the command line says.
struct OperationTemplate {
  std::string task;           ///< "root-canal", "preparation"
  std::optional<int> tooth;   ///< FDI
  std::string ideal, caries;  ///< of a preparation
  std::string preset;         ///< a whole feel by one name (app/options/feel_preset)
};

struct StudyTemplate {
  std::string title, language;
  std::string case_name;  ///< one of app/case's; empty: as the command line says
  OperationTemplate operation;
  std::string consent_file;  ///< beside the template
  OrderKind order = OrderKind::as_written;
  std::uint64_t seed = 1;  ///< of the order
  int retention_days = 365;
  double silence_s = 20.0;    ///< quiet for so long, the participant is asked what he does
  std::string warm_up_block;  ///< a practice block; empty: no warm-up
  double warm_up_s = 0.0;
  bool law_may_change = false, layers_may_change = true;  ///< during a task; each change is logged
  std::vector<PromptTemplate> prompts;
  std::vector<TaskTemplate> tasks;
  std::vector<AskedQuestionnaire> questionnaires;

  /// Place in `tasks`; none: there is no such task.
  std::optional<std::size_t> taskNamed(std::string_view id) const;
  /// Those that a participant of this group is asked, in order.
  std::vector<const AskedQuestionnaire*> questionnairesFor(std::string_view group) const;
  /// Instruments of all tasks, each once, in order.
  std::vector<std::string> tools() const;
};

/// `where` names the file. Throws assets::LoadError.
StudyTemplate studyTemplateFrom(std::string_view text, const std::string& where);

}  // namespace app
