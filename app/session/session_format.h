// What a session file is: one SQLite database, readable by any SQLite tool, with the tables below and, once closed, a
// trailer of 40 bytes behind the last page: "MOLRSEAL" and the SHA-256 of every byte before it.
// `row` numbers the rows of all tables in one sequence from 0; `digest` chains them (chain.h). Texts are JSON objects
// (session_text.h, command_keys.h); blobs are Zstandard. A table may gain columns before `digest`, and there may be
// more tables of this form: the chain holds them too, and a reader takes what it knows. Writer and readers only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace app::session_format {

/// 5: by keys and columns. 3 and 4, read by old_formats/: packed structs.
inline constexpr std::int64_t kSchema = 5, kOldestSchema = 3;
inline constexpr std::int64_t kApplicationId = 0x4d4f4c52;    ///< in the database header, big-endian …
inline constexpr std::string_view kApplicationMark = "MOLR";  ///< … so that it reads like this
inline constexpr std::size_t kTicksPerBlock = 50;             ///< 50 ms at 1 kHz: written and committed together
inline constexpr std::size_t kBonePartBytes = 1 << 24;        ///< voxels a row: far below what a row may hold
inline constexpr std::string_view kTrailerMark = "MOLRSEAL";
inline constexpr std::size_t kTrailerBytes = kTrailerMark.size() + 32;

/// Volumes, part by part in the order of the grid. The last is what has gone: the start's less the end's.
inline constexpr std::string_view kSolid = "solid", kLabel = "label", kRemoved = "gone";

struct Table {
  std::string_view name, columns;  ///< between `row` and `digest`
};

inline constexpr std::array<Table, 7> kTables = {{
    {"meta", "schema INTEGER, about TEXT"},
    {"tick_column", "name TEXT, type TEXT, unit TEXT, frame TEXT, meaning TEXT"},
    {"bone_part", "volume TEXT, first_voxel INTEGER, voxels INTEGER, bytes BLOB"},
    {"command", "serial INTEGER, first_tick INTEGER, command TEXT"},
    {"tick_block", "first_tick INTEGER, count INTEGER, removed_mm3 TEXT, ticks BLOB"},
    {"event", "tick INTEGER, kind TEXT, text TEXT"},
    {"seal", "about TEXT"},
}};

}  // namespace app::session_format
