#include "assets/scan/voxel_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "assets/load_error.h"
#include "assets/scan/header_text.h"

namespace assets {

namespace {

namespace fs = std::filesystem;

/// A name with one number in it.
struct Pattern {
  std::string before;
  std::string after;
  std::size_t width = 0;
  bool is_zero_filled = false;

  std::string with(std::int64_t number) const {
    const std::string digits = std::to_string(number);
    const std::string fill(width > digits.size() ? width - digits.size() : 0, is_zero_filled ? '0' : ' ');
    return before + fill + digits + after;
  }
};

Pattern patternIn(const std::string& header_path, const std::string& text) {
  const auto refuse = [&] {
    refuseScan(header_path, "the name " + printableExcerpt(text) +
                                " of its data files needs one number, as in 'slice%03d.raw'; name the files so");
  };
  Pattern pattern;
  bool has_number = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string& part = has_number ? pattern.after : pattern.before;
    if (text[at] != '%') {
      part += text[at];
      continue;
    }
    if (text.compare(at, 2, "%%") == 0) {
      part += '%';
      ++at;
      continue;
    }
    if (has_number) refuse();
    has_number = true;
    const std::size_t kind = std::min(text.find_first_not_of("0123456789", at + 1), text.size());
    const std::string width = text.substr(at + 1, kind - at - 1);
    if (kind == text.size() || std::string("diu").find(text[kind]) == std::string::npos || width.size() > 2) refuse();
    pattern.is_zero_filled = width.starts_with('0');
    pattern.width = width.empty() ? 0 : static_cast<std::size_t>(parseInteger(width).value_or(0));
    at = kind;
  }
  if (!has_number) refuse();
  return pattern;
}

bool isBelow(const fs::path& file, const fs::path& folder) {
  const fs::path from_folder = file.lexically_relative(folder);
  return !from_folder.empty() && *from_folder.begin() != ".." && *from_folder.begin() != ".";
}

}  // namespace

bool isList(const std::string& entry) {
  const std::vector<std::string> words = wordsOf(entry);
  return !words.empty() && lowerCase(words[0]) == "list";
}

VoxelFile dataFile(const std::string& header_path, const std::string& name) {
  const fs::path relative = name;
  const bool leaves = relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end();
  const auto refuse = [&](const std::string& reason) {
    refuseScan(header_path, "its data file " + printableExcerpt(name) + " " + reason);
  };
  if (leaves) refuse("is outside its folder; put both into one folder");
  if (name.empty() || name.find('\0') != std::string::npos) refuse("has no name; export the volume again");

  std::error_code error;
  fs::path folder = fs::path(header_path).parent_path();
  folder = fs::canonical(folder.empty() ? "." : folder, error);
  const fs::path file = error ? fs::path() : fs::canonical(folder / relative, error);
  if (error) refuse("is not there; put it next to the header");
  if (file != folder && !isBelow(file, folder)) refuse("is outside its folder; put both into one folder");
  if (!fs::is_regular_file(file, error)) refuse("is not a regular file; name the file with the voxels");
  return {file.string(), 0};
}

std::vector<VoxelFile> listedDataFiles(const std::string& header_path, const std::vector<std::string>& names,
                                       std::uint64_t expected) {
  if (names.size() != expected)
    refuseScan(header_path, "it lists " + std::to_string(names.size()) + " data files where it needs " +
                                std::to_string(expected) + kExportAgain);
  std::vector<VoxelFile> files;
  for (const std::string& each : names) files.push_back(dataFile(header_path, each));
  return files;
}

std::uint64_t NumberedNames::count() const {
  constexpr std::int64_t kMaxNumber = 1'000'000'000;
  if (std::max({std::abs(first), std::abs(last), std::abs(step)}) > kMaxNumber || step == 0) return 0;
  return static_cast<std::uint64_t>(std::max<std::int64_t>((last - first) / step + 1, 0));
}

std::vector<VoxelFile> numberedDataFiles(const std::string& header_path, const NumberedNames& names,
                                         std::uint64_t expected) {
  const Pattern pattern = patternIn(header_path, names.pattern);
  const std::uint64_t count = names.count();
  if (count < 1 || count != expected)
    refuseScan(header_path, "it names " + std::to_string(count) + " data files where it needs " +
                                std::to_string(expected) + "; export it again");
  std::vector<VoxelFile> files;
  for (std::uint64_t n = 0; n < count; ++n)
    files.push_back(dataFile(header_path, pattern.with(names.first + static_cast<std::int64_t>(n) * names.step)));
  return files;
}

}  // namespace assets
