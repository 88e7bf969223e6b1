// The event log of an evaluation session: JSON lines {"seq", "t_ns", "tick", "src", "type", "data", "digest"}, one
// clock (steady, ns), each line's digest SHA-256 of the digest before and the line without it. A line is in the
// kernel's hands when add() returns, so a killed program loses none; a thread brings them to the disk every 100 ms, so
// a power cut loses no more. What was cut off in writing is left out by the reader. No names of people: codes alone.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace app {

using LogValue = std::variant<bool, std::int64_t, double, std::string>;

struct LogEvent {
  std::int64_t t_ns = 0;
  std::optional<std::uint64_t> tick;  ///< none: the servo was not running
  std::string source;                 ///< participant, evaluator, system, device
  std::string type;                   ///< "task.start", "note", …
  std::vector<std::pair<std::string, LogValue>> data;

  /// Null: there is none of that kind.
  const std::string* text(std::string_view key) const;
  /// Empty where there is none.
  std::string textOr(std::string_view key) const;
  std::optional<double> number(std::string_view key) const;
  std::optional<bool> flag(std::string_view key) const;
};

inline constexpr char kSessionLogName[] = "events.jsonl";

class SessionLogWriter {
 public:
  /// Throws CalibrationError: the file exists or cannot be made.
  explicit SessionLogWriter(const std::string& path);
  ~SessionLogWriter();

  /// In the order of the calls: a note that was begun before a rule fired and ended after it stands after it, with its
  /// own time. Once the disk refuses, nothing more is written, and trouble() has one line.
  void add(const LogEvent& event);
  std::optional<std::string> trouble() const;
  /// So many of those that were added are on the disk, not only in the kernel's hands: 100 ms later, where it is fast.
  std::uint64_t onDisk() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

struct SessionLog {
  std::vector<LogEvent> events;
  std::optional<std::string> damage;  ///< one line: where the chain breaks; what stands before is in `events`
  bool is_closed = false;             ///< its last event is session.stop
  std::string digest;                 ///< of the last whole line; empty: there is none
};

/// Throws LoadError: no such file, or larger than 64 MiB.
SessionLog readSessionLog(const std::string& path);

/// One more line of a log that is not open, or of none yet, on the disk when it returns. One program at a time: the
/// others wait. Throws LoadError: the chain is broken; CalibrationError: it cannot be written.
void appendToLog(const std::string& path, const LogEvent& event);

}  // namespace app
