// What is kept of a session: its events, in memory until the participant allows the log, then in its folder of the
// study; tables made anew from them. Main thread; add() as session_log's.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/evaluation/study_template.h"
#include "app/study/privacy/session_seal.h"
#include "app/study/session_log.h"
#include "app/study/study_folder.h"

namespace app {

class SessionBook {
 public:
  /// The next session of this participant in the study's folder, which need not be there yet.
  SessionBook(std::string study_folder, const std::string& participant);

  const StudySession& place() const { return place_; }
  std::string folder() const;
  std::string recording() const;

  void keep(const LogEvent& event);
  const std::vector<LogEvent>& events() const { return events_; }
  /// The first so many events will survive what happens to this machine: they are on the disk, or nothing may be
  /// written yet.
  bool isSafe(std::size_t events) const;

  /// Makes the folder, writes what was kept until now, and the template byte for byte. Throws UsageError.
  void open(const std::string& template_text);
  /// Why the log is not written any more; none: it is.
  std::optional<std::string> trouble() const { return log_ ? log_->trouble() : std::nullopt; }
  /// The study has keys: what people say stands sealed in the folder.
  bool isSealed() const { return seal_.has_value(); }
  /// For sound; null: the study has no keys.
  SessionSeal* seal() { return seal_ ? &*seal_ : nullptr; }
  /// Over those that are there; of a sealed session those without words.
  void writeTables(const StudyTemplate& study) const;

 private:
  void write(std::size_t row);

  std::string study_folder_;
  StudySession place_;
  std::vector<LogEvent> events_;
  std::optional<SessionLogWriter> log_;
  std::optional<SessionSeal> seal_;  ///< none: the study has no keys
  bool has_told_trouble_ = false;
};

}  // namespace app
