// The CSV of an experiment, one row per trial, on the disk before the next trial begins, so a crash loses no answered
// trial. Numbers in their shortest exact form. One thread; a row waits for the disk (milliseconds).
#pragma once

#include <string>

#include "app/psychophysics/experiment.h"

namespace app {

class TrialTable {
 public:
  /// Throws UsageError if the file exists, unless `overwrite`, which deletes the old rows at once.
  TrialTable(const std::string& path, bool overwrite, const Protocol& protocol);
  ~TrialTable();
  TrialTable(const TrialTable&) = delete;
  TrialTable& operator=(const TrialTable&) = delete;

  void add(const TrialRecord& record);

 private:
  void write(const std::string& line);

  std::string path_, participant_, method_, parameter_, unit_, standard_law_, comparison_law_;
  int file_ = -1;
};

/// Name of the motion in a protocol.
std::string methodName(Method method);

}  // namespace app
