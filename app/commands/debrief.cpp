// `molar debrief SESSION [SESSION]`: a recorded rehearsal played, looked at from any side, and exported.

#include <filesystem>
#include <memory>
#include <optional>

#include "app/commands/command.h"
#include "app/commands/study_key.h"
#include "app/debrief/debrief_keys.h"
#include "app/debrief/debrief_plan.h"
#include "app/debrief/log_bookmarks.h"
#include "app/options/picture_option.h"
#include "app/options/settings_text.h"
#include "app/options/view_option.h"
#include "app/session/session_folder.h"
#include "app/session/session_reader.h"
#include "app/station/patient_list.h"
#include "app/study/privacy/session_seal.h"
#include "app/study/sealed_events.h"
#include "app/study/session_log.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr double kLongest_s = 1e6;

struct DebriefOptions {
  DebriefPlan plan;
  DebriefExport wanted;
  PictureOption picture;
  std::string first, second, patient, size, trail = "none", display = "mono";
  bool headless = false, no_line = false;
  StudyKeyOption key;
};

/// What people said in a sealed session, where the study's key is given; else a line that says it is sealed.
void openWhatWasSaid(DebriefPlan& plan, const StudyKeyOption& option) {
  namespace fs = std::filesystem;
  const fs::path session = fs::absolute(plan.sessions.front()).parent_path();
  std::error_code failed;
  const bool is_sealed = fs::is_directory(session / "keys", failed);
  if (!is_sealed) {
    if (!option.key.empty()) throw UsageError("--key " + option.key + ": " + plan.sessions.front() + " is not sealed");
    return;
  }
  const auto owner = option.openedFor(session.parent_path().string());
  if (!owner) {
    printMessage(plan.sessions.front() + ": voice and words are sealed, --key with the study's key opens them");
    return;
  }
  const std::string name = session.filename().string();
  auto opened = std::make_shared<OpenedSession>(*owner, session.string(), name);
  for (const SealedStream stream : {SealedStream::audio, SealedStream::words})
    if (!opened->holds(stream))
      printMessage(name + ": " + std::string(kSealedStreams[static_cast<std::size_t>(stream)]) +
                   " was withdrawn, nobody can open it any more");
  plan.voice_opener = [opened](std::uint64_t number, std::string_view sealed) {
    return opened->open(SealedStream::audio, kVoiceTable, number, sealed);
  };
  const std::string log = (session / kSessionLogName).string();
  plan.unsealed = logBookmarks(openedEvents(readSessionLog(log).events, opened.get(), log).events,
                               SessionReader(plan.sessions.front()).start().dt_s, true);
}

int debrief(DebriefOptions options) {
  DebriefPlan& plan = options.plan;
  const bool exports = !options.wanted.snapshot.empty() || !options.wanted.clip.empty();
  if (exports && !options.headless) throw UsageError("--snapshot, --clip: they need no window, add --headless");
  if (options.headless && !exports) throw UsageError("--headless: nothing is asked for, add --snapshot or --clip");
  if (!options.wanted.clip.empty() && !(options.wanted.to_s > options.wanted.from_s))
    throw UsageError("--clip: say which part, --from and a later --to in s");
  plan.sessions.push_back(sessionNamed(options.first));
  if (!options.second.empty()) plan.sessions.push_back(sessionNamed(options.second));
  if (!options.patient.empty()) plan.patient = patientNamed(options.patient);
  if (!options.size.empty()) plan.size_px = imageSize(options.size);
  render::Frame frame;
  options.picture.apply(frame);
  plan.backend = options.picture.backend();
  plan.choice.mode = frame.mode;
  plan.choice.layers = frame.layers;
  plan.choice.trail = options.trail == "force"       ? TrailColour::force
                      : options.trail == "clearance" ? TrailColour::clearance
                                                     : TrailColour::none;
  plan.choice.display = render::displayModeNamed(options.display).value_or(render::DisplayMode::mono);
  plan.choice.has_line = !options.no_line;
  openWhatWasSaid(plan, options.key);
  return options.headless ? exportDebrief(plan, options.wanted) : showDebrief(plan);
}

}  // namespace

void addDebrief(CommandLine& molar) {
  auto options = std::make_shared<DebriefOptions>();
  CommandLine& command = molar.command("debrief", "Play a recorded session, look at it from any side, set bookmarks");
  command.option("SESSION", options->first, kSessionHelp).required();
  command.option("SECOND", options->second, "Another of the same case, beside it and in step");
  command.option("--at", options->plan.at_s, "Begin at this time, s").from(0.0, kLongest_s);
  command.option("--patient", options->patient, "Of an imported patient: its folder, for face and gum");
  command.option("--size", options->size, "Of the window or the pictures, px").valueNamed("WxH");
  command.option("--loupes", options->plan.loupes, "Magnification").from(1.0, 16.0).showsDefault();
  command.option("--trail", options->trail, "Way of the tool in the last 3 s, coloured")
      .oneOf({"none", "force", "clearance"});
  // Those that fill a part of a window like any other.
  command.option("--display", options->display, "In stereo, within the picture")
      .oneOf({"mono", "side-by-side", "top-bottom", "anaglyph", "anaglyph-red-cyan"});
  command.flag("--edges", options->plan.choice.edges, "Sharp edges of bone marked, once a piece of the tooth is out");
  command.flag("--no-line", options->no_line, "Without the line of text in the picture");
  options->key.addTo(command, "The study's private key: opens voice and words of a sealed session");
  options->picture.addTo(command);
  command.optionGroup("Without a window");
  Option headless = command.flag("--headless", options->headless, "Write pictures, open no window");
  command.option("--snapshot", options->wanted.snapshot, "Picture at --at, .png").valueNamed("FILE").needs(headless);
  Option clip = command.option("--clip", options->wanted.clip, "Pictures of a part, frame_00000.png and on");
  clip.valueNamed("FOLDER").needs(headless);
  command.option("--from", options->wanted.from_s, "Start of the part, s").from(0.0, kLongest_s).needs(clip);
  command.option("--to", options->wanted.to_s, "End of the part, s").from(0.0, kLongest_s).needs(clip);
  command.option("--rate", options->wanted.frames_per_s, "Pictures a second")
      .from(0.1, 100.0)
      .showsDefault()
      .needs(clip);
  command.flag("--force", options->wanted.overwrite, "Replace the output if it exists");
  command.example("molar debrief last", "the newest session");
  command.example("molar debrief last --headless --clip FOLDER --from 10 --to 20",
                  "as a film: ffmpeg -framerate 25 -i FOLDER/frame_%05d.png film.webm");
  command.footer(debriefKeyHelp());
  command.does([options] { return debrief(*options); });
}

}  // namespace app
