// Where a recording lies while it is made, and when it gets its name. It is begun beside it, as NAME.new; where nothing
// stands under the name it takes it once its first ticks are in it, so what a killed program leaves there holds ticks;
// where something is to be replaced it takes it once it is closed, so the old one is lost to nothing but a whole new
// one. Locked (flock) from first to last, and what it will replace too: no second program records to the same name,
// asked to overwrite or not. A NAME.new that a killed program left is kept if it holds ticks, and the next is
// NAME.new2. One thread; a few file operations a call.
#pragma once

#include <string>
#include <vector>

namespace app {

class RecordingFile {
 public:
  /// Makes the empty file. Throws SessionError if the name can not be used, stands and not `overwrite`, or is being
  /// recorded.
  RecordingFile(std::string path, bool overwrite);
  ~RecordingFile();
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;

  /// The file as it is called now.
  const std::string& file() const { return file_; }
  /// Whether something stands under the name until the end.
  bool replaces() const { return replaces_; }

  /// It holds ticks from here on and is kept; not while a database is open on it. Throws SessionError if somebody else
  /// has taken the name meanwhile.
  void publish();
  /// Throws SessionError if the file of that name is not the one that was begun any more.
  void refuseIfReplaced() const;
  /// Once the database is closed: seals the file, lets it replace what stood there, and it is anybody's to read.
  void finish();

 private:
  void lockTarget(bool overwrite);
  void createTemporary();
  void unlock();

  std::string path_, file_;
  std::vector<int> locks_;
  int own_ = -1;  ///< of them, that of the file
  bool replaces_ = false, kept_ = false;
};

/// Through links to what they stand for, beside which its log lies.
std::string resolvedLinks(const std::string& path);

/// Whether a program is recording to this file now.
bool isBeingRecorded(const std::string& path);

/// The file, its log and what else SQLite may leave beside it.
std::vector<std::string> sessionFiles(const std::string& path);

}  // namespace app
