#include "app/station/rig_choice.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/core.h>

#include "app/device/practice_device.h"
#include "app/text/command_line.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "calibration/record/drift_review.h"
#include "calibration/record/rig_file.h"
#include "calibration/record/rig_store.h"
#include "calibration/rig.h"

namespace app {
namespace {

using calibration::RigLocation;
using calibration::RigRecord;
using calibration::RigStore;
using calibration::Verdict;
using Kind = DeviceIdentity::Kind;

constexpr std::string_view kCurrent = "current";
constexpr std::size_t kMaxReasonLength = 120;

/// "current" as "", "current:rig-02" as "rig-02"; none for anything else.
std::optional<std::string> currentAsked(const std::string& rig) {
  if (rig == kCurrent) return "";
  if (rig.starts_with(std::string(kCurrent) + ":")) return rig.substr(kCurrent.size() + 1);
  return std::nullopt;
}

std::string nameOf(const DeviceIdentity& device) {
  return device.model + (device.serial.empty() ? "" : " " + device.serial);
}

std::string nameOf(const RigLocation& location) {
  return location.rig_id + " " + location.serial + " " + location.mount;
}

std::string ofTouches(const calibration::RigVerification& verification) {
  return fmt::format("{:.2f} mm RMS of {}", verification.errors.rms_mm, verification.errors.n);
}

}  // namespace

DeviceIdentity deviceIdentity(const std::string& address, const haptics::DeviceCapabilities* real) {
  if (const auto practice = practiceRig(address))
    return {Kind::practice, address, practice->nominal.device->model, practice->nominal.device->serial};
  if (real == nullptr) return {Kind::without_hardware, address, "", ""};
  return {Kind::real, address, real->arm_model.empty() ? real->model : real->arm_model, real->serial};
}

Option RigOption::addTo(CommandLine& command, bool for_device) {
  Option rig = command
                   .option("--rig", rig_,
                           for_device ? "Rig, 1:1: a file; current[:RIG], the calibration in force of this device; "
                                        "mirrored or desktop, not measured [the only current one of a real device]"
                                      : "Rig: a file; current[:RIG], the calibration in force; mirrored or desktop")
                   .valueNamed("RIG");
  command.option("--rig-store", store_, "Where calibrations are kept [$MOLAR_CALIBRATION, else the data folder]")
      .valueNamed("DIR");
  if (!for_device) return rig;
  command.option("--mount", mount_, "On which side of the surgeon the device stands [as the rig has it]")
      .oneOf({"left", "right"});
  command.option("--despite-calibration", despite_, "Work with a calibration that is red; why, kept in the session")
      .valueNamed("WORD");
  return rig;
}

bool RigOption::isName() const { return isGiven() && (currentAsked(rig_) || calibration::defaultRig(rig_)); }

void RigOption::refuseUnlessReadable() const {
  if (isGiven() && !isName()) calibration::readRigRecord(rig_);
}

std::optional<RigRecord> RigOption::currentFor(const DeviceIdentity& device, const std::string& rig_id) const {
  const bool is_asked = isGiven();
  const std::filesystem::path root = store_.empty() ? RigStore::usualRoot() : std::filesystem::path(store_);
  const RigStore store(root);
  std::vector<RigLocation> suiting;
  for (const RigLocation& location : store.locations()) {
    const bool its_serial = !device.isCalibrated() || location.serial == device.serial;
    const bool its_rig = rig_id.empty() || location.rig_id == rig_id,
               its_mount = mount_.empty() || location.mount == mount_;
    if (its_serial && its_rig && its_mount && store.currentName(location)) suiting.push_back(location);
  }
  const std::string whose = device.isCalibrated() ? " of " + nameOf(device) : "";
  if (suiting.empty()) {
    if (!is_asked) return std::nullopt;
    throw UsageError("--rig " + rig_ + ": " + root.string() + " holds no calibration in force" + whose +
                     ", calibrate first, name a rig file, or give --rig-store");
  }
  if (suiting.size() > 1) {
    if (!is_asked) return std::nullopt;
    throw UsageError("--rig " + rig_ + ": several calibrations are in force" + whose + " (" +
                     joined(suiting, [](const RigLocation& location) { return nameOf(location); }) +
                     "), say which with --rig current:RIG and --mount");
  }
  auto record = store.current(suiting.front());
  if (!record && is_asked)
    throw UsageError("--rig " + rig_ + ": " + nameOf(suiting.front()) +
                     " is no longer in force, somebody changes the calibrations now, start again");
  if (!record) return std::nullopt;
  return withLaterCheck(*std::move(record), calibration::readHistory(store.historyPath(suiting.front())));
}

std::optional<ChosenRig> RigOption::choose(const DeviceIdentity& device, const std::string& now_utc) const {
  ChosenRig chosen;
  const auto current = isGiven() ? currentAsked(rig_) : std::string();
  const bool looks_in_store = isGiven() ? current.has_value() : device.isCalibrated();
  if (looks_in_store) {
    auto record = currentFor(device, *current);
    if (!record) return std::nullopt;
    chosen.record = std::move(*record);
    chosen.source = "current rig " + chosen.record.provenance.rig_id;
  } else if (!isGiven()) {
    return std::nullopt;
  } else if (const auto rig = calibration::defaultRig(rig_)) {
    chosen.record.rig = *rig;
    chosen.source = "default rig " + rig_;
  } else {
    chosen.record = calibration::readRigRecord(rig_);
    chosen.source = "rig file " + rig_;
  }
  check(chosen, device, now_utc);
  return chosen;
}

void RigOption::check(ChosenRig& chosen, const DeviceIdentity& device, const std::string& now_utc) const {
  const bool is_default = isGiven() && calibration::defaultRig(rig_).has_value();
  RigRecord& record = chosen.record;
  SessionCalibration& kept = chosen.calibration;
  kept.rig = is_default ? "default" : record.hash.empty() ? "unsealed" : record.hash;
  kept.rig_id = record.provenance.rig_id;
  kept.device_serial = device.serial;
  kept.age_days = calibration::age_days(record, now_utc);
  if (record.verification) {
    const calibration::TargetErrors& errors = record.verification->errors;
    kept.verdict = calibration::nameOf(record.verification->verdict);
    kept.touches = errors.n;
    kept.rms_mm = errors.rms_mm, kept.p95_mm = errors.p95_mm, kept.max_mm = errors.max_mm;
    kept.checked_utc = record.verification->checked_utc;
  }
  const auto remark = [&](const std::string& line) { chosen.remarks.push_back(chosen.source + ": " + line); };
  if (kept.age_days && *kept.age_days > calibration::kOldRig_days)
    remark(fmt::format("it was measured {:.0f} days ago, more than {:.0f}: calibrate again", *kept.age_days,
                       calibration::kOldRig_days));

  // An arm belongs to one device; eyes, screen and patient apply to any.
  if (!device.isCalibrated()) {
    if (record.rig.arm) remark("its arm is ignored, this device has none");
    record.rig.arm.reset();
    return;
  }
  const std::string why_not = calibration::mismatchWith(record, device.model, device.serial, mount_);
  if (!why_not.empty())
    throw UsageError("--rig, " + chosen.source + ": " + why_not +
                     ": choose the rig of this device or calibrate it (molar calibrate)");
  if (!record.verification) {
    remark(is_default || !record.rig.arm
               ? "it was not measured with this device: hand and eye may be a centimetre apart, see molar calibrate"
               : "nobody has verified it: molar calibrate verify");
    return;
  }
  const Verdict verdict = record.verification->verdict;
  if (verdict == Verdict::amber)
    remark("its calibration is amber, " + ofTouches(*record.verification) + ": usable, not good");
  if (verdict != Verdict::red) return;
  const bool is_word = std::ranges::any_of(despite_, [](unsigned char c) { return std::isgraph(c) != 0; }) &&
                       std::ranges::none_of(despite_, [](unsigned char c) { return std::iscntrl(c) != 0; });
  if (!is_word)
    throw UsageError(
        "--device " + device.address + ": " + chosen.source + " is red, " + ofTouches(*record.verification) +
        ": calibrate again (molar calibrate) or say with --despite-calibration \"WORD\" why it is used all the same");
  if (despite_.size() > kMaxReasonLength)
    throw UsageError("--despite-calibration: the word is too long, 120 bytes at most");
  kept.despite = despite_;
  remark("its calibration is red, " + ofTouches(*record.verification) + ", used despite that: " + despite_);
}

}  // namespace app
