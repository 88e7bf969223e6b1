#include "calibration/record/rig_store.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <tuple>

#include "calibration/output_file.h"
#include "calibration/record/record_folder.h"
#include "calibration/record/rig_file.h"
#include "calibration/record/sha256.h"
#include "calibration/record/utc.h"

namespace calibration {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".yaml";
constexpr const char* kTouchesEnding = ".touches.yaml";
constexpr const char* kUnknownSerial = "unknown";
constexpr std::size_t kLongestName = 64;
constexpr int kMaxInASecond = 99;

bool isPlain(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '-' || c == '_';
}

/// No path separators, nothing hidden.
bool isPlainName(const std::string& name) {
  return !name.empty() && name.size() <= kLongestName && name[0] != '.' && std::ranges::all_of(name, isPlain);
}

/// For a message of one line.
std::string shown(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  return "'" + text + "'";
}

const std::string& checkedName(const std::string& name, const char* what) {
  if (!isPlainName(name))
    throw CalibrationError(std::string("rig store: ") + what + " " + shown(name) +
                           " is not a valid name, use up to 64 letters, digits, dot, - and _");
  return name;
}

/// Folder name of a serial. Devices report arbitrary serials; different ones get different names.
std::string serialFolder(const std::string& serial) {
  if (serial.empty()) return kUnknownSerial;
  if (isPlainName(serial)) return serial;
  std::string plain = serial.substr(0, kLongestName - 10);
  for (char& c : plain)
    if (!isPlain(c) || c == '.') c = '_';
  return plain + "-" + sha256Of(serial).substr(0, 8);
}

/// "2026-11-21T08-20-00Z.yaml", "2026-11-21T08-20-00Z-02.yaml" for a second one in the same second.
struct FileName {
  std::int64_t seconds = 0;
  int number = 1;

  std::string stem() const {
    std::string text = utcOf(seconds);
    text[13] = text[16] = '-';
    if (number > 1) text += std::string(number < 10 ? "-0" : "-") + std::to_string(number);
    return text;
  }
  auto order() const { return std::tuple(seconds, number); }
};

std::optional<FileName> fileNameIn(const std::string& text) {
  constexpr std::size_t kTimeLength = 20;
  if (text.size() < kTimeLength || text[13] != '-' || text[16] != '-') return std::nullopt;
  std::string time = text.substr(0, kTimeLength);
  time[13] = time[16] = ':';
  const auto seconds = secondsOfUtc(time);
  if (!seconds) return std::nullopt;
  // Accept canonical names only.
  for (int number = 1; number <= kMaxInASecond; ++number)
    if (const FileName name{*seconds, number}; name.stem() + kEnding == text) return name;
  return std::nullopt;
}

const std::string& checkedFileName(const std::string& name) {
  if (!fileNameIn(name))
    throw CalibrationError("rig store: " + shown(name) + " is not a rig of the store, give a name like " +
                           FileName{1795249200, 1}.stem() + kEnding);
  return name;
}

/// Empty: it belongs to this location.
std::string whyNotOf(const RigRecord& record, const RigLocation& location) {
  if (!record.rig.device) return "it was measured with no device";
  if (record.rig.device->serial != location.serial)
    return "it was measured with serial " + shown(record.rig.device->serial) + ", not " + shown(location.serial);
  if (record.rig.device->mount != location.mount)
    return "it was measured at mount " + shown(record.rig.device->mount) + ", not " + shown(location.mount);
  if (!record.provenance.rig_id.empty() && record.provenance.rig_id != location.rig_id)
    return "it was measured at rig " + shown(record.provenance.rig_id) + ", not " + shown(location.rig_id);
  return "";
}

std::optional<RigRecord> readable(const fs::path& path) {
  try {
    return readRigRecord(path.string());
  } catch (const CalibrationError&) {
    return std::nullopt;
  }
}

std::vector<fs::path> foldersIn(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_directory(error) && isPlainName(entry.path().filename().string())) found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

const char* environment(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr && value[0] != '\0' ? value : nullptr;
}

}  // namespace

fs::path RigStore::usualRoot() {
  if (const char* const chosen = environment("MOLAR_CALIBRATION")) return chosen;
  // Relative paths are ignored (XDG Base Directory Specification).
  if (const char* const data = environment("XDG_DATA_HOME"); data != nullptr && data[0] == '/')
    return fs::path(data) / "molar" / "calibration";
  if (const char* const own = environment("HOME")) return fs::path(own) / ".local" / "share" / "molar" / "calibration";
  throw CalibrationError("rig store: no folder for calibrations is known, set MOLAR_CALIBRATION to a folder");
}

fs::path RigStore::folderOf(const RigLocation& location) const {
  return root_ / checkedName(location.rig_id, "rig") / serialFolder(location.serial) /
         checkedName(location.mount, "mount");
}

std::vector<RigLocation> RigStore::locations() const {
  std::vector<RigLocation> found;
  for (const fs::path& rig : foldersIn(root_))
    for (const fs::path& serial : foldersIn(rig))
      for (const fs::path& mount : foldersIn(serial)) {
        RigLocation location{rig.filename().string(), serial.filename().string(), mount.filename().string()};
        if (location.serial == kUnknownSerial) location.serial.clear();
        const std::vector<std::string> files = names(location);
        if (files.empty()) continue;
        // The folder name may not hold the serial; the file does.
        if (const auto record = readable(mount / files.back()); record && record->rig.device)
          location.serial = record->rig.device->serial;
        found.push_back(location);
      }
  return found;
}

std::vector<std::string> RigStore::names(const RigLocation& location) const {
  std::vector<FileName> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folderOf(location), error))
    if (const auto name = fileNameIn(entry.path().filename().string()); name && entry.is_regular_file(error))
      found.push_back(*name);
  std::ranges::sort(found, {}, &FileName::order);
  std::vector<std::string> texts;
  for (const FileName& name : found) texts.push_back(name.stem() + kEnding);
  return texts;
}

fs::path RigStore::pathOf(const RigLocation& location, const std::string& name) const {
  return folderOf(location) / checkedFileName(name);
}

fs::path RigStore::historyPath(const RigLocation& location) const { return folderOf(location) / "history.csv"; }

std::optional<std::string> RigStore::currentName(const RigLocation& location) const {
  const fs::path path = folderOf(location) / "current";
  std::ifstream in(path);
  if (!in) return std::nullopt;
  std::string name;
  std::getline(in, name);
  if (!fileNameIn(name))
    throw CalibrationError("rig store: " + path.string() + " names no rig, roll back or calibrate again");
  return name;
}

std::optional<RigRecord> RigStore::current(const RigLocation& location) const {
  const auto name = currentName(location);
  if (!name) return std::nullopt;
  const fs::path path = pathOf(location, *name);
  RigRecord record = readRigRecord(path.string());
  if (const std::string why = whyNotOf(record, location); !why.empty())
    throw CalibrationError("rig file " + path.string() + ": " + why + ", calibrate this device");
  return record;
}

fs::path RigStore::keep(const RigLocation& location, const RigRecord& record, const std::string& touches_text,
                        bool make_current) {
  const fs::path folder = folderOf(location);
  const auto seconds = secondsOfUtc(record.provenance.created_utc);
  if (!seconds) throw CalibrationError("rig store: a rig without created_utc cannot be stored, add it");
  if (const std::string why = whyNotOf(record, location); !why.empty())
    throw CalibrationError("rig store: " + why + ", keep it where it belongs");
  makeFolder(folder);
  const FolderLock lock(folder);
  removeLeftovers(folder);

  // The parent's hash makes roll-back independent of the clock.
  RigRecord kept = record;
  if (const auto before = nameInForce(location); before && kept.provenance.parent.empty())
    if (const auto old = readable(folder / *before)) kept.provenance.parent = old->hash;

  FileName name{*seconds, 1};
  while (fs::exists(folder / (name.stem() + kEnding)) || fs::exists(folder / (name.stem() + kTouchesEnding)))
    if (++name.number > kMaxInASecond)
      throw CalibrationError("rig store: " + folder.string() + " holds 99 rigs of this second, set the clock");

  // Keep only what can be read back; touches before the file that refers to them, the pointer last.
  OutputFile rig(folder / (name.stem() + kEnding), false);
  rig.write(rigRecordText(kept));
  readRigRecord(rig.temporaryPath());
  std::optional<OutputFile> touches, pointer;
  if (!touches_text.empty()) touches.emplace(folder / (name.stem() + kTouchesEnding), false).write(touches_text);
  if (make_current) pointer.emplace(folder / "current", true).write(name.stem() + kEnding + "\n");
  try {
    if (touches) touches->commit();
    rig.commit();
    if (pointer) pointer->commit();
  } catch (const CalibrationError&) {
    // Remove only our own files.
    std::error_code ignored;
    if (rig.isCommitted()) fs::remove(rig.path(), ignored);
    if (touches && touches->isCommitted()) fs::remove(touches->path(), ignored);
    throw;
  }
  return folder / (name.stem() + kEnding);
}

std::optional<std::string> RigStore::nameInForce(const RigLocation& location) const {
  try {
    const auto name = currentName(location);
    if (name && fs::exists(pathOf(location, *name))) return name;
  } catch (const CalibrationError&) {
    // A damaged pointer counts as none.
  }
  return std::nullopt;
}

std::string RigStore::rollBack(const RigLocation& location) {
  const fs::path folder = folderOf(location);
  const CalibrationError none("rig store: " + folder.string() + " has no rig before this one, calibrate again");
  if (names(location).empty()) throw none;
  const FolderLock lock(folder);
  removeLeftovers(folder);
  const std::vector<std::string> files = names(location);

  // By the parent's hash, else by time; without a current one, the newest.
  std::string before = files.back();
  if (const auto now = nameInForce(location)) {
    const auto at = std::ranges::find(files, *now);
    const auto record = readable(folder / *now);
    const auto parent = std::ranges::find_if(files, [&](const std::string& name) {
      if (!record || record->provenance.parent.empty() || name == *now) return false;
      const auto other = readable(folder / name);
      return other && other->hash == record->provenance.parent;
    });
    if (parent == files.end() && at == files.begin()) throw none;
    before = parent != files.end() ? *parent : *(at - 1);
  }
  const RigRecord old = readRigRecord((folder / before).string());
  if (const std::string why = whyNotOf(old, location); !why.empty())
    throw CalibrationError("rig file " + (folder / before).string() + ": " + why + ", calibrate again");
  OutputFile(folder / "current", true).commit(before + "\n");
  return before;
}

std::string mismatchWith(const RigRecord& record, const std::string& device_model, const std::string& serial,
                         const std::string& mount) {
  if (!record.rig.device) return "";
  const RigDevice& measured = *record.rig.device;
  const auto differ = [](const std::string& a, const std::string& b) { return !a.empty() && !b.empty() && a != b; };
  if (differ(measured.model, device_model))
    return "it was measured with a " + measured.model + ", this is a " + device_model;
  if (differ(measured.serial, serial))
    return "it was measured with serial " + shown(measured.serial) + ", this device is " + shown(serial);
  if (differ(measured.mount, mount)) return "it was measured at the " + measured.mount + " mount, this is the " + mount;
  return "";
}

std::optional<double> age_days(const RigRecord& record, const std::string& now_utc) {
  const auto then = secondsOfUtc(record.provenance.created_utc), now = secondsOfUtc(now_utc);
  if (!then || !now) return std::nullopt;
  return static_cast<double>(*now - *then) / 86400.0;
}

}  // namespace calibration
