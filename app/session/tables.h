// The tables of a session file as a stranger may have made them: judged before a row is read, and walked in the order
// of the chain. Reading only; one thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace SQLite {
class Database;
}

namespace app {

/// One line on the first table that is not of the form of schema 5, or lacks what a session needs; plain tables of
/// rows alone, with no expression that reading would run.
std::optional<std::string> tableError(SQLite::Database& database);

/// The same of schemas 3 and 4, which have exactly their tables.
std::optional<std::string> packedTableError(SQLite::Database& database, std::int64_t schema);

/// One line on the first row whose digest does not follow from the row before. Reads them all.
std::optional<std::string> chainDamage(SQLite::Database& database);

}  // namespace app
