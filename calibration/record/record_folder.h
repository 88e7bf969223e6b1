// A folder of records: made, held by one writer at a time, cleared of what a killed one left (output_file.h), and a
// file that grows by whole lines. Throws CalibrationError with path and remedy. A part of rig_store and drift_history;
// not the servo, for it waits for the disk.
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

/// One line more at the end of a file, whole or not there; a line that a kill has torn is taken away before.
void appendLine(const std::filesystem::path& path, const std::string& line);

}  // namespace calibration
