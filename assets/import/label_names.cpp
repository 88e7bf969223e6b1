#include "assets/import/label_names.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "assets/json_depth.h"
#include "assets/load_error.h"
#include "assets/scan/compressed_bytes.h"
#include "assets/scan/header_text.h"
#include "assets/scan/regular_file.h"

namespace assets {
namespace {

constexpr std::size_t kMostRead_bytes = 1 << 20;
constexpr std::size_t kLongestName = 200;

std::string beginningOf(const std::string& path) {
  try {
    const RegularFile file(path);
    if (isGzip(file)) return firstDecompressedBytes(file, kMostRead_bytes);
    std::string bytes(kMostRead_bytes, '\0');
    bytes.resize(file.readAt(0, bytes));
    return bytes;
  } catch (const LoadError&) {
    return {};
  }
}

std::optional<int> labelValue(std::string_view text) {
  const auto value = parseInteger(trimmed(text));
  return value && *value >= 0 && *value < 100'000 ? std::optional(static_cast<int>(*value)) : std::nullopt;
}

}  // namespace

std::map<int, std::string> namesInNrrdHeader(const std::string& header) {
  std::map<int, std::string> name_of_segment, names;
  std::map<int, int> value_of_segment;
  std::size_t at = 0;
  while (at < header.size()) {
    const std::size_t end = std::min(header.find('\n', at), header.size());
    const std::string line = trimmed(std::string_view(header).substr(at, end - at));
    at = end + 1;
    if (line.empty()) break;
    const std::size_t assigned = line.find(":=");
    constexpr std::string_view kSegment = "Segment";
    if (assigned == std::string::npos || !line.starts_with(kSegment)) continue;
    const std::size_t underscore = line.find('_');
    if (underscore == std::string::npos || underscore > assigned) continue;
    const auto segment = labelValue(std::string_view(line).substr(kSegment.size(), underscore - kSegment.size()));
    const std::string key = line.substr(underscore + 1, assigned - underscore - 1), value = line.substr(assigned + 2);
    if (!segment) continue;
    if (key == "Name") name_of_segment[*segment] = value.substr(0, kLongestName);
    if (key == "LabelValue")
      if (const auto number = labelValue(value)) value_of_segment[*segment] = *number;
  }
  for (const auto& [segment, value] : value_of_segment)
    if (name_of_segment.contains(segment)) names[value] = name_of_segment[segment];
  return names;
}

std::map<int, std::string> namesInLabelTable(const std::string& xml) {
  std::map<int, std::string> names;
  constexpr std::string_view kLabel = "<Label ", kKey = "Key=\"", kData = "<![CDATA[", kDataEnd = "]]>";
  for (std::size_t at = xml.find(kLabel); at != std::string::npos; at = xml.find(kLabel, at + 1)) {
    const std::size_t end = xml.find("</Label>", at), close = xml.find('>', at), key = xml.find(kKey, at);
    if (end == std::string::npos) break;
    if (close == std::string::npos || key == std::string::npos || key > close || close > end) continue;
    const std::size_t digits = key + kKey.size();
    const auto value = labelValue(std::string_view(xml).substr(digits, xml.find('"', digits) - digits));
    std::string name = xml.substr(close + 1, end - close - 1);
    if (name.starts_with(kData) && name.ends_with(kDataEnd))
      name = name.substr(kData.size(), name.size() - kData.size() - kDataEnd.size());
    if (value) names[*value] = name.substr(0, kLongestName);
  }
  return names;
}

std::map<int, std::string> namesInDataset(const std::string& text) {
  std::map<int, std::string> names;
  if (text.empty() || isNestedTooDeep(text)) return names;
  const nlohmann::json dataset = nlohmann::json::parse(text, nullptr, false);
  if (!dataset.is_object() || !dataset.contains("labels") || !dataset["labels"].is_object()) return names;
  for (const auto& [key, value] : dataset["labels"].items()) {
    // nnU-Net 2 has "name": value, its predecessor "value": "name".
    if (value.is_number_integer())
      if (const auto number = labelValue(value.dump())) names[*number] = key.substr(0, kLongestName);
    if (value.is_string())
      if (const auto number = labelValue(key)) names[*number] = value.get<std::string>().substr(0, kLongestName);
  }
  return names;
}

std::map<int, std::string> labelNames(const std::string& path) {
  const std::string lower = lowerCase(path);
  const bool is_nifti = lower.ends_with(".nii") || lower.ends_with(".nii.gz");
  const std::string beginning = beginningOf(path);
  std::map<int, std::string> names;
  if (is_nifti && beginning.size() > 352) {
    const std::size_t end = beginning.find("</LabelTable>");
    if (end != std::string::npos) names = namesInLabelTable(beginning.substr(352, end - 352));
  } else if (!is_nifti) {
    names = namesInNrrdHeader(beginning);
  }
  if (!names.empty()) return names;
  return namesInDataset(beginningOf((std::filesystem::path(path).parent_path() / "dataset.json").string()));
}

}  // namespace assets
