// The chain over a session: every stored row carries SHA-256(digest of the row before · table · every column with its
// type and length). Rows of all tables are numbered in one sequence from 0, so a changed, missing, added or moved row
// breaks the chain at its place. Plain values; any thread; O(bytes of the row).
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

/// The digest of row `number` with these columns (without number and digest), after the row with digest `previous`.
Digest chained(const Digest& previous, std::int64_t number, std::string_view table,
               std::span<const ColumnValue> columns);

}  // namespace app
