#include "app/commands/study_owner.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "app/commands/bundle_extras.h"
#include "app/commands/stop_signals.h"
#include "app/commands/study_key.h"
#include "app/study/audit.h"
#include "app/study/bundle/bundle_check.h"
#include "app/study/bundle/study_bundle.h"
#include "app/study/privacy/passphrase.h"
#include "app/study/study_folder.h"
#include "app/study/withdrawal.h"
#include "app/text/anonymous_id.h"
#include "app/text/list.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "calibration/record/utc.h"

namespace app {
namespace {

struct OwnerOptions {
  std::string study, participant, stream, today, out, session, file, problem, into, rater;
  StudyKeyOption key;
  BundleExtras extras;
  bool dry_run = false, force = false;
};

int makeKeys(const OwnerOptions& options) {
  if (options.key.key.empty()) throw UsageError("study keys: where may the private key lie, give --key FILE");
  const Passphrase passphrase = passphraseFrom(options.key.passphrase_file, true);
  const PublicStudyKeys keys = createStudyKeys(options.study, options.key.key, passphrase.words());
  audit(options.study, nowUnix_s(), "keys", {{"key", keys.fingerprint()}});
  std::printf("%s\n", keys.fingerprint().c_str());
  printMessage("take " + options.key.key + " away, with a copy: without it and its passphrase nobody reads the words");
  if (const auto sessions = sessionsIn(options.study).size(); sessions > 0)
    printMessage(fmt::format("{} session{} from before stay{} open", sessions, sessions == 1 ? "" : "s",
                             sessions == 1 ? "s" : ""));
  return 0;
}

int takeBack(const OwnerOptions& options) {
  if (!isAnonymousId(options.participant)) throw UsageError("study withdraw: give a code as P07, never a name");
  const auto removals = withdrawalOf(options.study, options.participant, options.stream);
  for (const Removal& removal : removals) {
    for (const std::string& file : removal.files) std::printf("%s/%s\n", removal.session.c_str(), file.c_str());
    if (removal.rewrites_log) std::printf("%s/events.jsonl: words are taken out\n", removal.session.c_str());
  }
  if (options.dry_run) return 0;
  withdraw(options.study, options.participant, options.stream, removals, nowUnix_s());
  printMessage(removals.empty()
                   ? options.participant + ": nothing of it is here any more"
                   : options.participant +
                         ": done; copies made before (bundles, tables, backups in the open) are not reached");
  return 0;
}

std::int64_t todayOf(const OwnerOptions& options) {
  if (options.today.empty()) return nowUnix_s();
  const auto at = calibration::secondsOfUtc(options.today + "T00:00:00Z");
  if (!at) throw UsageError("--today " + options.today + ": give a day as 2027-11-29");
  return *at;
}

int retain(const OwnerOptions& options) {
  const std::int64_t now_s = todayOf(options);
  const auto expired = expiredSessions(options.study, now_s);
  for (const Expired& one : expired)
    std::printf("%s  ended %s, kept %lld days\n", one.session.c_str(), one.stopped_utc.c_str(),
                static_cast<long long>(one.days));
  if (options.dry_run) return 0;
  removeExpired(options.study, expired, now_s);
  return 0;
}

int exportBundle(const OwnerOptions& options) {
  if (!options.out.ends_with(".zip")) throw UsageError("--out " + options.out + ": name it .zip");
  const auto owner = options.key.openedFor(options.study);
  const PrivateStudyKeys* const key = owner ? &*owner : nullptr;
  const BundleExtras& wanted = options.extras;
  const bool is_wrapped = !wanted.recipients.empty();
  // What lies there in the open goes with it, however this ends.
  const StopSignals stops;
  const PrivateFolder scratch(options.out + ".", "--out " + options.out);
  // What cannot be written is told before anything is.
  std::optional<calibration::OutputFile> pdf, wrapped;
  if (!wanted.pdf.empty()) pdf.emplace(wanted.pdf, options.force);
  if (is_wrapped) wrapped.emplace(options.out + ".age", options.force);
  // In the open it lies only where nobody else looks, if it is to be encrypted.
  const std::string file = is_wrapped ? scratch.file("bundle.zip") : options.out;
  const MoreOfSession more = moreOfSession(options.study, wanted, key, scratch);
  const auto more_unless_stopped = [&](const StudySession& session, const std::vector<LogEvent>& events,
                                       std::vector<std::string>& remarks) {
    if (stops.isAsked()) throw UsageError(options.out + ": stopped, nothing was exported");
    return more(session, events, remarks);
  };
  const WrittenBundle written =
      writeBundle(options.study, options.session, key, file, options.force || is_wrapped, more_unless_stopped);
  if (pdf && !printReport(file, *pdf, scratch))
    printMessage("--pdf " + wanted.pdf + ": chromium is not installed, report.html prints from any browser");
  if (wrapped) encryptFor(wanted.recipients, file, *wrapped);
  for (const std::string& remark : written.remarks) printMessage(remark);
  audit(options.study, nowUnix_s(), "export",
        {{"sessions", joined(written.sessions)},
         {"signed", owner.has_value()},
         {"voice", wanted.voice},
         {"encrypted", is_wrapped},
         {"words", std::string(owner ? "open" : "as they stand")}});
  if (!owner) printMessage(options.out + ": not signed, and what is sealed stays closed: --key FILE does both");
  return 0;
}

int checkFile(const OwnerOptions& options) {
  std::optional<PublicStudyKeys> known;
  if (!options.study.empty()) {
    known = publicKeysOf(options.study);
    if (!known) throw UsageError("--study " + options.study + ": it has no keys, leave it out");
  }
  const BundleCheck check = checkBundle(options.file, known);
  for (const std::string& line : check.wrong) std::printf("%s\n", line.c_str());
  if (!check.wrong.empty()) return 1;
  std::printf("%zu files of %s are as they were written; %s\n", check.files, joined(check.sessions).c_str(),
              !check.signed_by ? "nobody signed them"
                               : ("signed by the study's key " + check.signed_by->fingerprint()).c_str());
  if (check.signed_by && !known) printMessage("whose key that is, --study STUDY tells");
  return 0;
}

int merge(const OwnerOptions& options) {
  mergeProblem(options.study, options.problem, options.into);
  audit(options.study, nowUnix_s(), "merge", {});
  return 0;
}

int unmerge(const OwnerOptions& options) {
  unmergeProblem(options.study, options.problem);
  audit(options.study, nowUnix_s(), "unmerge", {});
  return 0;
}

int rate(const OwnerOptions& options) {
  const auto owner = options.key.openedFor(options.study);
  const StudyResult result = studyResult(readStudyFolder(options.study, "", owner ? &*owner : nullptr).input);
  std::vector<RatedProblem> problems;
  for (const ProblemRow& row : result.problems)
    problems.push_back({row.problem, row.title, joined(row.tasks, &MetInTask::task)});
  // Not by weight, which would tell what others gave.
  std::ranges::sort(problems, {}, &RatedProblem::problem);
  if (problems.empty()) throw UsageError("study rate: " + options.study + " has no problems that can be read");
  std::printf("%s\n", writeRatingSheet(options.study, options.rater, problems).c_str());
  return 0;
}

void addStudy(CommandLine& command, OwnerOptions& options) {
  command.option("STUDY", options.study, "Folder of the study").required();
}
void addDryRun(CommandLine& command, OwnerOptions& options) {
  command.flag("--dry-run", options.dry_run, "Say what would go, remove nothing");
}

void addBundleCommands(CommandLine& study, const std::shared_ptr<OwnerOptions>& options) {
  CommandLine& bundle = study.command("export", "A study, or one session, as one ZIP file: report, tables, recordings");
  bundle.example("molar study export STUDY --out F.zip --key owner.key", "signed, with the words that the key opens");
  addStudy(bundle, *options);
  bundle.option("--out", options->out, "File to write").valueNamed("FILE.zip").required();
  bundle.option("--session", options->session, "One session alone, as P07-1").valueNamed("SESSION");
  options->key.addTo(bundle, "Private key of the study: signs the bundle, and opens words and answers for it");
  bundle.flag("--voice", options->extras.voice, "With the voice of those who allow audio and reuse");
  bundle.flag("--pictures", options->extras.pictures, "With pictures of the moments that were noted, where allowed");
  bundle.option("--pdf", options->extras.pdf, "The report as PDF too, beside the bundle, by Chromium where it is there")
      .valueNamed("FILE.pdf");
  bundle.option("--recipient", options->extras.recipients, "Encrypt for this key of age, age1…; writes FILE.zip.age")
      .repeated();
  bundle.flag("--force", options->force, "Replace a file that exists");
  bundle.footer(
      "report.html in the shape of the Common Industry Format, study.csv and study.json, each session's recording, "
      "log, "
      "template and tables; the same bytes on every machine. Sound and pictures only where they are asked for.");
  bundle.does([options] { return exportBundle(*options); });

  CommandLine& check = study.command("check", "Whether a bundle is as it was written: names each changed file");
  check.option("FILE", options->file, "Bundle of molar study export").required();
  check.option("--study", options->study, "It must be signed by this study's key").valueNamed("STUDY");
  check.does([options] { return checkFile(*options); });
}

void addProblemCommands(CommandLine& study, const std::shared_ptr<OwnerOptions>& options) {
  const auto add_problem = [&](CommandLine& command) {
    addStudy(command, *options);
    command.option("PROBLEM", options->problem, "Its short name").required();
  };
  CommandLine& merged = study.command("merge", "One problem is another: its evidence counts there");
  add_problem(merged);
  merged.option("INTO", options->into, "The problem that it is").required();
  merged.does([options] { return merge(*options); });
  CommandLine& apart = study.command("unmerge", "Undoes it");
  add_problem(apart);
  apart.does([options] { return unmerge(*options); });
  CommandLine& rated = study.command("rate", "A sheet for a second rater, without the severities of others");
  addStudy(rated, *options);
  rated.option("RATER", options->rater, "Code, as E2").required();
  options->key.addTo(rated, "Private key of the study, where words are sealed");
  rated.footer(
      "STUDY/ratings-E2.csv; until it is filled in no severity is shown, so that neither rater sees the other's.");
  rated.does([options] { return rate(*options); });
}

}  // namespace

void addStudyOwnerCommands(CommandLine& study) {
  auto options = std::make_shared<OwnerOptions>();
  CommandLine& keys = study.command("keys", "Keys of a study: what people say is sealed from then on");
  keys.example("molar study keys STUDY --key owner.key", "before the first session; then take owner.key away");
  addStudy(keys, *options);
  options->key.addTo(keys, "New file for the private key, outside of the study");
  keys.footer(
      "Words of notes, problems, answers and sound are sealed to the study's public key, which stays in STUDY; times, "
      "kinds and severities stay open. The private key is locked by the passphrase; nobody can make it again.");
  keys.does([options] { return makeKeys(*options); });

  CommandLine& withdraw = study.command("withdraw", "What a participant takes back: its key and files go");
  addStudy(withdraw, *options);
  withdraw.option("PARTICIPANT", options->participant, "Code, as P07").required();
  withdraw.option("--stream", options->stream, "What goes, in all of this participant's sessions")
      .oneOf({kWithdrawnStreams.begin(), kWithdrawnStreams.end()})
      .required();
  addDryRun(withdraw, *options);
  withdraw.footer(
      "Rows stay, without words; the recording stays whole. Where a study has no keys its logs are written anew "
      "without the words, and audit.jsonl tells both ends of their chains.");
  withdraw.does([options] { return takeBack(*options); });

  CommandLine& retain_command =
      study.command("retain", "Removes the sessions that are past the template's retention_days");
  addStudy(retain_command, *options);
  retain_command.option("--today", options->today, "Day to count from [the clock's]; also the audit's, so for trials")
      .valueNamed("DATE");
  addDryRun(retain_command, *options);
  retain_command.footer("From session.stop's time on. Refused where audit.jsonl tells of a later time than the clock.");
  retain_command.does([options] { return retain(*options); });
  addBundleCommands(study, options);
  addProblemCommands(study, options);
}

}  // namespace app
