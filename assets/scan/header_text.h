// A header made of lines, and the words in it: whole and real numbers, lists, units of length. Strict: a number is a
// number to its end and fits, or there is none. Headers longer than 1 MB are refused. Any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/scan/regular_file.h"

namespace assets {

/// What to do about a header that contradicts itself.
inline constexpr const char* kExportAgain = "; export the volume again";

/// Throws LoadError: the file, why.
[[noreturn]] void refuseScan(const std::string& path, const std::string& reason);
[[noreturn]] void refuseSeveralValues(const std::string& path);

class HeaderText {
 public:
  explicit HeaderText(const RegularFile& file);

  /// The next line without its end (LF or CR LF); none at the end of the file. Throws LoadError if the header is longer
  /// than 1 MB.
  std::optional<std::string> line();
  int lineNumber() const { return line_number_; }
  /// Where the line after the last one begins.
  std::uint64_t nextByte() const { return at_; }

 private:
  const RegularFile& file_;
  std::string text_;
  std::size_t at_ = 0;
  int line_number_ = 0;
};

std::string lowerCase(std::string text);
std::string trimmed(std::string_view text);
/// Divided at white space.
std::vector<std::string> wordsOf(std::string_view text);
/// What a stranger's file says, fit for a message: at most 40 characters, all of them printable ASCII.
std::string printableExcerpt(std::string_view text);

std::optional<std::int64_t> parseInteger(std::string_view word);
/// May be NaN or infinite if the word says so; none if it does not fit a double.
std::optional<double> parseReal(std::string_view word);
/// None unless there are exactly `count` of them.
std::optional<std::vector<double>> parseReals(std::string_view text, std::size_t count);

/// mm per unit of a length: mm, m, cm, um in their usual spellings; 1 for no unit at all; none for any other word.
std::optional<double> millimetresPer(const std::string& unit);

}  // namespace assets
