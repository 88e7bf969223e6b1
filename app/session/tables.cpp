#include "app/session/tables.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <sqlite3.h>

#include "app/session/chain.h"
#include "app/session/old_formats/packed_format.h"
#include "app/session/session_format.h"

namespace app {
namespace {

using session_format::createStatement;

constexpr std::size_t kMaxTables = 100;
constexpr const char *kUnknownTable = "it has a table that is not a session table", *kMissingTable = "it lacks a table";

bool isName(std::string_view text) {
  return !text.empty() && text.size() < 64 && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
  });
}

/// "name TYPE, name TYPE, …" and nothing else.
bool isPlainColumns(std::string_view columns) {
  constexpr std::array<std::string_view, 4> kTypes = {"INTEGER", "REAL", "TEXT", "BLOB"};
  while (!columns.empty()) {
    const std::size_t comma = columns.find(", ");
    const std::string_view one = columns.substr(0, comma);
    const std::size_t space = one.find(' ');
    if (space == std::string_view::npos || !isName(one.substr(0, space)) ||
        std::ranges::find(kTypes, one.substr(space + 1)) == kTypes.end())
      return false;
    if (comma == std::string_view::npos) return true;
    columns.remove_prefix(comma + 2);
  }
  return false;
}

/// The columns between row and digest; none: not a session table.
std::optional<std::string> columnsOf(const std::string& name, const std::string& sql) {
  const std::string empty = createStatement(name, "");
  if (!isName(name) || sql.size() <= empty.size()) return std::nullopt;
  const std::string columns = sql.substr(empty.find(", digest"), sql.size() - empty.size());
  return sql == createStatement(name, columns) && isPlainColumns(columns) ? std::optional(columns) : std::nullopt;
}

ColumnValue valueOf(const SQLite::Column& column) {
  switch (column.getType()) {
    case SQLITE_INTEGER:
      return column.getInt64();
    case SQLITE_FLOAT:
      return column.getDouble();
    case SQLITE_TEXT:
      return std::string_view(column.getText(), static_cast<std::size_t>(column.getBytes()));
    case SQLITE_BLOB:
      return blobOf(column);
    default:
      return std::monostate{};
  }
}

/// Walks one table in the order of the chain.
struct Cursor {
  std::string table;
  SQLite::Statement rows;
  bool more;

  Cursor(const SQLite::Database& database, const std::string& name)
      : table(name), rows(database, "SELECT * FROM " + name + " ORDER BY row"), more(rows.executeStep()) {}

  std::int64_t row() const { return rows.getColumn(0).getInt64(); }

  /// Whether the digest of the row follows from the row before; advances `last`.
  bool follows(Digest& last) const {
    std::vector<ColumnValue> values;
    const int digest_column = rows.getColumnCount() - 1;
    std::vector<SQLite::Column> columns;  // keeps text and blobs alive
    for (int i = 1; i < digest_column; ++i) columns.push_back(rows.getColumn(i));
    for (const SQLite::Column& column : columns) values.push_back(valueOf(column));
    last = chained(last, row(), table, values);
    const SQLite::Column digest = rows.getColumn(digest_column);
    return std::ranges::equal(blobOf(digest), last);
  }
};

}  // namespace

std::span<const std::uint8_t> blobOf(const SQLite::Column& column) {
  const auto* bytes = static_cast<const std::uint8_t*>(column.getBlob());
  return {bytes, bytes == nullptr ? 0 : static_cast<std::size_t>(column.getBytes())};
}

std::optional<std::string> tableError(SQLite::Database& database) {
  SQLite::Statement tables(database, "SELECT type, name, sql FROM sqlite_schema ORDER BY rowid");
  std::size_t known = 0, count = 0;
  while (tables.executeStep()) {
    const std::string name = tables.getColumn(1).getString();
    const auto columns = columnsOf(name, tables.getColumn(2).getString());
    if (tables.getColumn(0).getString() != "table" || !columns || ++count > kMaxTables) return kUnknownTable;
    const auto* own = std::ranges::find(session_format::kTables, name, &session_format::Table::name);
    if (own == session_format::kTables.end()) continue;
    // A later program may have appended columns.
    if (!(*columns + ", ").starts_with(std::string(own->columns) + ", "))
      return "its table " + name + " lacks a column";
    ++known;
  }
  return known < session_format::kTables.size() ? std::optional<std::string>(kMissingTable) : std::nullopt;
}

std::optional<std::string> packedTableError(SQLite::Database& database, std::int64_t schema) {
  SQLite::Statement tables(database, "SELECT name, sql FROM sqlite_schema ORDER BY rowid");
  for (const session_format::Table& table : old_formats::packedTables(schema))
    if (!tables.executeStep() || tables.getColumn(1).getString() != createStatement(table.name, table.columns))
      return kMissingTable;
  return tables.executeStep() ? std::optional<std::string>(kUnknownTable) : std::nullopt;
}

std::optional<std::string> chainDamage(SQLite::Database& database) {
  std::vector<std::unique_ptr<Cursor>> cursors;
  SQLite::Statement tables(database, "SELECT name FROM sqlite_schema ORDER BY rowid");
  while (tables.executeStep()) cursors.push_back(std::make_unique<Cursor>(database, tables.getColumn(0).getString()));
  Digest last{};
  for (std::int64_t row = 0;; ++row) {
    const auto next = std::ranges::find_if(cursors, [&](const auto& c) { return c->more && c->row() == row; });
    if (next == cursors.end()) {
      const bool all_read = std::ranges::none_of(cursors, [](const auto& c) { return c->more; });
      if (!all_read) return "row " + std::to_string(row) + " is missing";
      return std::nullopt;
    }
    Cursor& cursor = **next;
    if (!cursor.follows(last)) return "row " + std::to_string(row) + " (" + cursor.table + ") was changed";
    cursor.more = cursor.rows.executeStep();
    if (cursor.table == "seal" && std::ranges::any_of(cursors, [](const auto& c) { return c->more; }))
      return "rows follow its seal";
  }
}

}  // namespace app
