#include "calibration/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string_view>

namespace calibration {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw CalibrationError("cannot write " + path + ": " + reason);
}

[[noreturn]] void refuseForSystem(const std::string& path, int error) {
  refuse(path, std::string(std::strerror(error)) + "; choose another folder or free some space");
}

/// Symbolic links followed, no trailing slash.
std::string resolved(std::string path) {
  if (path.empty()) refuse("''", "the name is empty; name a file or folder");
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  std::error_code ignored;
  if (!fs::is_symlink(path, ignored)) return path;
  const fs::path target = fs::weakly_canonical(path, ignored);
  return target.empty() ? path : target.string();
}

fs::path parentOf(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

void refuseWithoutParent(const std::string& path) {
  std::error_code error;
  const fs::path parent = parentOf(path);
  if (!fs::is_directory(parent, error)) refuse(path, "there is no folder " + parent.string() + "; create it first");
  const std::string name = fs::path(path).filename().string();
  if (name.empty() || name == "." || name == "..") refuse(path, "that is not a file or folder name; give one");
}

constexpr std::string_view kMarkBegin = ".part-", kKeptBegin = ".kept-",
                           kMarkDigits = "0123456789abcdefghijklmnopqrstuvwxyz";
constexpr std::size_t kMarkLength = kMarkBegin.size() + 8 + 1;  // .part-k3x80qzd-

/// Whether the prefix of a temporary name starts at this position.
bool isMarkAt(std::string_view text, std::size_t at) {
  const std::string_view mark = text.substr(at, kMarkLength);
  return mark.size() == kMarkLength && mark.starts_with(kMarkBegin) && mark.back() == '-' &&
         mark.substr(kMarkBegin.size(), 8).find_first_not_of(kMarkDigits) == std::string_view::npos;
}

/// A hidden name in the target's folder that ends with the target's name, extension included.
std::string temporaryNameFor(const std::string& path) {
  std::random_device source;
  std::uniform_int_distribution<std::size_t> digit(0, kMarkDigits.size() - 1);
  std::string mark(kMarkBegin);
  for (int i = 0; i < 8; ++i) mark += kMarkDigits[digit(source)];
  return (parentOf(path) / (mark + "-" + fs::path(path).filename().string())).string();
}

/// Where the existing folder is kept while it is replaced, on file systems without exchange.
std::string keptNameFor(const std::string& path) {
  return (parentOf(path) / (std::string(kKeptBegin) + fs::path(path).filename().string())).string();
}

/// Locks a temporary while the descriptor is open; the lock of a killed program is released.
int claimed(const std::string& temporary_path, int flags) {
  const int descriptor = ::open(temporary_path.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

/// Removes abandoned temporaries of this target: unlocked and older than a minute, so that none is removed between its
/// creation and its lock.
void clearAbandoned(const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(parentOf(path), ignored)) {
    const std::string found = entry.path().filename().string();
    if (!isMarkAt(found, 0) || found.substr(kMarkLength) != name) continue;
    const auto age = fs::file_time_type::clock::now() - entry.last_write_time(ignored);
    if (ignored || age < std::chrono::minutes(1)) continue;
    const int descriptor = claimed(entry.path().string(), O_RDONLY);
    if (descriptor < 0) continue;
    fs::remove_all(entry.path(), ignored);
    ::close(descriptor);
  }
}

bool exists(const std::string& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0;
}

/// After a program was killed during an exchange: the previous folder still has its temporary name, with or without its
/// successor in place.
void restoreKept(const std::string& path) {
  const std::string kept = keptNameFor(path);
  std::error_code ignored;
  if (!exists(kept)) return;
  if (exists(path))
    fs::remove_all(kept, ignored);
  else
    ::rename(kept.c_str(), path.c_str());
}

/// Swaps the two folders; on file systems without exchange two renames, undone if the second fails.
int exchange(const std::string& ours, const std::string& theirs) {
  if (::renameat2(AT_FDCWD, ours.c_str(), AT_FDCWD, theirs.c_str(), RENAME_EXCHANGE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  const std::string aside = keptNameFor(theirs);
  if (::rename(theirs.c_str(), aside.c_str()) != 0) return errno;
  if (::rename(ours.c_str(), theirs.c_str()) != 0) {
    const int error = errno;
    ::rename(aside.c_str(), theirs.c_str());
    return error;
  }
  std::error_code ignored;
  fs::remove_all(aside, ignored);
  return 0;
}

/// After the rename: reports its error, or flushes the parent folder.
void finish(const std::string& path, int error) {
  if (error == EEXIST) refuse(path, "it exists; use --force to replace it");
  if (error != 0) refuseForSystem(path, error);
  syncToDisk(parentOf(path).string());
}

}  // namespace

int renameNoReplace(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  if (exists(to)) return EEXIST;
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

int syncToDisk(const std::string& path) {
  const int descriptor = ::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return error;
}

std::string withoutTemporaryNames(std::string text) {
  for (std::size_t at = text.find(kMarkBegin); at != std::string::npos; at = text.find(kMarkBegin, at)) {
    if (isMarkAt(text, at))
      text.erase(at, kMarkLength);
    else
      ++at;
  }
  return text;
}

OutputFile::OutputFile(std::string path, bool overwrite) : path_(resolved(std::move(path))), overwrite_(overwrite) {
  refuseWithoutParent(path_);

  struct stat status {};
  if (::stat(path_.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) refuse(path_, "it is a folder; name a file");
    if (!S_ISREG(status.st_mode)) refuse(path_, "it is not a plain file; name one");
    if (!overwrite_) refuse(path_, "it exists; use --force to replace it");
  }

  // Create the temporary now, so that an unwritable folder is found before any work.
  clearAbandoned(path_);
  temporary_path_ = temporaryNameFor(path_);
  claim_ = ::open(temporary_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (claim_ < 0) refuseForSystem(path_, errno);
  ::flock(claim_, LOCK_EX | LOCK_NB);
}

OutputFile::~OutputFile() {
  if (!committed_) ::unlink(temporary_path_.c_str());
  ::close(claim_);
}

void OutputFile::write(const std::string& text) {
  std::ofstream out(temporary_path_, std::ios::binary);
  out << text;
  out.close();
  if (!out) refuse(path_, "the disk is full or fails; free some space");
}

void OutputFile::commit(const std::string& text) {
  write(text);
  commit();
}

void OutputFile::commit() {
  int error = syncToDisk(temporary_path_);
  if (error == 0 && overwrite_) error = ::rename(temporary_path_.c_str(), path_.c_str()) == 0 ? 0 : errno;
  if (error == 0 && !overwrite_) error = renameNoReplace(temporary_path_, path_);
  finish(path_, error);
  committed_ = true;
}

OutputFolder::OutputFolder(std::string path, bool overwrite, std::vector<std::string> contents)
    : path_(resolved(std::move(path))), contents_(std::move(contents)), overwrite_(overwrite) {
  refuseWithoutParent(path_);
  restoreKept(path_);
  refuseUnlessReplaceable();
  clearAbandoned(path_);
  temporary_path_ = temporaryNameFor(path_);
  if (::mkdir(temporary_path_.c_str(), 0777) != 0) refuseForSystem(path_, errno);
  claim_ = claimed(temporary_path_, O_RDONLY | O_DIRECTORY);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!committed_) fs::remove_all(temporary_path_, ignored);
  if (claim_ >= 0) ::close(claim_);
}

void OutputFolder::refuseUnlessReplaceable() const {
  if (!exists(path_)) return;
  std::error_code error;
  if (!fs::is_directory(path_, error)) refuse(path_, "it exists and is not a folder; choose another name");
  if (fs::is_empty(path_, error) && !error) return;
  if (!overwrite_) refuse(path_, "it exists; use --force to replace it");
  fs::directory_iterator entry(path_, error);
  if (error) refuseForSystem(path_, error.value());
  for (const auto& found : entry) {
    const std::string name = found.path().filename().string();
    if (std::find(contents_.begin(), contents_.end(), name) == contents_.end())
      refuse(path_, "it holds '" + name + "', which would be lost; move that away or choose another folder");
  }
}

void OutputFolder::commit() {
  // Files first, then the folder that lists them.
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(temporary_path_, ignored)) syncToDisk(entry.path().string());
  syncToDisk(temporary_path_);

  refuseUnlessReplaceable();
  int error = 0;
  if (!exists(path_)) {
    error = renameNoReplace(temporary_path_, path_);
  } else if (fs::is_empty(path_, ignored)) {
    error = ::rename(temporary_path_.c_str(), path_.c_str()) == 0 ? 0 : errno;
  } else {
    error = exchange(temporary_path_, path_);
    if (error == 0) fs::remove_all(temporary_path_, ignored);  // the previous one
  }
  finish(path_, error);
  committed_ = true;
}

}  // namespace calibration
