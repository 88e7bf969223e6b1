#include "app/pose_csv.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "app/usage_error.h"

namespace app {
namespace {

constexpr std::string_view kHeader = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz";
constexpr std::size_t kLargestFile_bytes = 1u << 30;
constexpr double kLargestCoordinate_mm = 1e5;

[[noreturn]] void refuse(const std::string& path, std::size_t line, const std::string& what, const std::string& mend) {
  throw UsageError("pose file " + path + " line " + std::to_string(line) + ": " + what + ", " + mend);
}

std::vector<std::string_view> cells(std::string_view row) {
  std::vector<std::string_view> out;
  for (;;) {
    const std::size_t comma = row.find(',');
    std::string_view cell = row.substr(0, comma);
    while (!cell.empty() && cell.front() == ' ') cell.remove_prefix(1);
    while (!cell.empty() && cell.back() == ' ') cell.remove_suffix(1);
    out.push_back(cell);
    if (comma == std::string_view::npos) return out;
    row.remove_prefix(comma + 1);
  }
}

/// One row of the file while it is being read.
struct Row {
  const std::string& path;
  std::size_t line;
  std::vector<std::string_view> cell;

  double number(std::size_t column) const {
    static constexpr const char* kNames[] = {"t_s", "px_mm", "py_mm", "pz_mm", "qw", "qx", "qy", "qz", "drill"};
    double value = 0.0;
    const std::string_view text = cell[column];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
      refuse(path, line, std::string(kNames[column]) + " is not a finite number", "correct it");
    return value;
  }
};

TimedPose poseFrom(const Row& row, bool has_drill) {
  TimedPose pose;
  pose.t_s = row.number(0);
  pose.X_PT.translation_mm = {row.number(1), row.number(2), row.number(3)};
  if (glm::length(pose.X_PT.translation_mm) > kLargestCoordinate_mm)
    refuse(row.path, row.line, "the position is beyond 100 m", "give mm in the patient's frame");
  const glm::dquat q{row.number(4), row.number(5), row.number(6), row.number(7)};
  if (std::abs(glm::length(q) - 1.0) > 0.01) refuse(row.path, row.line, "the quaternion is not unit", "normalise it");
  pose.X_PT.rotation = glm::normalize(q);
  if (has_drill) {
    const double drill = row.number(8);
    if (drill != 0.0 && drill != 1.0) refuse(row.path, row.line, "drill is not 0 or 1", "correct it");
    pose.drill = drill == 1.0;
  }
  return pose;
}

}  // namespace

void refuseLongRun(const std::vector<TimedPose>& poses, const std::string& path) {
  if (poses.back().t_s - poses.front().t_s > kLongestRun_s)
    throw UsageError("pose file " + path + ": t_s spans more than an hour, give seconds or split it");
}

std::vector<TimedPose> readPoses(const std::string& path) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  std::ifstream file(path);
  if (error || !std::filesystem::is_regular_file(path) || !file)
    throw UsageError("pose file " + path + ": it can not be read, check the path and its permissions");
  if (bytes > kLargestFile_bytes) throw UsageError("pose file " + path + ": it is larger than 1 GiB, split it");

  std::vector<TimedPose> poses;
  std::string text;
  bool has_drill = false;
  for (std::size_t line = 1; std::getline(file, text); ++line) {
    if (!text.empty() && text.back() == '\r') text.pop_back();
    if (line == 1) {
      if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // spreadsheets write a byte-order mark
      has_drill = text == std::string(kHeader) + ",drill";
      if (!has_drill && text != kHeader)
        refuse(path, line, "the header is not " + std::string(kHeader) + "[,drill]", "add or correct it");
      continue;
    }
    if (text.empty()) continue;
    const Row row{path, line, cells(text)};
    if (const std::size_t expected = has_drill ? 9 : 8; row.cell.size() != expected)
      refuse(path, line, "it has " + std::to_string(row.cell.size()) + " values instead of " + std::to_string(expected),
             "complete it");
    poses.push_back(poseFrom(row, has_drill));
    if (poses.size() > 1 && poses.back().t_s <= poses[poses.size() - 2].t_s)
      refuse(path, line, "t_s does not rise", "order the rows by time");
  }
  if (poses.empty()) throw UsageError("pose file " + path + ": it has no poses, add rows below the header");
  return poses;
}

}  // namespace app
