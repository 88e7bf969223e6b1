// The file name and lock of a recording. It starts as NAME.new. If NAME is free, the file takes that name once its
// first ticks are in it; if NAME exists, it is replaced when the recording is closed, so only a complete recording
// replaces another. Both files are locked (flock) from first to last, so two programs never record to one name. A
// NAME.new left by a kill is kept if it holds ticks; the next is NAME.new2. One thread; a few file operations per call.
#pragma once

#include <string>
#include <vector>

namespace app {

class RecordingFile {
 public:
  /// Creates the empty file. Throws SessionError if the name cannot be used, exists and not `overwrite`, or is being
  /// recorded.
  RecordingFile(std::string path, bool overwrite);
  ~RecordingFile();
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;

  /// The current name.
  const std::string& file() const { return file_; }
  /// Whether an existing file is to be replaced at the close.
  bool replaces() const { return replaces_; }

  /// The file holds ticks and is kept from here on; it takes a free name. No database may be open on it. Throws
  /// SessionError if another program has taken the name.
  void publish();
  /// Throws SessionError if the file of that name is no longer this one.
  void refuseIfReplaced() const;
  /// After the database is closed: seals the file, replaces the existing one and unlocks.
  void finish();

 private:
  void lockTarget(bool overwrite);
  void createTemporary();
  void unlock();

  std::string path_, file_;
  std::vector<int> locks_;
  int own_ = -1;  ///< the one of the file
  bool replaces_ = false, kept_ = false;
};

/// The target of a symbolic link, next to which its log is.
std::string resolvedLinks(const std::string& path);

/// Whether a program is recording to this file.
bool isBeingRecorded(const std::string& path);

/// The file, its log and other files SQLite may leave next to it.
std::vector<std::string> sessionFiles(const std::string& path);

}  // namespace app
