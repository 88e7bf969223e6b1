#include "app/station/workstation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "app/session/session_error.h"
#include "app/text/version.h"
#include "calibration/record/utc.h"

namespace app {
namespace {

constexpr double kLogged_s = 10.0;  // of ticks, while their reader is held up
constexpr double kWrittenTogether_s = 0.5;

/// Of the tooth to be removed.
std::vector<std::uint8_t> voxelsOfTooth(const assets::Patient& patient) {
  return assets::voxelsOfTooth(patient.ct, patient.operatedTooth());
}

haptics::Bodies bodiesOf(const assets::Patient& patient, const haptics::Filling::Volumes* laid) {
  haptics::Bodies bodies(patient.ct.grid, patient.ct.solid, patient.ct.label, voxelsOfTooth(patient));
  bodies.leave(patient.fragments);
  if (laid != nullptr && bodies.filling() != nullptr) bodies.filling()->begin(*laid);
  return bodies;
}

std::unique_ptr<Recorder> recorderOf(const std::optional<Recording>& recording, const assets::Patient& patient,
                                     double rate_Hz, const haptics::Command& command, haptics::TickLog& log,
                                     Ticking ticking, const assets::SoftTissueField& soft_tissue,
                                     const haptics::Filling::Volumes* laid, std::string& refusal) {
  if (!recording) return nullptr;
  SessionStart start;
  start.patient_title = patient.shownTitle();
  start.program_version = std::string(programVersion());
  start.dt_s = 1.0 / rate_Hz;
  start.grid = patient.ct.grid;
  start.solid = patient.ct.solid;
  start.label = patient.ct.label;
  start.whole = recording->whole;
  start.laid = laid;
  const std::vector<std::uint8_t> is_tooth = voxelsOfTooth(patient);
  start.is_tooth = is_tooth;
  start.soft_tissue = &soft_tissue;
  start.command = command;
  start.calibration = recording->calibration;
  start.teeth = patient.ct.tooth;
  start.setup = recording->setup;
  start.setup.site = patient.site;
  start.setup.canals = patient.canals;
  start.setup.fragments = patient.fragments;
  start.setup.proposed = patient.proposed();
  start.setup.prepared = patient.prepared;
  start.setup.canal_P_mm = patient.mandibular_canal_P_mm;
  start.setup.canal_radius_mm = patient.mandibular_canal_radius_mm;
  start.started_utc = calibration::nowUtc();
  try {
    return std::make_unique<Recorder>(recording->path, recording->overwrite, start, log,
                                      ticking == Ticking::stepped ? DrainMode::by_hand : DrainMode::by_thread,
                                      recording->tap);
  } catch (const SessionError& error) {
    if (!recording->by_default) throw;
    refusal = error.what();
    return nullptr;
  }
}

std::size_t roomAt(double rate_Hz) { return static_cast<std::size_t>(std::ceil(kLogged_s * rate_Hz)); }

haptics::LoopSettings withSecondLog(haptics::LoopSettings settings, std::optional<haptics::TickLog>& log, bool wanted) {
  if (wanted) settings.second_log = &log.emplace(roomAt(settings.rate_Hz));
  return settings;
}

}  // namespace

Workstation::Workstation(const assets::Patient& patient, std::unique_ptr<haptics::HapticDevice> device,
                         const haptics::LoopSettings& settings, const haptics::Command& command,
                         const std::optional<Recording>& recording, Ticking ticking, bool keeps_ticks,
                         assets::SoftTissueField soft_tissue, const haptics::Filling::Volumes* laid)
    : device_(std::move(device)),
      bodies_(bodiesOf(patient, laid)),
      soft_tissue_(std::move(soft_tissue)),
      servo_(bodies_, &soft_tissue_),
      rate_Hz_(settings.rate_Hz),
      command_(haptics::limitedTo(device_->capabilities(), rate_Hz_, command)),
      commands_(command_),
      log_(roomAt(rate_Hz_)),
      recorder_(recorderOf(recording, patient, settings.rate_Hz, command_, log_, ticking, soft_tissue_, laid,
                           recording_refusal_)),
      pedal_(settings.pedal),
      loop_(servo_, servedAs(*device_, ticking), commands_, log_, newest_,
            withSecondLog(settings, kept_ticks_, keeps_ticks)) {}

void Workstation::start() {
  loop_.start();
  emergency_exit_.emplace(loop_);
}

RecordingSummary Workstation::stop() {
  loop_.stop();
  emergency_exit_.reset();
  if (!recording_refusal_.empty()) return {.trouble = recording_refusal_};
  return recorder_ ? recorder_->stop(&bodies_) : RecordingSummary{};
}

void Workstation::step(std::uint64_t ticks) {
  const auto together = static_cast<std::uint64_t>(kWrittenTogether_s * rate_Hz_);
  while (ticks > 0) {
    const std::uint64_t now = std::min(ticks, together - unwritten_);
    assert(!recorder_ || log_.room() >= now);
    loop_.step(now);
    ticks -= now;
    unwritten_ += now;
    if (unwritten_ >= together) write();
  }
}

void Workstation::write() {
  if (recorder_) recorder_->drain();
  unwritten_ = 0;
}

std::vector<haptics::Tick> Workstation::takeTicks() {
  std::vector<haptics::Tick> ticks;
  if (kept_ticks_) kept_ticks_->drainInto(ticks);
  return ticks;
}

std::vector<haptics::HandAction> Workstation::takeActions() {
  std::vector<haptics::HandAction> asked;
  for (std::size_t i = 0; i < haptics::kHandActions; ++i) {
    const auto action = static_cast<haptics::HandAction>(i);
    const std::uint32_t by_handle = action == haptics::HandAction::tool_change ? 0 : loop_.presses(action);
    const std::uint32_t presses = by_handle + (pedal_ != nullptr ? pedal_->presses(action) : 0);
    if (action != haptics::HandAction::drill) asked.insert(asked.end(), presses - actions_taken_[i], action);
    actions_taken_[i] = presses;
  }
  return asked;
}

void Workstation::change(haptics::Command command) {
  command.serial = command_.serial + 1;
  command_ = haptics::limitedTo(device_->capabilities(), rate_Hz_, command);
  if (recorder_) recorder_->command(command_);
  commands_.publish(command_);
}

std::optional<std::string> Workstation::recordingFile() const {
  return recorder_ ? std::optional(recorder_->firstFile()) : std::nullopt;
}

std::optional<std::string> Workstation::temporaryFile() const {
  return recorder_ ? recorder_->temporaryFile() : std::nullopt;
}

std::optional<std::string> Workstation::recordingTrouble() const {
  if (!recording_refusal_.empty()) return recording_refusal_;
  return recorder_ ? recorder_->trouble() : std::nullopt;
}

void Workstation::note(const std::string& kind, const std::string& text) {
  if (!recorder_) return;
  const haptics::Tick newest = newest_.read();
  recorder_->event(kind, text, newest.dt_s > 0.0 ? newest.index : 0);
}

}  // namespace app
