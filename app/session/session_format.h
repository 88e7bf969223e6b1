// What a session file is: one SQLite database, readable by any SQLite tool, with the tables below and, once closed, a
// trailer of 40 bytes behind the last page: "MOLRSEAL" and the SHA-256 of every byte before it.
// `row` numbers the rows of all tables in one sequence from 0; `digest` chains them (chain.h). Ticks: packing.h, then
// Zstandard. Shared by writer and reader only.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace app::session_format {

/// 2: torque, energy, spindle, all tools and laws. 3: what the safety layer goes by, so that a replay trips alike; undo
/// and irrigation. 4: the calibration; 3 is still read, which lacks that table alone.
inline constexpr std::int64_t kSchema = 4, kOldestSchema = 3;
inline constexpr std::int64_t kApplicationId = 0x4d4f4c52;    ///< in the database header, big-endian …
inline constexpr std::string_view kApplicationMark = "MOLR";  ///< … so that it reads like this
inline constexpr std::size_t kTicksPerBlock = 50;             ///< 50 ms at 1 kHz: written and committed together
inline constexpr std::string_view kTrailerMark = "MOLRSEAL";
inline constexpr std::size_t kTrailerBytes = kTrailerMark.size() + 32;

struct Table {
  std::string_view name, create;
};

inline constexpr std::array<Table, 8> kTables = {{
    {"meta",
     "CREATE TABLE meta(row INTEGER PRIMARY KEY, schema INTEGER, program TEXT, patient TEXT, dt_s REAL, digest BLOB) "
     "STRICT"},
    {"bone",
     "CREATE TABLE bone(row INTEGER PRIMARY KEY, size_i INTEGER, size_j INTEGER, size_k INTEGER, spacing_mm REAL, "
     "origin_x_P_mm REAL, origin_y_P_mm REAL, origin_z_P_mm REAL, solid BLOB, label BLOB, digest BLOB) STRICT"},
    {"command",
     "CREATE TABLE command(row INTEGER PRIMARY KEY, serial INTEGER, first_tick INTEGER, bytes BLOB, digest BLOB) "
     "STRICT"},
    {"tick_block",
     "CREATE TABLE tick_block(row INTEGER PRIMARY KEY, first_tick INTEGER, count INTEGER, ticks BLOB, digest BLOB) "
     "STRICT"},
    {"event", "CREATE TABLE event(row INTEGER PRIMARY KEY, tick INTEGER, kind TEXT, text TEXT, digest BLOB) STRICT"},
    {"picture",
     "CREATE TABLE picture(row INTEGER PRIMARY KEY, tick INTEGER, name TEXT, bytes BLOB, digest BLOB) STRICT"},
    {"seal", "CREATE TABLE seal(row INTEGER PRIMARY KEY, ticks INTEGER, lost INTEGER, digest BLOB) STRICT"},
    {"calibration",
     "CREATE TABLE calibration(row INTEGER PRIMARY KEY, rig TEXT, rig_id TEXT, device_serial TEXT, verdict TEXT, "
     "touches INTEGER, rms_mm REAL, p95_mm REAL, max_mm REAL, checked_utc TEXT, age_days REAL, despite TEXT, digest "
     "BLOB) STRICT"},
}};

/// Those of a session of this schema.
inline std::span<const Table> tablesOf(std::int64_t schema) {
  return std::span(kTables).first(schema < 4 ? kTables.size() - 1 : kTables.size());
}

}  // namespace app::session_format
