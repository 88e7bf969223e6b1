// `molar replay SESSION` and `molar metrics SESSION`: after the rehearsal.

#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/review/bite_review.h"
#include "app/review/preparation_review.h"
#include "app/review/reference_set.h"
#include "app/review/session_sound.h"
#include "app/review/treatment_text.h"
#include "app/session/measures/rests_on.h"
#include "app/session/metrics.h"
#include "app/session/moment_values.h"
#include "app/session/replay.h"
#include "app/session/session_folder.h"
#include "app/station/session_case.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "assets/scan/image_file.h"
#include "calibration/output_file.h"
#include "calibration/png_file.h"

namespace app {
namespace {

struct ReplayOptions {
  std::string session, out, labels, sound;
  std::optional<double> to_s;
  bool verify = false, digest = false, json = false, bites = false, force = false;
};

/// 0: every byte as recorded, and every bit of a re-run where this version recorded it; 1: not.
int verifySession(const std::string& path) {
  const ReplayReport report = verify(path);
  std::printf("%s\n", report.line().c_str());
  return report.verified() ? 0 : 1;
}

/// What was there at a moment, as volumes: how solid it is, with what was laid into a tooth, and of what.
int bringBack(const ReplayOptions& options) {
  // Neither is moved: made where it stays.
  const auto claimed = [&](const std::string& path) {
    return path.empty() ? nullptr
                        : std::unique_ptr<calibration::OutputFile>(
                              new calibration::OutputFile(assets::nrrdOutput(path, options.force)));
  };
  const auto out = claimed(options.out), labels = claimed(options.labels);
  const BoneAtTime bone = boneAtTime(options.session, options.to_s);
  for (const std::string& remark : bone.remarks) printMessage(remark);
  if (out) assets::writeSolid(bone.start.grid, withLaid(bone.solid, bone.laid), *out);
  if (labels) assets::writeSolid(bone.start.grid, labelsWithLaid(bone), *labels);
  std::printf("bone%s after %.3f s written\n", bone.laid ? " and filling" : "", bone.t_s);
  return 0;
}

/// "12 composite_soft, 13 composite, …".
std::string laidLabels() {
  std::string words;
  for (int label = assets::kScanTissueCount; label < assets::kTissueCount; ++label)
    words +=
        fmt::format("{}{} {}", words.empty() ? "" : ", ", label, assets::kTissues[static_cast<std::size_t>(label)].key);
  return words;
}

ReplayedState stateAt(const ReplayOptions& options) {
  SessionReader session(options.session);
  refuseDamaged(session, options.session);
  ReplayedState state = replayTo(session, options.to_s.value_or(std::numeric_limits<double>::infinity()));
  if (state.divergence)
    printMessage(fmt::format("{}: from tick {} on {}, what is told is as re-run", options.session,
                             state.divergence->tick, state.divergence->what));
  return state;
}

/// The digest of jaw, pieces and poses at a moment (haptics::Bodies::digest), re-run from the start.
void printDigest(const ReplayOptions& options) {
  std::printf("%016llx\n", static_cast<unsigned long long>(stateAt(options).bodies.digest()));
}

/// Force and removed volume of a moment, to the last bit.
int printMoment(const ReplayOptions& options) {
  std::printf("%s\n", momentJson(valuesOf(stateAt(options).tick)).c_str());
  return 0;
}

/// Of a tooth preparation: 0, every bite on articulating paper marks the re-run tooth as it was recorded; 1: not.
int biteAgain(const std::string& path) {
  int status = 0;
  for (const BiteAgain& one : bitesAgain(path)) {
    const bool same = one.again == one.recorded;
    if (!same) status = 1;
    std::printf("%.3f s %s: %s\n", one.recorded.t_s, same ? "the same" : "another mark",
                biteInWords(one.again).c_str());
  }
  return status;
}

/// What was heard.
int writeSound(const ReplayOptions& options) {
  if (!options.sound.ends_with(".flac")) throw UsageError("--sound-file " + options.sound + ": name it .flac");
  calibration::OutputFile out(options.sound, options.force);
  const double length_s = writeSessionSound(options.session, out.temporaryPath());
  out.commit();
  std::printf("sound of %.3f s written\n", length_s);
  return 0;
}

}  // namespace

void addReplay(CommandLine& molar) {
  auto options = std::make_shared<ReplayOptions>();
  CommandLine& command = molar.command("replay", "Run a recorded session again");
  command.option("SESSION", options->session, kSessionHelp).required();
  Option check = command.flag("--verify", options->verify, "Compare every force and the bone, bit for bit (default)");
  Option to = command.option("--to", options->to_s, "Stop at this time, s");
  to.from(0.0, 1e9);
  Option out = command.option("--volume", options->out,
                              "Write how solid each voxel then was, .nrrd, 0 to 255; what was laid into a tooth is "
                              "solid as the tooth is (--to before it: the tooth alone)");
  out.excludes(check);
  Option labels = command.option("--labels", options->labels,
                                 "Write the tissue of each voxel as it then was, .nrrd: the scan's, and of a filling, "
                                 "where it is the larger part, its own: " +
                                     laidLabels());
  labels.excludes(check);
  command.option("--out", options->out, "Former name of --volume").hidden().excludes(check);
  Option digest =
      command.flag("--digest", options->digest, "Print the digest of jaw, pieces and poses as they then were");
  digest.excludes(check);
  command.flag("--json", options->json, "Print force and removed volume of that moment, to the last bit")
      .needs(to)
      .excludes(check)
      .excludes(out)
      .excludes(labels)
      .excludes(digest);
  Option sound = command.option("--sound-file", options->sound, "Write what was heard, .flac, in step with the ticks");
  sound.excludes(check).excludes(out).excludes(labels).excludes(to).excludes(digest);
  command
      .flag("--bites", options->bites, "Of a preparation: bite on the paper again at the times recorded, and compare")
      .excludes(check)
      .excludes(out)
      .excludes(labels)
      .excludes(to)
      .excludes(digest)
      .excludes(sound);
  command.flag("--force", options->force, "Replace the output if it exists");
  command.does([options] {
    options->session = sessionNamed(options->session);
    if (options->bites) return biteAgain(options->session);
    if (!options->sound.empty()) return writeSound(*options);
    if (options->json) return printMoment(*options);
    const bool writes = !options->out.empty() || !options->labels.empty();
    if (options->to_s && !writes && !options->digest)
      throw UsageError("--to: of what, give --volume FILE.nrrd, --labels FILE.nrrd, --digest or --json");
    if (!writes && !options->digest) return verifySession(options->session);
    if (options->digest) printDigest(*options);
    return writes ? bringBack(*options) : 0;
  });
}

/// Throws UsageError: no single tooth in it.
static void drawOutcome(const std::string& session, const std::optional<TreatmentOfSession>& treated,
                        const std::optional<PreparationOfSession>& prepared, calibration::OutputFile& out) {
  if (!treated && !prepared)
    throw UsageError("--sections: " + session +
                     " is no finished root-canal treatment nor preparation of a tooth, leave it out");
  const render::Image picture = treated ? treatmentSections(*treated) : prepared->picture;
  calibration::writePng(out.temporaryPath(), {picture.w, picture.h}, picture.rgba);
  out.commit();
}

void addMetrics(CommandLine& molar) {
  auto session = std::make_shared<std::string>();
  auto as_json = std::make_shared<bool>(false);
  CommandLine& command = molar.command("metrics", "Measures of a recorded session, as text or JSON");
  command.option("SESSION", *session, kSessionHelp).required();
  auto reference = std::make_shared<std::string>();
  command.flag("--json", *as_json, "All measures as JSON");
  command.option("--reference", *reference, kReferenceHelp).valueNamed("SET");
  auto sections = std::make_shared<std::string>();
  auto force = std::make_shared<bool>(false);
  command
      .option(
          "--sections", *sections,
          "Of root canals: a picture of their sections at 1, 3, 5 and 7 mm, before and after; of a preparation: its "
          "deviation from the ideal, and sections")
      .valueNamed("FILE.png");
  command.flag("--force", *force, "Replace the picture if it exists");
  command.footer(measuresHelp() +
                 "\"confirmed\": false marks what rests on a tooth or canal that was found in a scan and nobody had "
                 "confirmed; \"not_confirmed\" names which, and the keys of this object that rest on it.\n");
  command.does([session, as_json, reference, sections, force] {
    std::optional<ReferenceSet> set;
    if (!reference->empty()) set = loadReference(*reference);
    std::optional<calibration::OutputFile> picture;
    if (!sections->empty()) picture.emplace(*sections, *force);
    const std::optional<TreatmentOfSession> treated = treatmentOfSession(sessionNamed(*session));
    const std::optional<PreparationOfSession> prepared = preparationOfSession(sessionNamed(*session));
    if (picture) drawOutcome(*session, treated, prepared, *picture);
    SessionMetrics metrics = metricsOf(sessionNamed(*session), caseOfSession);
    if (set) {
      tellAgainst(metrics, *set);
      std::fputs((*as_json ? scoresJson(metrics, *set) : scoresText(metrics, *set)).c_str(), stdout);
      return 0;
    }
    std::string text = *as_json ? metricsJson(metrics) + "\n" : metricsText(metrics);
    if (treated && *as_json) {
      nlohmann::ordered_json json = nlohmann::ordered_json::parse(text);
      json["root_canals"] = nlohmann::ordered_json::parse(treatmentJson(*treated));
      if (!isConfirmed("root_canals", metrics.proposed)) json["not_confirmed"]["keys"].push_back("root_canals");
      text = json.dump(2) + "\n";
    } else if (prepared && *as_json) {
      nlohmann::ordered_json json = nlohmann::ordered_json::parse(text);
      json["preparation"] = nlohmann::ordered_json::parse(preparationJson(*prepared));
      text = json.dump(2) + "\n";
    } else if (treated) {
      if (!isConfirmed("root_canals", metrics.proposed)) text += "of the root canals (not confirmed):\n";
      text += treatmentTable(*treated);
    } else if (prepared) {
      text += preparationTable(*prepared);
    }
    std::fputs(text.c_str(), stdout);
    return 0;
  });
}

}  // namespace app
