// The CT of one study of an imaging server, by either route. Which studies there are is listed on the terminal, with
// date and description there alone: not in a file that standard error goes to, and nowhere else. Main thread; blocks.
#pragma once

#include <optional>
#include <string>

#include "assets/import/dicom/received_files.h"

namespace app {

struct ServerQuestion {
  std::string find;            ///< "PatientID=…"
  std::optional<int> study{};  ///< its number in the list, from 1
};

/// Closed. Throws UsageError or LoadError of one line: no such server, no such study, several of them, no CT.
assets::ReceivedFiles receiveScan(const std::string& source, const ServerQuestion& question);

}  // namespace app
