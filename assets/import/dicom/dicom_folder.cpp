#include "assets/import/dicom/dicom_folder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>

#include "assets/load_error.h"
#include "assets/scan/header_text.h"

namespace assets {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 20'000;
constexpr std::uint64_t kMost_bytes = std::uint64_t{8} << 30;
constexpr int kDeepest = 8;

/// Every regular file below, without links.
std::vector<fs::path> filesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  std::uint64_t bytes = 0;
  std::error_code error;
  fs::recursive_directory_iterator walk(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && walk != fs::recursive_directory_iterator(); walk.increment(error)) {
    std::error_code ignored;
    const fs::file_status status = walk->symlink_status(ignored);
    if (fs::is_directory(status) && walk.depth() + 1 >= kDeepest) walk.disable_recursion_pending();
    if (!fs::is_regular_file(status)) continue;
    files.push_back(walk->path());
    bytes += walk->file_size(ignored);
    if (files.size() > kMostFiles || bytes > kMost_bytes)
      throw LoadError("scan: more than 20,000 files or 8 GB lie in it; choose the folder of one scan");
  }
  std::ranges::sort(files);
  return files;
}

/// What a source stands for: a DICOMDIR is only a list, often stale, of the folder that it lies in.
fs::path rootOf(const std::string& source) {
  const fs::path path = source;
  std::error_code error;
  if (fs::is_directory(path, error)) return path;
  std::string name = lowerCase(path.filename().string());
  if (name.ends_with(".")) name.pop_back();
  return name == "dicomdir" ? (path.has_parent_path() ? path.parent_path() : fs::path(".")) : path;
}

bool isDirectoryList(const fs::path& path) { return lowerCase(path.filename().string()).starts_with("dicomdir"); }

DicomHeader headerOf(const fs::path& path) {
  DicomHeader unread;
  unread.fault = DicomFault::unread;
  std::error_code error;
  if (fs::file_size(path, error) == 0 || error) return unread;
  try {
    return openDicom(path.string(), path.stem().string()).header;
  } catch (const LoadError&) {
    return unread;
  }
}

}  // namespace

bool isPlainFileName(const std::string& name) {
  constexpr std::array<std::string_view, 26> kStems = {
      "",    "im",    "img", "image", "i", "ima", "ct", "cbct", "s", "sl",    "slice", "z",   "file",
      "dcm", "dicom", "se",  "ser",   "e", "mr",  "a",  "b",    "c", "frame", "axial", "vol", "x"};
  constexpr std::array<std::string_view, 5> kEndings = {"", ".dcm", ".ima", ".img", ".dic"};
  std::string rest = lowerCase(name);
  const std::size_t letters = std::min(rest.find_first_not_of("abcdefghijklmnopqrstuvwxyz"), rest.size());
  if (std::ranges::find(kStems, std::string_view(rest).substr(0, letters)) == kStems.end()) return false;
  rest.erase(0, letters);
  if (!rest.empty() && (rest[0] == '_' || rest[0] == '-')) rest.erase(0, 1);
  const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
  constexpr std::size_t kMostDigits = 6;
  if (digits > kMostDigits || digits + letters == 0) return false;
  return std::ranges::find(kEndings, std::string_view(rest).substr(digits)) != kEndings.end();
}

bool holdsDicom(const std::string& source) {
  const fs::path root = rootOf(source);
  std::error_code error;
  if (!fs::is_directory(root, error)) return fs::is_regular_file(root, error) && headerOf(root).isDicom();
  return std::ranges::any_of(filesBelow(root),
                             [](const fs::path& path) { return isDirectoryList(path) || headerOf(path).isDicom(); });
}

std::string numberedName(const std::string& path) {
  std::string name;
  for (const char letter : path) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(letter)) != 0;
    if (!is_digit || name.empty() || name.back() != '#') name += is_digit ? '#' : letter;
  }
  return name;
}

namespace {

/// Files that the owner leaves out, by any of their names.
class LeftOut {
 public:
  explicit LeftOut(const std::vector<std::string>& without) : without_(without), is_used_(without.size(), false) {}

  bool holds(std::initializer_list<std::string_view> names) {
    bool is_out = false;
    for (std::size_t w = 0; w < without_.size(); ++w)
      if (std::ranges::find(names, without_[w]) != names.end()) is_used_[w] = is_out = true;
    return is_out;
  }
  void requireAllUsed() const {
    for (std::size_t w = 0; w < without_.size(); ++w)
      if (!is_used_[w])
        throw LoadError("scan: --without names file " + std::to_string(w + 1) +
                        " of the list, which is not in it; give a file's name, or \"file 12\" as a message says it");
  }

 private:
  const std::vector<std::string>& without_;
  std::vector<bool> is_used_;
};

std::string numbered(std::size_t n) { return "file " + std::to_string(n + 1); }

}  // namespace

DicomBytes DicomFile::pixels() const {
  return pixelBytes(received.empty() ? DicomBytes(path) : DicomBytes::ofView(received), header);
}

DicomFolder readDicomFolder(const std::string& source, const std::vector<std::string>& without) {
  const fs::path root = rootOf(source);
  std::error_code error;
  const bool is_folder = fs::is_directory(root, error);
  std::vector<fs::path> paths = is_folder ? filesBelow(root) : std::vector<fs::path>{root};
  std::erase_if(paths, isDirectoryList);

  DicomFolder folder;
  LeftOut left_out(without);
  std::map<std::string, int> times_named;
  for (const fs::path& path : paths) ++times_named[path.filename().string()];
  for (std::size_t n = 0; n < paths.size(); ++n) {
    DicomFile file{paths[n].string(), "", headerOf(paths[n])};
    const std::string name = paths[n].filename().string();
    const bool is_shown = isPlainFileName(name) && !file.header.name_is_telling && times_named[name] == 1;
    file.shown = is_shown ? name : numbered(n);
    const std::string relative = is_folder ? paths[n].lexically_relative(root).string() : name;
    if (left_out.holds({name, relative, file.shown, numbered(n)}))
      ++folder.left_out;
    else
      folder.files.push_back(std::move(file));
  }
  left_out.requireAllUsed();
  return folder;
}

DicomFolder readDicomFolder(const ReceivedFiles& files, const std::vector<std::string>& without) {
  DicomFolder folder;
  LeftOut left_out(without);
  for (std::size_t n = 0; n < files.count(); ++n) {
    if (left_out.holds({numbered(n)})) {
      ++folder.left_out;
      continue;
    }
    DicomFile file{"", numbered(n), {}, files.file(n)};
    file.header = openDicom(DicomBytes::ofView(file.received), "").header;
    folder.files.push_back(std::move(file));
  }
  left_out.requireAllUsed();
  return folder;
}

}  // namespace assets
