#include "calibration/checked_yaml.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

namespace calibration {
namespace {

constexpr std::uintmax_t kLargestFile_bytes = 4 << 20;
constexpr std::size_t kLongestText_bytes = 200;
constexpr int kDeepest = 64, kSchema = 1;

void keepOpenCvQuiet() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
}

/// Nesting depth of brackets and of dashes, outside quotes and comments.
int depthOf(const std::string& bytes) {
  int brackets = 0, dashes = 0, deepest = 0;
  char quote = 0, before = '\n';
  for (std::size_t i = 0; i < bytes.size(); before = bytes[std::min(i, bytes.size() - 1)], ++i) {
    const char c = bytes[i];
    if (c == '\n') quote = 0;
    if (quote != 0) {
      if (c == '\\') ++i;
      if (c == quote) quote = 0;
      continue;
    }
    if (c == '#' && (before == ' ' || before == '\n')) i = std::min(bytes.find('\n', i), bytes.size()) - 1;
    if (c == '"' || c == '\'') quote = c;
    if (c == '[' || c == '{') ++brackets;
    if (c == ']' || c == '}') --brackets;
    if (c == '-') ++dashes;
    if (c != '-' && c != ' ') dashes = 0;
    deepest = std::max({deepest, brackets, dashes});
  }
  return deepest;
}

/// OpenCV hangs on a zero byte.
bool isText(const std::string& bytes) {
  return std::ranges::none_of(
      bytes, [](unsigned char c) { return c == 0x7f || (c < ' ' && c != '\n' && c != '\r' && c != '\t'); });
}

bool isNumber(const cv::FileNode& node) { return node.isInt() || node.isReal(); }

}  // namespace

struct CheckedYaml::Storage {
  std::string bytes;
  cv::FileStorage file;
};

CheckedYaml::CheckedYaml(std::string kind, std::string path)
    : kind_(std::move(kind)), path_(std::move(path)), storage_(std::make_unique<Storage>()) {
  keepOpenCvQuiet();
  std::error_code error;
  const auto size = std::filesystem::file_size(path_, error);
  if (error || !std::filesystem::is_regular_file(path_))
    refuse("it cannot be read", "check the path and its permissions");
  if (size == 0 || size > kLargestFile_bytes) refuse("its size is not that of such a file", "check the path");
  std::ifstream in(path_, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (!in) refuse("it cannot be read", "check its permissions and the disk");
  storage_->bytes = bytes.str();
  if (!isText(storage_->bytes)) refuse("it holds bytes that are not text", "give the file that calibration wrote");
  if (depthOf(storage_->bytes) > kDeepest)
    refuse("its lists are nested more than 64 deep", "give the file that calibration wrote");
  // Damaged text makes OpenCV throw its own or the standard library's exceptions.
  bool opened = false;
  try {
    constexpr int kFromMemory = cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML;
    opened = storage_->file.open(storage_->bytes, kFromMemory);
  } catch (const std::exception&) {
  }
  if (!opened) refuse("it is not OpenCV FileStorage YAML, or truncated", "give the file that calibration wrote");
  // OpenCV throws when a key is looked up in a list or a number.
  if (!root().isMap()) refuse("it holds no keys", "give the file that calibration wrote");
}

CheckedYaml::~CheckedYaml() = default;

void CheckedYaml::refuse(const std::string& what, const std::string& mend) const {
  throw CalibrationError(kind_ + " " + path_ + ": " + what + ", " + mend);
}

bool CheckedYaml::isKind(std::string_view kind) const {
  const cv::FileNode node = root()["kind"];
  return node.isString() && node.string() == kind;
}

void CheckedYaml::checkKind(std::string_view kind) const {
  if (!isKind(kind))
    refuse("it is not a " + kind_ + " (kind: \"" + std::string(kind) + "\" missing)",
           "give the file that calibration wrote");
  const cv::FileNode schema = root()["schema"];
  if (schema.isInt() && static_cast<int>(schema) > kSchema)
    refuse("its schema " + std::to_string(static_cast<int>(schema)) + " is newer than this program's 1",
           "update the program");
  if (!schema.isInt() || static_cast<int>(schema) != kSchema) refuse("its schema is not 1", "write 'schema: 1'");
}

const std::string& CheckedYaml::bytes() const { return storage_->bytes; }

cv::FileNode CheckedYaml::root() const { return storage_->file.root(); }

cv::FileNode CheckedYaml::map(const cv::FileNode& parent, const std::string& key) const {
  const cv::FileNode node = parent[key];
  if (!node.isMap()) refuse("block '" + key + "' is missing", "add it (calibration/record/README.md)");
  return node;
}

bool CheckedYaml::has(const cv::FileNode& parent, const std::string& key) const { return !parent[key].empty(); }

double CheckedYaml::number(const cv::FileNode& parent, const std::string& key) const {
  const cv::FileNode node = parent[key];
  if (!isNumber(node)) refuse("'" + key + "' is missing or not a number", "correct it");
  const double value = node.real();
  if (!(std::abs(value) <= kLargest.most))
    refuse("'" + key + "' is not finite or beyond " + kLargest.name, kLargest.mend);
  return value;
}

std::vector<double> CheckedYaml::numbers(const cv::FileNode& list, const std::string& key, std::size_t count,
                                         const Limit& limit) const {
  if (list.empty()) refuse("'" + key + "' is missing", "add it (calibration/record/README.md)");
  if (!list.isSeq() || list.size() != count)
    refuse("'" + key + "' is not a list of " + std::to_string(count) + " numbers", "correct it");
  std::vector<double> values;
  for (const cv::FileNode& item : list) {
    if (!isNumber(item)) refuse("'" + key + "' holds an entry that is not a number", "correct it");
    values.push_back(item.real());
  }
  for (const double v : values)
    if (!(std::abs(v) <= limit.most))
      refuse("'" + key + "' holds a number that is not finite or beyond " + limit.name, limit.mend);
  return values;
}

glm::dvec3 CheckedYaml::vector(const cv::FileNode& parent, const std::string& key) const {
  const auto v = numbers(parent[key], key, 3);
  return {v[0], v[1], v[2]};
}

int CheckedYaml::integer(const cv::FileNode& parent, const std::string& key, int least, int most,
                         const std::string& where) const {
  const cv::FileNode node = parent[key];
  const int value = node.isInt() ? static_cast<int>(node) : 0;
  if (!node.isInt() || value < least || value > most)
    refuse(where + "'" + key + "' is not a whole number from " + std::to_string(least) + " to " + std::to_string(most),
           "correct it");
  return value;
}

std::string CheckedYaml::text(const cv::FileNode& parent, const std::string& key) const {
  const cv::FileNode node = parent[key];
  if (!node.isString()) refuse("'" + key + "' is missing or not a text", "correct it");
  const std::string value = node.string();
  if (value.size() > kLongestText_bytes || std::ranges::any_of(value, [](unsigned char c) { return c < ' '; }))
    refuse("'" + key + "' is longer than 200 bytes or not printable", "correct it");
  return value;
}

std::vector<double> CheckedYaml::sixteenNumbers(const cv::FileNode& node, const std::string& key) const {
  const auto declares = [&](const char* side) { return node[side].isInt() && static_cast<int>(node[side]) == 4; };
  if (node.isMap() && declares("rows") && declares("cols")) return numbers(node["data"], key, 16);
  if (node.isSeq() && node.size() == 16) return numbers(node, key, 16);
  std::vector<double> values;
  if (node.isSeq() && node.size() == 4)
    for (const cv::FileNode& row : node)
      for (const double v : numbers(row, key, 4)) values.push_back(v);
  if (values.size() != 16) refuse("'" + key + "' is not a 4x4 matrix", "write it as !!opencv-matrix, row-major, mm");
  return values;
}

CheckedYaml::Rigid CheckedYaml::rigid(const cv::FileNode& parent, const std::string& key, double tolerance) const {
  const std::vector<double> m = sixteenNumbers(parent[key], key);
  glm::dmat3 R{1.0};
  glm::dvec3 p{0.0};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) R[c][r] = m[static_cast<std::size_t>(4 * r + c)];
    p[r] = m[static_cast<std::size_t>(4 * r + 3)];
  }
  const glm::dmat3 gram = glm::transpose(R) * R;
  double error = std::abs(m[15] - 1.0);
  for (int c = 0; c < 3; ++c) {
    error = std::max(error, std::abs(m[static_cast<std::size_t>(12 + c)]));
    for (int r = 0; r < 3; ++r) error = std::max(error, std::abs(gram[c][r] - (r == c ? 1.0 : 0.0)));
  }
  const bool finite = std::isfinite(error) && std::isfinite(glm::dot(p, p));
  if (!finite || error > tolerance || glm::determinant(R) < 0.0)
    refuse("'" + key + "' is not a rigid pose with determinant +1",
           "correct the matrix (no scale, no flip: the mirror is in 'mirror')");
  return {glm::normalize(glm::quat_cast(R)), p};
}

std::string openCvVersion() { return CV_VERSION; }

}  // namespace calibration
