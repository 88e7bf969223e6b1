// `molar psychophysics PROTOCOL.toml --out results.csv`: two stimuli on one bone, blind, by a simulated participant or
// by a person at the window. One CSV row a trial as they come; summary JSON and picture beside it at the end.

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/commands/command.h"
#include "app/psychophysics/probed_bone.h"
#include "app/psychophysics/summary.h"
#include "app/psychophysics/trial_table.h"
#include "app/settings_text.h"
#include "app/toml_keys.h"
#include "app/usage_error.h"
#include "assets/output_file.h"

namespace app {
namespace {

struct PsychophysicsOptions {
  std::string protocol, out, observer = "simulated";
  std::uint64_t seed = 1;
  bool force = false;
};

/// results.csv and results.json.
std::string beside(const std::string& csv, const char* ending) {
  return std::filesystem::path(csv).replace_extension(ending).string();
}

void writeText(const std::string& text, assets::OutputFile& file) {
  std::ofstream out(file.temporaryPath(), std::ios::binary);
  out << text;
  out.close();
  if (!out) throw UsageError("summary: it can not be written, check the free space");
  file.commit();
}

int run(const PsychophysicsOptions& options) {
  if (std::filesystem::path(options.out).extension() != ".csv")
    throw UsageError("--out " + options.out + ": rows are CSV, give a name that ends in .csv");
  refuseSameFile(options.out, {options.protocol});
  const Protocol protocol = protocolFromToml(readSmallFile(options.protocol), options.protocol);
  if (protocol.bone.kind == BoneChoice::Kind::volume) refuseSameFile(options.out, {protocol.bone.path});
  assets::OutputFile summary(beside(options.out, ".json"), options.force);
  const ProbedBone bone = probedBone(protocol);
  TrialTable table(options.out, options.force, protocol);

  std::vector<TrialRecord> trials;
  const bool shows_progress = isatty(2) != 0;
  haptics::CarvedBone live(bone.patient.ct.grid, bone.patient.ct.solid, bone.patient.ct.label);
  const Experiment experiment =
      runSimulated(protocol, live, bone.site, options.seed, [&](const TrialRecord& record, const Experiment& running) {
        table.add(record);
        trials.push_back(record);
        if (shows_progress) std::fprintf(stderr, "\rtrial %d of at most %d ", record.trial, running.most());
      });
  if (shows_progress) std::fputc('\n', stderr);
  const Outcome outcome = outcomeOf(protocol, experiment, std::move(trials), true, options.seed);
  writeText(summaryJson(protocol, outcome, options.seed, options.observer), summary);
  std::fputs(summaryWords(protocol, outcome).c_str(), stderr);
  return 0;
}

}  // namespace

void addPsychophysics(CLI::App& molar, Chosen& chosen) {
  auto options = std::make_shared<PsychophysicsOptions>();
  CLI::App* command =
      molar.add_subcommand("psychophysics", "Which of two feels harder? Blind comparisons by protocol: CSV, JSON");
  command->add_option("PROTOCOL", options->protocol, "Experiment, TOML (app/psychophysics/example.toml)")->required();
  command->add_option("--out", options->out, "A row a trial, .csv; the summary goes beside it as .json")->required();
  command->add_option("--observer", options->observer, "Who answers: simulated")
      ->check(CLI::IsMember({"simulated"}))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of order, hand and observer")->capture_default_str();
  command->add_flag("--force", options->force, "Replace outputs that exist");
  command->callback([options, &chosen] { chosen.action = [options] { return run(*options); }; });
}

}  // namespace app
