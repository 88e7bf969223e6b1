// Tables as CSV (RFC 4180): UTF-8, decimal point, commas, a row of heads, whatever the locale. Quotes, line ends of
// every kind and a byte-order mark are read; what a spreadsheet would take for a formula is written with a leading '.
// Pure; any thread; 10 ns a byte.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace app {

struct CsvRow {
  int line = 0;  ///< in the file, from 1
  std::vector<std::string> cells;
};

struct CsvTable {
  std::string where;  ///< for messages
  std::vector<std::string> heads;
  std::vector<CsvRow> rows;

  /// Throws LoadError with file, line, and column.
  [[noreturn]] void refuse(const CsvRow& row, std::size_t column, const std::string& reason) const;
  /// Of a head that must be there. Throws LoadError.
  std::size_t column(std::string_view head) const;
  bool has(std::string_view head) const;
};

/// Cells are trimmed; empty lines are passed over; every row has a cell for each head. Throws LoadError: not UTF-8, a
/// quote that is not closed, a row of another length, a head twice or empty, more than `kMostRows` rows.
inline constexpr std::size_t kMostCsvRows = 20'000, kMostCsvColumns = 80;
CsvTable csvTableFrom(std::string_view text, std::string where);
/// A file of at most 4 MiB.
CsvTable csvTableOf(const std::string& path);

std::string csvLine(const std::vector<std::string>& cells);

}  // namespace app
