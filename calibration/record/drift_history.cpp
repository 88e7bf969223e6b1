#include "calibration/record/drift_history.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "calibration/record/record_folder.h"
#include "calibration/record/utc.h"

namespace calibration {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHeader = "utc,kind,n,rms_mm,bias_x_mm,bias_y_mm,bias_z_mm";
constexpr std::uintmax_t kLargestFile_bytes = 16 << 20;
constexpr std::array kKinds = {DriftKind::check, DriftKind::rezero, DriftKind::calibration};
constexpr double kMaxEntryError_mm = 1000.0;
constexpr int kMaxEntryTouches = 10000;

template <class Number>
std::optional<Number> numberIn(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string shortest(double value) {
  std::array<char, 40> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

std::optional<DriftKind> kindIn(std::string_view text) {
  for (const DriftKind kind : kKinds)
    if (nameOf(kind) == text) return kind;
  return std::nullopt;
}

std::optional<DriftEntry> entryIn(std::string_view line) {
  std::array<std::string_view, 7> cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == cells.size())) return std::nullopt;
    cells[i] = line.substr(0, comma);
    line.remove_prefix(i + 1 == cells.size() ? line.size() : comma + 1);
  }
  const auto kind = kindIn(cells[1]);
  const auto n = numberIn<int>(cells[2]);
  if (!secondsOfUtc(cells[0]) || !kind || !n || *n < 1 || *n > kMaxEntryTouches) return std::nullopt;
  std::array<double, 4> mm{};
  for (std::size_t i = 0; i < mm.size(); ++i) {
    const auto value = numberIn<double>(cells[i + 3]);
    if (!value || !(std::abs(*value) <= kMaxEntryError_mm)) return std::nullopt;
    mm[i] = *value;
  }
  if (mm[0] < 0.0) return std::nullopt;
  return DriftEntry{std::string(cells[0]), *kind, *n, mm[0], {{mm[1], mm[2], mm[3]}}};
}

std::string lineOf(const DriftEntry& entry) {
  return entry.utc + "," + std::string(nameOf(entry.kind)) + "," + std::to_string(entry.n) + "," +
         shortest(entry.rms_mm) + "," + shortest(entry.bias_mm.xyz.x) + "," + shortest(entry.bias_mm.xyz.y) + "," +
         shortest(entry.bias_mm.xyz.z);
}

[[noreturn]] void refuseHistory(const fs::path& path, const std::string& what, const std::string& mend) {
  throw CalibrationError("history " + path.string() + ": " + what + ", " + mend);
}

}  // namespace

std::string_view nameOf(DriftKind kind) {
  constexpr std::array<std::string_view, 3> kNames = {"check", "rezero", "calibration"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<DriftEntry> readHistory(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) > kLargestFile_bytes)
    refuseHistory(path, "it is not a history file", "move it away");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (!in) refuseHistory(path, "it cannot be read", "check its permissions");
  std::string_view rest = bytes.view();

  // A last line without end is incomplete.
  std::vector<DriftEntry> history;
  int line_number = 0;
  for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (++line_number == 1) {
      if (line != kHeader) refuseHistory(path, "its first line is not a history header", "move it away");
      continue;
    }
    const auto entry = entryIn(line);
    if (!entry) refuseHistory(path, "line " + std::to_string(line_number) + " cannot be read", "remove that line");
    history.push_back(*entry);
  }
  return history;
}

void appendHistory(const fs::path& path, const DriftEntry& entry) {
  const std::string line = lineOf(entry);
  if (!entryIn(line)) refuseHistory(path, "invalid entry: " + line, "check where it comes from");
  makeFolder(path.parent_path());
  const FolderLock lock(path.parent_path());
  readHistory(path);  // refuses a file that is not a history
  // A new file, or one with an incomplete first line, gets the header.
  std::string first;
  std::ifstream in(path, std::ios::binary);
  std::getline(in, first);
  if (first != kHeader || in.eof()) appendLine(path, std::string(kHeader));
  appendLine(path, line);
}

}  // namespace calibration
