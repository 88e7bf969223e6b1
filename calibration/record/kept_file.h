// Files that are whole or not there, whatever moment the program is killed at: written under a hidden name, forced to
// the disk, renamed, and the folder forced to the disk as well. Throws CalibrationError with path and remedy. A part of
// rig_store and drift_history; not the servo, for it waits for the disk.
#pragma once

#include <filesystem>
#include <string>

#include "calibration/calibration_error.h"

namespace calibration {

/// With all that is above it.
void makeFolder(const std::filesystem::path& folder);

/// Held while this object lives, and let go when the program dies. Throws where another program holds it.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// What a killed program left in a folder, gone. Only under the folder's lock.
void removeLeftovers(const std::filesystem::path& folder);

/// A file under a hidden name until it is put in place; its destructor removes what was not.
class KeptFile {
 public:
  KeptFile(std::filesystem::path path, const std::string& text);
  ~KeptFile();
  KeptFile(const KeptFile&) = delete;
  KeptFile& operator=(const KeptFile&) = delete;

  const std::filesystem::path& hiddenPath() const { return hidden_path_; }
  void putInPlace();  ///< refused where there is one
  void replace();
  bool isInPlace() const { return hidden_path_.empty(); }

 private:
  std::filesystem::path path_, hidden_path_;
};

/// One line more at the end of a file, whole or not there; a line that a kill has torn is taken away before.
void appendLine(const std::filesystem::path& path, const std::string& line);

}  // namespace calibration
