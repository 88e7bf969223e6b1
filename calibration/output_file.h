// Output files and folders written completely or not at all: built under a temporary name next to the target and
// renamed onto it at commit. A killed or failing program leaves the target unchanged; the destructor removes what was
// not committed. The constructor throws CalibrationError before any work: parent folder missing or not writable, target
// exists without permission to overwrite, target not a regular file. Leftovers of a killed program are removed, and a
// folder it had set aside is restored, when the same target is next written, after at least a minute. Any thread, one
// thread per object. commit() waits until the bytes are on the disk.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibration_error.h"

namespace calibration {

/// rename(2) without replacing; where the file system lacks that flag, check and rename. Returns the error, or 0.
int renameNoReplace(const std::string& from, const std::string& to);

/// fsync of a file or folder (empty: the working folder). Returns the error, or 0.
int syncToDisk(const std::string& path);

/// Removes the prefixes of temporary names, for messages of writers that know only the temporary name.
std::string withoutTemporaryNames(std::string text);

class OutputFile {
 public:
  OutputFile(std::string path, bool overwrite);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }
  /// An empty file in the target's folder, with the target's extension.
  const std::string& temporaryPath() const { return temporary_path_; }

  /// Throws CalibrationError: no space, or a disk error.
  void write(const std::string& text);
  /// Throws CalibrationError, leaving the target as it was.
  void commit();
  void commit(const std::string& text);
  bool isCommitted() const { return committed_; }

 private:
  std::string path_;
  std::string temporary_path_;
  bool overwrite_;
  bool committed_ = false;
  int claim_ = -1;  ///< lock that marks the temporary as in use
};

/// A folder built next to its target. An existing folder is replaced only with `overwrite`, and only if it holds
/// nothing but `contents`, so that --force on the wrong folder destroys nothing; the two are exchanged atomically. An
/// empty existing folder is always replaced.
class OutputFolder {
 public:
  OutputFolder(std::string path, bool overwrite, std::vector<std::string> contents);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// An empty folder next to the target.
  const std::string& temporaryPath() const { return temporary_path_; }

  /// Throws CalibrationError, leaving the target as it was.
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
