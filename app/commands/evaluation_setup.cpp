#include "app/commands/evaluation_setup.h"

#include <algorithm>
#include <array>

#include "app/evaluation/evaluator_terminal.h"
#include "app/text/anonymous_id.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"

namespace app {

RehearseOptions warmUpOptions(const RehearseOptions& main, const StudyTemplate& study) {
  RehearseOptions warm;
  warm.case_name = study.warm_up_block;
  warm.no_record = true;
  warm.rig = main.rig, warm.pedal = main.pedal, warm.falcon_firmware = main.falcon_firmware;
  warm.shaft = main.shaft, warm.law = main.law, warm.erosion = main.erosion, warm.size = main.size;
  warm.pace = main.pace, warm.picture = main.picture, warm.settings = main.settings, warm.display = main.display;
  warm.position = main.position, warm.monitor = main.monitor, warm.loupes = main.loupes;
  warm.no_line = main.no_line, warm.no_sound = main.no_sound;
  warm.plan.device = main.plan.device, warm.plan.device_options = main.plan.device_options;
  warm.plan.headless = main.plan.headless, warm.plan.instructor_window = main.plan.instructor_window;
  warm.plan.rate_Hz = main.plan.rate_Hz, warm.plan.parameters = main.plan.parameters;
  warm.plan.seconds = study.warm_up_s;
  warm.plan.summary = false;
  return warm;
}

void takeCase(RehearseOptions& options, const StudyTemplate& study) {
  const OperationTemplate& operation = study.operation;
  if (!study.case_name.empty()) options.case_name = study.case_name;
  if (!study.tools().empty()) options.tools = study.tools();
  if (!operation.task.empty()) options.task = operation.task;
  if (operation.tooth) options.tooth = operation.tooth;
  if (!operation.ideal.empty()) options.ideal = operation.ideal;
  if (!operation.caries.empty()) options.caries = operation.caries;
  if (!operation.preset.empty()) options.preset = operation.preset;
}

namespace {

/// What the template names is no choice of the command line.
void refuseSecondOperation(const EvaluateOptions& options, const OperationTemplate& named) {
  static const RehearseOptions kUntouched;
  const RehearseOptions& given = options.rehearsal;
  const auto refuse = [&](const char* option, const std::string& value) {
    throw UsageError(std::string(option) + ": " + options.study_template + " names " + value + ", leave it out");
  };
  if (!named.task.empty() && given.task != kUntouched.task) refuse("--task", named.task);
  if (named.tooth && given.tooth) refuse("--tooth", std::to_string(*named.tooth));
  if (!named.ideal.empty() && !given.ideal.empty()) refuse("--ideal", named.ideal);
  if (!named.caries.empty() && !given.caries.empty()) refuse("--caries", named.caries);
  if (!named.preset.empty() && !given.preset.empty()) refuse("--preset", named.preset);
}

}  // namespace

void refuseUnlessFits(const EvaluateOptions& options, const StudyTemplate& study) {
  const RehearseOptions& rehearsal = options.rehearsal;
  static const RehearseOptions kUntouched;
  if (!isAnonymousId(options.participant)) throw UsageError("--participant: give a code as P07, never a name");
  if (!isAnonymousId(options.evaluator)) throw UsageError("--evaluator: give a code as E1, never a name");
  if (!rehearsal.record.empty() || rehearsal.no_record)
    throw UsageError("evaluate: a session is recorded into --out, leave --record and --no-record out");
  if (!rehearsal.continued.empty())
    throw UsageError("--continue " + rehearsal.continued + ": every participant begins alike, leave it out");
  if (!study.case_name.empty() && (!rehearsal.patient.empty() || !rehearsal.case_name.empty()))
    throw UsageError("evaluate: " + options.study_template + " names the case " + study.case_name +
                     ", leave PATIENT and --case out");
  refuseSecondOperation(options, study.operation);
  if (!study.tools().empty() && rehearsal.tools != kUntouched.tools)
    throw UsageError("--tool: " + options.study_template + " names the tasks' tools, leave it out");
  std::vector<std::string> groups;
  for (const AskedQuestionnaire& asked : study.questionnaires)
    for (const std::string& group : asked.groups)
      if (std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
  if (!groups.empty() && std::ranges::find(groups, options.group) == groups.end())
    throw UsageError("--group " + options.group + ": give one of " + joined(groups));
  if (!options.page.empty() && !options.script.empty())
    throw UsageError("--page " + options.page + ": --script speaks in the place of people, leave one of them out");
  if (!options.page.empty() && rehearsal.pace == "fast")
    throw UsageError("--page " + options.page + ": nobody can follow --pace fast, leave one of them out");
  if (options.page.empty() && options.share) throw UsageError("--share: is for a page, give --page ADDRESS:PORT");
  if (options.page.empty() && options.script.empty() && !isTerminalThere())
    throw UsageError(
        "evaluate: consent and questions are asked at a terminal, run it in one or give --page or --script");
}

DebriefPlan debriefPlanOf(const RehearseOptions& main, const RehearsalPlan& plan) {
  using enum render::DisplayMode;
  // Those that fill a part of a window like any other.
  constexpr std::array kWithinWindow{side_by_side, top_bottom, anaglyph, anaglyph_red_cyan};
  constexpr glm::ivec2 kUnseen_px{960, 540};
  DebriefPlan debrief;
  debrief.patient = main.patient;
  debrief.backend = plan.backend;
  debrief.choice.mode = plan.first_frame.mode;
  debrief.choice.layers = plan.first_frame.layers;
  if (std::ranges::find(kWithinWindow, plan.display) != kWithinWindow.end()) debrief.choice.display = plan.display;
  debrief.choice.has_line = !main.no_line;
  debrief.loupes = main.loupes.value_or(debrief.loupes);
  debrief.full_screen = plan.full_screen;
  debrief.monitor = plan.monitor;
  if (plan.headless) debrief.size_px = kUnseen_px;
  return debrief;
}

}  // namespace app
