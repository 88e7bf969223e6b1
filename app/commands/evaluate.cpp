// `molar evaluate TEMPLATE.toml --participant P07 --out STUDY`: one session of a cooperative evaluation.

#include <memory>

#include "app/commands/command.h"
#include "app/commands/evaluation_session.h"
#include "app/text/command_line.h"

namespace app {

void addEvaluate(CommandLine& molar) {
  auto options = std::make_shared<EvaluateOptions>();
  CommandLine& command =
      molar.command("evaluate", "A session of a cooperative evaluation: consent, tasks with rules, questions, tables");
  command.example(
      "molar evaluate app/evaluation/example.toml --participant P01 --out STUDY --device scripted --headless --pace "
      "fast "
      "--script app/evaluation/example_script.jsonl",
      "without people: the scripted hand does the tasks");
  command.example("molar evaluate T.toml --participant P07 --group surgeon --out STUDY --instructor",
                  "at the desk; the evaluator types at this terminal");
  command.example("molar evaluate T.toml --participant P07 --out STUDY --page 127.0.0.1:8080",
                  "evaluator and participant at pages of a browser, the whole session through");
  command
      .option("TEMPLATE", options->study_template, "Case, tasks, rules, questions: TOML (app/evaluation/example.toml)")
      .required();
  command.option("--participant", options->participant, "Code, as P07, never a name").required();
  command.option("--out", options->out, "Folder of the study; each session gets one of its own in it")
      .valueNamed("STUDY")
      .required();
  command.option("--group", options->group, "Of the participant, as surgeon or student");
  command.option("--evaluator", options->evaluator, "Code of who writes notes and rates problems").showsDefault();
  command.option("--script", options->script, "What evaluator and participant say, JSON lines, instead of the terminal")
      .valueNamed("EVENTS.jsonl");
  command
      .option("--page", options->page,
              "Serve evaluator's and participant's page there, instead of the terminal; port 0: any")
      .valueNamed("ADDRESS:PORT");
  command.flag("--share", options->share,
               "The page may be reached by other machines: encrypted, with a code of six digits");
  command
      .option(
          "--microphone", options->microphone,
          "Where voice is recorded from, if the participant allows it: default, none, file:F.wav (48 kHz), as if it "
          "were heard, file:F.wav,realtime")
      .showsDefault();
  addRehearseOptions(command, options->rehearsal);
  command.does([options] { return runEvaluation(*options); });
}

}  // namespace app
