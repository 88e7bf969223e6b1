#include "app/session/recording_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "app/session/file_seal.h"
#include "app/session/session_error.h"
#include "app/session/session_reader.h"
#include "calibration/output_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxTemporaries = 99;

SessionError inUse(const std::string& path) {
  return SessionError(path + ": another program is recording to it: choose another name, or wait until it ends");
}

SessionError notMade(const std::string& path, int error) {
  return SessionError(path + ": cannot be created (" + std::strerror(error) +
                      "): check the folder and its permissions");
}

bool isSameFile(int file, const std::string& path) {
  struct stat ours {
  }, named{};
  return ::fstat(file, &ours) == 0 && ::stat(path.c_str(), &named) == 0 && ours.st_ino == named.st_ino &&
         ours.st_dev == named.st_dev;
}

/// The descriptor; -1: locked by another program, or no longer the file of that name.
int locked(int file, const std::string& path) {
  if (::flock(file, LOCK_EX | LOCK_NB) == 0 && isSameFile(file, path)) return file;
  ::close(file);
  return -1;
}

/// Whether a killed program left no ticks: an empty file, a start only, or an unfinished start with its journal.
bool holdsNothing(const std::string& path) {
  std::error_code failed;
  if (fs::file_size(path, failed) == 0) return !failed;
  if (fs::exists(path + "-journal", failed)) return hasSessionMark(path) || !isDatabase(path);
  try {
    SessionReader session(path);
    return session.nextBlock().ticks.empty();
  } catch (const std::exception&) {
    return false;
  }
}

void removeFiles(const std::vector<std::string>& files) {
  std::error_code failed;
  for (const std::string& file : files) fs::remove(file, failed);
}

void syncFolderOf(const std::string& path) { calibration::syncToDisk(fs::path(path).parent_path().string()); }

}  // namespace

std::vector<std::string> sessionFiles(const std::string& path) {
  return {path, path + "-wal", path + "-shm", path + "-journal"};
}

std::string resolvedLinks(const std::string& path) {
  std::error_code failed;
  if (!fs::is_symlink(path, failed)) return path;
  const fs::path target = fs::weakly_canonical(path, failed);
  return failed ? path : target.string();
}

bool isBeingRecorded(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool busy = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(file);
  return busy;
}

RecordingFile::RecordingFile(std::string path, bool overwrite) : path_(resolvedLinks(path)) {
  try {
    lockTarget(overwrite);
    createTemporary();
  } catch (...) {
    unlock();
    throw;
  }
}

RecordingFile::~RecordingFile() {
  if (!kept_) removeFiles(sessionFiles(file_));
  unlock();
}

void RecordingFile::lockTarget(bool overwrite) {
  std::error_code failed;
  const fs::file_status status = fs::status(path_, failed);
  if (fs::is_directory(status)) throw SessionError(path_ + ": is a folder: name a file to record into");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw SessionError(path_ + ": is not a plain file: choose another name for the recording");
  for (const std::string& file : sessionFiles(path_)) {
    if (!fs::exists(file, failed)) continue;
    if (!overwrite) throw SessionError(file + ": already exists: choose another name for the recording or use --force");
    replaces_ = true;
  }
  if (!fs::exists(status)) return;
  const int old = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (old < 0) throw notMade(path_, errno);
  const int lock = locked(old, path_);
  if (lock < 0) throw inUse(path_);
  locks_.push_back(lock);
}

void RecordingFile::createTemporary() {
  for (int n = 1; n <= kMaxTemporaries;) {
    const std::string name = path_ + ".new" + (n == 1 ? "" : std::to_string(n));
    const int made = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (made < 0 && errno != EEXIST) throw notMade(path_, errno);
    const bool is_new = made >= 0;
    // Left by a killed program: kept if it holds ticks.
    if (!is_new && isBeingRecorded(name)) throw inUse(path_);
    if (!is_new && !holdsNothing(name)) {
      ++n;
      continue;
    }
    const int file = is_new ? made : ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
    const int lock = file < 0 ? -1 : locked(file, name);
    if (lock < 0) throw inUse(path_);
    if (is_new) {
      locks_.push_back(lock);
      own_ = lock;
      file_ = name;
      return;
    }
    removeFiles(sessionFiles(name));
    ::close(lock);
  }
  throw SessionError(path_ + ": too many unfinished recordings next to it: remove " + path_ + ".new*");
}

void RecordingFile::publish() {
  kept_ = true;
  if (replaces_ || file_ == path_) return;
  if (const int error = calibration::renameNoReplace(file_, path_); error != 0)
    throw SessionError(path_ + ": cannot be given to the recording (" + std::strerror(error) + "): it is " + file_,
                       SessionErrorKind::failed);
  file_ = path_;
  syncFolderOf(path_);
}

void RecordingFile::refuseIfReplaced() const {
  if (!isSameFile(own_, file_))
    throw SessionError(file_ + ": was replaced or removed by another program during recording: its content is lost",
                       SessionErrorKind::failed);
}

void RecordingFile::unlock() {
  for (const int lock : locks_) ::close(lock);
  locks_.clear();
  own_ = -1;
}

void RecordingFile::finish() {
  refuseIfReplaced();
  sealFile(own_, file_);
  if (replaces_) {
    // The old log must not be taken for the log of the new file.
    std::vector<std::string> logs = sessionFiles(path_);
    logs.erase(logs.begin());
    removeFiles(logs);
    if (::rename(file_.c_str(), path_.c_str()) != 0)
      throw SessionError(path_ + ": cannot be replaced (" + std::strerror(errno) + "): the new recording is " + file_,
                         SessionErrorKind::failed);
    file_ = path_;
  }
  syncFolderOf(path_);
  unlock();
}

}  // namespace app
