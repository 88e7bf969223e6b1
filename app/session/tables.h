// Validates the tables of an untrusted session file before a row is read, and follows the checksum chain over all rows.
// Read only; one thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace SQLite {
class Column;
class Database;
}  // namespace SQLite

namespace app {

/// The bytes of a column, valid while the column and its row are; empty for NULL.
std::span<const std::uint8_t> blobOf(const SQLite::Column& column);

/// One line on the first table that is not of schema 5's form, or on a missing one. Only plain tables are accepted:
/// nothing that SQLite would evaluate on reading.
std::optional<std::string> tableError(SQLite::Database& database);

/// The same for schemas 3 and 4, which have a fixed set of tables.
std::optional<std::string> packedTableError(SQLite::Database& database, std::int64_t schema);

/// One line on the first row whose digest does not follow from the row before. Reads all rows.
std::optional<std::string> chainDamage(SQLite::Database& database);

}  // namespace app
