// A folder of records: creation, lock for one writer, removal of leftovers (output_file.h), appending complete lines.
// Throws CalibrationError with path and remedy. Part of rig_store and drift_history; waits for the disk.
#pragma once

#include <filesystem>
#include <string>

#include "calibration/calibration_error.h"

namespace calibration {

/// With its parents.
void makeFolder(const std::filesystem::path& folder);

/// Exclusive lock while this object lives; released when the program dies. Throws if another program holds it.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// Removes what killed programs left. Requires the folder's lock.
void removeLeftovers(const std::filesystem::path& folder);

/// Appends one line completely or not at all; removes an incomplete last line first.
void appendLine(const std::filesystem::path& path, const std::string& line);

}  // namespace calibration
