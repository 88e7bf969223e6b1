// Reads sessions of schemas 3 and 4: bone, ticks and commands as packed structs, members in the order of the struct.
// Schema 3 has no calibration. One thread.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "app/session/session_format.h"
#include "app/session/session_text.h"
#include "app/session/session_writer.h"
#include "app/session/tick_columns.h"

namespace SQLite {
class Database;
}

namespace app::old_formats {

using session_format::Table;

/// The tables of a session of this schema, in the order of the file.
std::span<const Table> packedTables(std::int64_t schema);

/// The columns of its ticks, stored in planes as in schema 5.
const std::vector<TickColumn>& packedTickColumns();

/// This program's label for each stored label.
LabelTable packedLabels();

/// The start without voxels.
StoredStart packedAbout(SQLite::Database& database, std::int64_t schema);
/// Adds the voxels, labels as stored.
void readPackedBone(SQLite::Database& database, StoredStart& about);
std::vector<SessionCommand> packedCommands(SQLite::Database& database);

}  // namespace app::old_formats
