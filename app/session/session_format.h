// A session file: one SQLite database with the tables below. A closed file ends with a trailer of 40 bytes behind the
// last page: "MOLRSEAL" and the SHA-256 of all bytes before it. `row` numbers the rows of all tables in one sequence
// from 0; `digest` chains them (chain.h). Texts are JSON objects (session_text.h, command_keys.h); blobs are Zstandard.
// Columns may be added before `digest`, and tables of this form may be added: the chain covers them, readers ignore
// them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace app::session_format {

/// 5: keys and columns. 3 and 4, read by old_formats/: packed structs.
inline constexpr std::int64_t kSchema = 5, kOldestSchema = 3;
inline constexpr std::int64_t kApplicationId = 0x4d4f4c52;    ///< in the database header, big-endian: "MOLR"
inline constexpr std::string_view kApplicationMark = "MOLR";  ///< the same as text
inline constexpr std::size_t kTicksPerBlock = 50;             ///< 50 ms at 1 kHz: written and committed together
inline constexpr std::size_t kBonePartBytes = 1 << 24;        ///< voxels per row, far below SQLite's limit
inline constexpr std::string_view kTrailerMark = "MOLRSEAL";
inline constexpr std::size_t kTrailerBytes = kTrailerMark.size() + 32;

/// Volumes, stored in parts in the order of the grid. The last is the removed part: initial minus final solid fraction.
inline constexpr std::string_view kSolid = "solid", kLabel = "label", kRemoved = "gone";
/// Optional: 1 in the voxels of the tooth to be removed, a body of its own (haptics/body/bodies).
inline constexpr std::string_view kIsTooth = "tooth";
/// Optional: the solid before what was cut already at the start.
inline constexpr std::string_view kWhole = "whole";
/// Optional, at the end: what was laid into a tooth, its tissue, its increment, its light (low, then high bytes of
/// units of haptics::Filling::kLightUnit_s; not stored: none has any).
struct LaidNames {
  std::string_view laid, tissue, increment, light;
};
inline constexpr LaidNames kLaid{"laid", "laid_tissue", "laid_increment", "laid_light"};
/// The same at the start, where something was laid before.
inline constexpr LaidNames kLaidBefore{"laid_before", "laid_before_tissue", "laid_before_increment",
                                       "laid_before_light"};
/// Optional: FDI number of the tooth of each voxel.
inline constexpr std::string_view kTeeth = "teeth";
/// Optional: what is to be left of a prepared tooth, as a file gave it, on its own grid (key prepared of `about`).
inline constexpr std::string_view kIdeal = "ideal";
/// Optional: heights of what opposes a prepared tooth (assets/opposing_teeth.h), the four bytes of their floats, least
/// first, one after the other for all of them.
inline constexpr std::string_view kOpposing = "opposing";
/// Soft tissue, on its own grid (key soft_tissue_grid of `about`): low, then high bytes of the distances; tissues.
inline constexpr std::string_view kSoftDistance = "soft_distance", kSoftTissue = "soft_tissue";

struct Table {
  std::string_view name, columns;  ///< between `row` and `digest`
};

inline std::string createStatement(std::string_view table, std::string_view columns) {
  return "CREATE TABLE " + std::string(table) + "(row INTEGER PRIMARY KEY, " + std::string(columns) +
         ", digest BLOB) STRICT";
}

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
