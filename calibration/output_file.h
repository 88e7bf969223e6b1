// What we write to disk, whole or not at all: built under a temporary name beside the target, renamed onto it at
// commit. A killed or failing program leaves the target as it was; the destructor removes what was not committed.
// Refused with one line (CalibrationError) at construction, before any work: no such parent folder, not writable,
// target there and no leave to replace it, target not a plain file (a device, a folder). What a killed program left
// unfinished goes when the same target is next written, a minute later at the earliest; a folder that it had set aside
// is put back then. Any thread, one thread per object. A few system calls; commit waits until the bytes are on the
// disk. Whoever holds one writes a text by it, or to `temporaryPath()` by any means.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibration_error.h"

namespace calibration {

/// rename(2) that does not replace; a file system without that flag falls back to look-then-rename. The error, or 0.
int renameNoReplace(const std::string& from, const std::string& to);

/// Waits until a file or folder (the working one without a name) is on the disk, as far as can be had. The error, or 0.
int syncToDisk(const std::string& path);

/// The text without the marks of temporary names: for messages of writers, which know no other name.
std::string withoutTemporaryNames(std::string text);

class OutputFile {
 public:
  OutputFile(std::string path, bool overwrite);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }
  /// An empty file in the target's folder, whose name ends as the target's does.
  const std::string& temporaryPath() const { return temporary_path_; }

  /// The text into the temporary file. Throws CalibrationError: no room, or the disk fails.
  void write(const std::string& text);
  /// Puts the file in place. Throws CalibrationError, leaving the target as it was.
  void commit();
  void commit(const std::string& text);
  bool isCommitted() const { return committed_; }

 private:
  std::string path_;
  std::string temporary_path_;
  bool overwrite_;
  bool committed_ = false;
  int claim_ = -1;  ///< locked while this lives: the temporary is not abandoned
};

/// A folder built beside its target. A folder in place is replaced only with `overwrite`, and only if it holds nothing
/// but `contents` (so that --force on the wrong folder destroys nothing); the two are exchanged, so one is always in
/// place. An empty folder in place is filled without asking.
class OutputFolder {
 public:
  OutputFolder(std::string path, bool overwrite, std::vector<std::string> contents);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// An empty folder beside the target.
  const std::string& temporaryPath() const { return temporary_path_; }

  /// Puts the folder in place. Throws CalibrationError, leaving the target as it was.
  void commit();

 private:
  void refuseUnlessReplaceable() const;

  std::string path_;
  std::string temporary_path_;
  std::vector<std::string> contents_;
  bool overwrite_;
  bool committed_ = false;
  int claim_ = -1;  ///< as OutputFile's
};

}  // namespace calibration
