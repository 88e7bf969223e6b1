// The checksum chain of a session: every row stores SHA-256(digest of the row before, table, every column with type and
// length). Rows of all tables are numbered in one sequence from 0, so a changed, missing, added or moved row breaks the
// chain there. Plain values; any thread; O(bytes of the row).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "calibration/record/sha256.h"

namespace app {

using calibration::Digest;
using calibration::Sha256;

/// A column's value as SQLite stores it.
using ColumnValue = std::variant<std::monostate, std::int64_t, double, std::string_view, std::span<const std::uint8_t>>;

/// The digest of row `number` after the row with digest `previous`; `columns` without number and digest.
Digest chained(const Digest& previous, std::int64_t number, std::string_view table,
               std::span<const ColumnValue> columns);

}  // namespace app
