#include "app/device/pose_csv.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr std::string_view kHeader = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz";
constexpr std::size_t kRequired = 8;  ///< columns of it
constexpr std::size_t kLargestFile_bytes = 1u << 30, kLongestLine = 4096;
constexpr std::size_t kMaxRows = 4'000'000;  ///< an hour at 1 kHz
constexpr double kLargestCoordinate_mm = 1e5;

std::string location(const std::string& path, std::size_t line) {
  return "pose file " + path + " line " + std::to_string(line);
}

[[noreturn]] void refuse(const std::string& path, std::size_t line, const std::string& what,
                         const std::string& next_step) {
  throw UsageError(location(path, line) + ": " + what + ", " + next_step);
}

std::vector<std::string_view> cells(std::string_view row) {
  std::vector<std::string_view> out = split(row);
  for (std::string_view& cell : out) {
    while (!cell.empty() && cell.front() == ' ') cell.remove_prefix(1);
    while (!cell.empty() && cell.back() == ' ') cell.remove_suffix(1);
  }
  return out;
}

/// Positions of the optional columns.
struct Columns {
  std::size_t count = kRequired;
  std::optional<std::size_t> drill, tool, action, button;
};

Columns columnsOf(const std::string& path, std::string header) {
  if (header.starts_with("\xEF\xBB\xBF")) header.erase(0, 3);  // spreadsheets write a byte-order mark
  const std::vector<std::string_view> names = cells(header), required = cells(kHeader);
  const auto wrong = [&](const std::string& what) {
    refuse(path, 1, what + ": the header is not " + std::string(kHeader) + "[,drill][,tool][,action][,button]",
           "add or correct it");
  };
  for (std::size_t i = 0; i < kRequired; ++i)
    if (i >= names.size() || names[i] != required[i]) wrong("column " + std::string(required[i]) + " is missing");
  Columns columns{names.size(), {}, {}, {}, {}};
  for (std::size_t i = kRequired; i < names.size(); ++i) {
    auto* const column = names[i] == "drill"    ? &columns.drill
                         : names[i] == "tool"   ? &columns.tool
                         : names[i] == "action" ? &columns.action
                         : names[i] == "button" ? &columns.button
                                                : nullptr;
    if (column == nullptr) wrong("there is no column \"" + std::string(names[i]) + "\"");
    if (column->has_value()) wrong("column " + std::string(names[i]) + " comes twice");
    *column = i;
  }
  return columns;
}

/// One row of the file while it is being read.
struct Row {
  const std::string& path;
  std::size_t line;
  std::vector<std::string_view> cell;

  double number(std::size_t column) const {
    if (const auto value = parseNumber<double>(cell[column])) return *value;
    refuse(path, line, std::string(split(kHeader)[column]) + " is not a finite number", "correct it");
  }
  bool isDown(std::size_t column, const std::string& name) const {
    const auto value = parseNumber<double>(cell[column]);
    if (!value) refuse(path, line, name + " is not a finite number", "correct it");
    if (*value != 0.0 && *value != 1.0) refuse(path, line, name + " is not 0 or 1", "correct it");
    return *value == 1.0;
  }
};

TimedPose poseFrom(const Row& row, const Columns& columns) {
  TimedPose pose;
  pose.line = row.line;
  pose.t_s = row.number(0);
  pose.X_PT.translation_mm = {row.number(1), row.number(2), row.number(3)};
  if (glm::length(pose.X_PT.translation_mm) > kLargestCoordinate_mm)
    refuse(row.path, row.line, "the position is beyond 100 m", "give mm in the patient's frame");
  const glm::dquat q{row.number(4), row.number(5), row.number(6), row.number(7)};
  if (std::abs(glm::length(q) - 1.0) > 0.01) refuse(row.path, row.line, "the quaternion is not unit", "normalise it");
  pose.X_PT.rotation = glm::normalize(q);
  if (columns.tool) pose.tool = row.cell[*columns.tool];
  if (columns.action) pose.action = row.cell[*columns.action];
  if (columns.drill) pose.drill = row.isDown(*columns.drill, "drill");
  if (columns.button) pose.button = row.isDown(*columns.button, "button");
  return pose;
}

}  // namespace

std::string lineOf(const std::string& path, const TimedPose& pose) { return location(path, pose.line); }

void refuseControls(const std::vector<TimedPose>& poses, const std::string& path) {
  for (const TimedPose& pose : poses)
    if (!pose.tool.empty() || !pose.action.empty() || pose.button)
      refuse(path, pose.line, "it requests a tool or an action, or presses a button",
             "leave the column out; rehearse --device poses:FILE executes it");
}

void refuseLongRun(const std::vector<TimedPose>& poses, const std::string& path) {
  if (poses.back().t_s - poses.front().t_s > kLongestRun_s)
    throw UsageError("pose file " + path + ": t_s spans more than an hour, give seconds or split it");
}

std::vector<TimedPose> readPoses(const std::string& path) {
  // A pipe would be waited for: looked at before it is opened.
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw UsageError("pose file " + path + ": it is not a plain file, give one");
  const auto bytes = std::filesystem::file_size(path, error);
  std::ifstream file(path);
  if (error || !file) throw UsageError("pose file " + path + ": it cannot be read, check the path and its permissions");
  if (bytes > kLargestFile_bytes) throw UsageError("pose file " + path + ": it is larger than 1 GiB, split it");

  std::vector<TimedPose> poses;
  std::string text;
  Columns columns;
  for (std::size_t line = 1; std::getline(file, text); ++line) {
    if (!text.empty() && text.back() == '\r') text.pop_back();
    if (line == 1) {
      columns = columnsOf(path, text);
      continue;
    }
    if (text.empty()) continue;
    if (text.size() > kLongestLine) refuse(path, line, "it is longer than any row", "correct it");
    if (poses.size() == kMaxRows)
      refuse(path, line, "there are more than " + std::to_string(kMaxRows) + " rows", "split the file");
    const Row row{path, line, cells(text)};
    if (row.cell.size() != columns.count)
      refuse(path, line,
             "it has " + std::to_string(row.cell.size()) + " values instead of " + std::to_string(columns.count),
             "complete it");
    poses.push_back(poseFrom(row, columns));
    if (poses.size() > 1 && poses.back().t_s <= poses[poses.size() - 2].t_s)
      refuse(path, line, "t_s does not rise", "order the rows by time");
  }
  if (poses.empty()) throw UsageError("pose file " + path + ": it has no poses, add rows below the header");
  return poses;
}

}  // namespace app
