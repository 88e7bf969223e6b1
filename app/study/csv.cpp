#include "app/study/csv.h"

#include <algorithm>
#include <cstdint>
#include <set>

#include "assets/load_error.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

constexpr std::size_t kMostBytes = std::size_t{4} << 20;

/// RFC 3629, without overlong forms and surrogates.
bool isUtf8(std::string_view text) {
  for (std::size_t n = 0; n < text.size();) {
    const auto byte = [&](std::size_t at) { return at < text.size() ? static_cast<std::uint8_t>(text[at]) : 0U; };
    const unsigned first = byte(n);
    const std::size_t more = first < 0x80 ? 0 : first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : 1;
    if (first >= 0x80 && (first < 0xc2 || first > 0xf4)) return false;
    for (std::size_t k = 1; k <= more; ++k)
      if ((byte(n + k) & 0xc0) != 0x80) return false;
    const unsigned second = byte(n + 1);
    if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) || (first == 0xf0 && second < 0x90) ||
        (first == 0xf4 && second > 0x8f))
      return false;
    n += more + 1;
  }
  return true;
}

std::string trimmed(const std::string& cell) {
  const std::size_t from = cell.find_first_not_of(" \t"), to = cell.find_last_not_of(" \t");
  return from == std::string::npos ? "" : cell.substr(from, to - from + 1);
}

/// Rows of cells, with the line that each begins on.
class CsvReader {
 public:
  CsvReader(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  std::vector<CsvRow> rows() {
    std::vector<CsvRow> all;
    while (at_ < text_.size()) {
      CsvRow row = next();
      if (row.cells.size() > 1 || !row.cells.front().empty()) all.push_back(std::move(row));
      if (all.size() > kMostCsvRows + 1)
        throw assets::LoadError(where_ + ": it has more than " + std::to_string(kMostCsvRows) + " rows, split it");
    }
    return all;
  }

 private:
  CsvRow next() {
    CsvRow row{line_, {}};
    while (true) {
      row.cells.push_back(cell());
      if (row.cells.size() > kMostCsvColumns)
        throw assets::LoadError(where_ + " line " + std::to_string(row.line) + ": it has more than " +
                                std::to_string(kMostCsvColumns) + " cells, separate them by commas");
      if (at_ >= text_.size()) return row;
      const char end = text_[at_++];
      if (end == ',') continue;
      if (end == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
      ++line_;
      return row;
    }
  }

  std::string cell() {
    std::size_t from = at_;
    while (from < text_.size() && (text_[from] == ' ' || text_[from] == '\t')) ++from;
    if (from < text_.size() && text_[from] == '"') {
      at_ = from + 1;
      return quoted();
    }
    const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
    const std::string plain(text_.substr(at_, end - at_));
    at_ = end;
    return trimmed(plain);
  }

  std::string quoted() {
    const int begun = line_;
    std::string words;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') {
        if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') {
          ++at_;
          while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
          if (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\r' && text_[at_] != '\n') refuseQuote(begun);
          return trimmed(words);
        }
        ++at_;
      }
      if (text_[at_] == '\n') ++line_;
      words += text_[at_];
    }
    refuseQuote(begun);
  }

  [[noreturn]] void refuseQuote(int line) const {
    throw assets::LoadError(where_ + " line " + std::to_string(line) +
                            ": a quoted cell does not end where the cell ends, write \"\" for a quote within it");
  }

  std::string_view text_;
  const std::string& where_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

void CsvTable::refuse(const CsvRow& row, std::size_t column, const std::string& reason) const {
  throw assets::LoadError(where + " line " + std::to_string(row.line) + ", " + heads[column] + ": " + reason);
}

bool CsvTable::has(std::string_view head) const { return std::ranges::find(heads, head) != heads.end(); }

std::size_t CsvTable::column(std::string_view head) const {
  const auto found = std::ranges::find(heads, head);
  if (found == heads.end())
    throw assets::LoadError(where + " line 1: there is no column \"" + std::string(head) + "\", add it");
  return static_cast<std::size_t>(found - heads.begin());
}

CsvTable csvTableFrom(std::string_view text, std::string where) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  if (!isUtf8(text) || text.find('\0') != std::string_view::npos)
    throw assets::LoadError(where + ": it is no UTF-8 text, save it as CSV UTF-8");
  std::vector<CsvRow> rows = CsvReader(text, where).rows();
  if (rows.empty()) throw assets::LoadError(where + ": it is empty, give a row of heads");
  CsvTable table{std::move(where), std::move(rows.front().cells), {}};
  std::set<std::string> known;
  constexpr std::size_t kLongestHead = 60;
  for (const std::string& head : table.heads) {
    const bool is_plain = std::ranges::none_of(head, [](char c) { return static_cast<unsigned char>(c) < ' '; });
    if (head.empty() || head.size() > kLongestHead || !is_plain)
      throw assets::LoadError(table.where + " line 1: a column has no head, or one that is no short word");
    if (!known.insert(head).second)
      throw assets::LoadError(table.where + " line 1: the head \"" + head + "\" is there twice");
  }
  for (std::size_t n = 1; n < rows.size(); ++n) {
    if (rows[n].cells.size() != table.heads.size())
      throw assets::LoadError(table.where + " line " + std::to_string(rows[n].line) + ": it has " +
                              std::to_string(rows[n].cells.size()) + (rows[n].cells.size() == 1 ? " cell" : " cells") +
                              ", the heads are " + std::to_string(table.heads.size()));
    table.rows.push_back(std::move(rows[n]));
  }
  return table;
}

CsvTable csvTableOf(const std::string& path) { return csvTableFrom(assets::readSmallFile(path, kMostBytes), path); }

std::string csvLine(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    std::string cell = cells[n];
    const bool is_number = !cell.empty() && cell.find_first_not_of("0123456789.eE+-") == std::string::npos;
    if (!cell.empty() && !is_number && std::string_view("=+-@").find(cell.front()) != std::string_view::npos)
      cell.insert(0, 1, '\'');
    if (cell.find_first_of(",\"\r\n") != std::string::npos) {
      std::string doubled;
      for (const char letter : cell) doubled += letter == '"' ? "\"\"" : std::string(1, letter);
      cell = '"' + doubled + '"';
    }
    line += (n == 0 ? "" : ",") + cell;
  }
  return line + "\n";
}

}  // namespace app
