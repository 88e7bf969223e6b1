// Where a recording lies while it is made, and when it gets its name. It is begun beside it, as NAME.new; where nothing
// stands under the name it takes it with its first ticks, so a program killed before leaves nothing there; where
// something is to be replaced it takes it once it is closed, so the old one is lost to nothing but a whole new one.
// Locked (flock) from first to last, and what it will replace too: no second program records to the same name, asked
// to overwrite or not. A NAME.new that a killed program left is kept if it holds ticks, and the next is NAME.new2.
// One thread; a few file operations a call.
#pragma once

#include <string>
#include <vector>

namespace app {

class RecordingPlace {
 public:
  /// Makes the empty file. Throws SessionError if the name can not be used, stands and not `overwrite`, or is being
  /// recorded.
  RecordingPlace(std::string path, bool overwrite);
  ~RecordingPlace();
  RecordingPlace(const RecordingPlace&) = delete;
  RecordingPlace& operator=(const RecordingPlace&) = delete;

  /// The file as it is called now.
  const std::string& file() const { return file_; }

  /// From here on it is worth keeping; not while a database is open on it. Throws SessionError if somebody else has
  /// taken the name meanwhile.
  void takeName();
  /// Closed and whole: replaces what stood there, and is anybody's to read.
  void finish();

 private:
  void refuseUnlessFree(bool overwrite);
  void claimBeside();
  void letGo();

  std::string path_, file_;
  std::vector<int> locks_;
  bool replaces_ = false, kept_ = false;
};

/// Whether a program is recording to this file now.
bool isBeingRecorded(const std::string& path);

/// The file, its log and what else SQLite may leave beside it.
std::vector<std::string> filesOf(const std::string& path);

}  // namespace app
