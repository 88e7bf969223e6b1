#include "app/commands/bundle_extras.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "app/commands/outside_program.h"
#include "app/debrief/debrief_scene.h"
#include "app/debrief/log_bookmarks.h"
#include "app/evaluation/voice/speech_detector.h"
#include "app/evaluation/voice/voice_track.h"
#include "app/session/session_reader.h"
#include "app/sound/sound_file.h"
#include "app/study/bundle/zip_file.h"
#include "app/study/csv.h"
#include "app/study/privacy/session_seal.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"
#include "calibration/output_file.h"
#include "calibration/png_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

/// False: there is no such program. Throws UsageError with `why_not` where it does not end well.
bool runs(const std::vector<std::string>& words, const std::string& why_not) {
  constexpr std::chrono::minutes kLimit{10};
  const OutsideEnd end = runToEnd({.words = words, .is_silent = true, .limit = kLimit});
  if (end.kind == OutsideEnd::Kind::not_started && end.status == ENOENT) return false;
  if (end.kind == OutsideEnd::Kind::stopped) throw UsageError("study export: stopped while " + words.front() + " ran");
  if (end.kind != OutsideEnd::Kind::ended || end.status != 0) throw UsageError(why_not);
  return true;
}

/// The newest word on it is yes.
bool isAllowed(const std::vector<LogEvent>& events, std::string_view stream) {
  bool is_given = false;
  for (const LogEvent& event : events)
    if (event.type == "consent" && event.textOr("stream") == stream) is_given = event.flag("given").value_or(false);
  return is_given;
}

double tickOf_s(const std::string& recording) { return SessionReader(recording).start().dt_s; }

/// voice.flac begins with the log's first event, and is silent where nothing was recorded; voice.csv: which sample is
/// heard when, as the card's clock drifts.
std::vector<ZipEntry> voiceOf(const fs::path& folder, const std::vector<LogEvent>& events,
                              const PrivateStudyKeys* owner, const std::string& flac, std::string& trouble) {
  SegmentOpener opener;
  if (owner != nullptr) {
    const auto session = std::make_shared<OpenedSession>(*owner, folder.string(), folder.filename().string());
    opener = [session](std::uint64_t number, std::string_view sealed) {
      return session->open(SealedStream::audio, kVoiceTable, number, sealed);
    };
  }
  const bool is_sealed = fs::exists(folder / "keys");
  if (is_sealed && owner == nullptr) {
    trouble = "its voice is sealed, --key opens it";
    return {};
  }
  auto track = VoiceTrack::of(folder.string(), 1.0 / tickOf_s((folder / "session.molar").string()), opener);
  if (!track || track->frames() == 0) {
    trouble = "no voice was recorded";
    return {};
  }
  constexpr std::int64_t kStep_ns = 10'000'000'000;
  constexpr double kSecond_ns = 1e9;
  const std::int64_t begun_ns = events.front().t_ns, first = track->frameAt(begun_ns);
  std::string clock = csvLine({"time_s", "sample"});
  for (std::int64_t t_ns = begun_ns; track->frameAt(t_ns) < track->frames(); t_ns += kStep_ns)
    clock += csvLine({assets::exactText(static_cast<double>(t_ns - begun_ns) / kSecond_ns),
                      std::to_string(track->frameAt(t_ns) - first)});
  SoundFile file(flac, kVoiceRate_Hz);
  std::vector<float> samples;
  for (std::int64_t at = first; at < track->frames(); at += static_cast<std::int64_t>(samples.size())) {
    samples.resize(static_cast<std::size_t>(std::min<std::int64_t>(kVoiceRate_Hz, track->frames() - at)));
    track->read(at, samples);
    file.write(samples);
  }
  file.close();
  return {{"voice.flac", "", flac}, {"voice.csv", clock, ""}};
}

/// As the surgeon had them before him, drawn by the processor: the same bytes on every machine.
std::vector<ZipEntry> picturesOf(const std::string& recording, const std::vector<LogEvent>& events,
                                 const std::function<std::string(const std::string&)>& place, std::string& trouble) {
  constexpr std::size_t kMostPictures = 60;
  constexpr glm::ivec2 kPicture_px{960, 540};
  const std::vector<Bookmark> moments = logBookmarks(events, tickOf_s(recording), false);
  if (moments.empty()) {
    trouble = "no moment was noted";
    return {};
  }
  DebriefPlan plan;
  plan.sessions = {recording};
  plan.size_px = kPicture_px;
  DebriefScene scene(plan);
  double last_s = 0.0;
  for (const Bookmark& one : moments) last_s = std::max(last_s, one.t_s);
  scene.prepareTo(last_s);
  render::RenderOptions options;
  options.backend = render::Backend::cpu;
  scene.open(options);
  std::vector<ZipEntry> entries;
  for (std::size_t n = 0; n < moments.size() && n < kMostPictures; ++n) {
    scene.goTo(moments[n].t_s);
    scene.draw(kPicture_px, {});
    const render::Image image = scene.image();
    const std::string name = fmt::format("pictures/{:02}-{}-{:.3f}s.png", n + 1, moments[n].note, moments[n].t_s);
    const std::string file = place(fmt::format("{:02}.png", n + 1));
    calibration::writePng(file, {image.w, image.h}, image.rgba);
    entries.push_back({name, "", file});
  }
  if (moments.size() > kMostPictures)
    trouble = fmt::format("of {} moments the first {}", moments.size(), kMostPictures);
  return entries;
}

}  // namespace

MoreOfSession moreOfSession(const std::string& study, const BundleExtras& wanted, const PrivateStudyKeys* owner,
                            const PrivateFolder& scratch) {
  return [&study, &wanted, owner, &scratch](const StudySession& session, const std::vector<LogEvent>& events,
                                            std::vector<std::string>& remarks) {
    const fs::path folder = fs::path(study) / session.folder;
    const auto place = [&](const std::string& name) { return scratch.file(session.folder + "-" + name); };
    std::vector<ZipEntry> all;
    const auto add = [&](const char* what, std::vector<ZipEntry> entries, const std::string& trouble) {
      if (!trouble.empty()) remarks.push_back(session.folder + ": " + what + ": " + trouble);
      std::ranges::move(entries, std::back_inserter(all));
    };
    std::string trouble;
    if (wanted.voice) {
      const bool may = isAllowed(events, "audio") && isAllowed(events, "reuse");
      if (!may) trouble = "left out, audio and reuse are not both allowed";
      auto entries = may ? voiceOf(folder, events, owner, place("voice.flac"), trouble) : std::vector<ZipEntry>();
      add("voice", std::move(entries), trouble);
    }
    trouble.clear();
    if (wanted.pictures) {
      const bool may = isAllowed(events, "picture");
      if (!may) trouble = "left out, they are not allowed";
      const std::string recording = (folder / "session.molar").string();
      add("pictures", may ? picturesOf(recording, events, place, trouble) : std::vector<ZipEntry>(), trouble);
    }
    return all;
  };
}

bool printReport(const std::string& bundle, calibration::OutputFile& pdf, const PrivateFolder& scratch) {
  constexpr std::uint64_t kMostReport = 64U << 20U;
  const std::string html = scratch.file("report.html"), printed = scratch.file("report.pdf");
  calibration::OutputFile(html, true).commit(*ZipReader(bundle).text("report.html", kMostReport));
  std::vector<std::string> words{"chromium",
                                 "--headless",
                                 "--disable-gpu",
                                 "--no-pdf-header-footer",
                                 "--user-data-dir=" + scratch.file("chromium"),
                                 "--print-to-pdf=" + printed,
                                 "file://" + html};
  // It refuses to run as root in its sandbox; the page is our own and asks for nothing.
  if (::geteuid() == 0) words.insert(words.begin() + 1, "--no-sandbox");
  const std::string why_not = "--pdf " + pdf.path() + ": chromium could not print the report; see that it runs";
  if (!runs(words, why_not)) return false;
  if (!fs::exists(printed)) throw UsageError(why_not);
  pdf.commit(assets::readSmallFile(printed, kMostReport));
  return true;
}

void encryptFor(const std::vector<std::string>& recipients, const std::string& bundle, calibration::OutputFile& to) {
  std::vector<std::string> words{"age", "--encrypt"};
  for (const std::string& one : recipients) words.insert(words.end(), {"--recipient", one});
  words.insert(words.end(), {"--output", to.temporaryPath(), bundle});
  if (!runs(words, "--recipient " + recipients.front() + ": age refuses it, give a key as age1…"))
    throw UsageError("--recipient: age is not installed, apt-get install age");
  to.commit();
}

}  // namespace app
