// Lines of a header, and parsing of the words in them: integers, reals, lists, units of length. A word must be a number
// as a whole and fit its type. Headers longer than 1 MB are rejected. Any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/scan/regular_file.h"

namespace assets {

/// Advice for a header that contradicts itself.
inline constexpr const char* kExportAgain = "; export the volume again";

/// Throws LoadError: path and reason.
[[noreturn]] void refuseScan(const std::string& path, const std::string& reason);
[[noreturn]] void refuseSeveralValues(const std::string& path);

class HeaderText {
 public:
  explicit HeaderText(const RegularFile& file);

  /// The next line without its end (LF or CR LF); none at the end of the file. Throws LoadError if the header is longer
  /// than 1 MB.
  std::optional<std::string> line();
  int lineNumber() const { return line_number_; }
  /// Offset of the line after the last one read.
  std::uint64_t nextByte() const { return at_; }

 private:
  const RegularFile& file_;
  std::string text_;
  std::size_t at_ = 0;
  int line_number_ = 0;
};

std::string lowerCase(std::string text);
std::string trimmed(std::string_view text);
/// Split at white space.
std::vector<std::string> wordsOf(std::string_view text);
/// Text from a file for a message: quoted, at most 40 characters, printable ASCII.
std::string printableExcerpt(std::string_view text);

std::optional<std::int64_t> parseInteger(std::string_view word);
/// May be NaN or infinite if written so.
std::optional<double> parseReal(std::string_view word);
/// None unless there are exactly `count`.
std::optional<std::vector<double>> parseReals(std::string_view text, std::size_t count);

/// mm per unit of length, in the usual spellings of mm, m, cm, um; 1 without a unit; none for any other word.
std::optional<double> millimetresPer(const std::string& unit);

}  // namespace assets
