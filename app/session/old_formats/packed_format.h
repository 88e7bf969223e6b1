// Sessions of schemas 3 and 4, as the programs before wrote them: bone, ticks and commands as packed structs, each
// member in the order of its struct. Schema 3 lacks the calibration alone. Reading only; one thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "app/session/session_text.h"
#include "app/session/session_writer.h"
#include "app/session/tick_columns.h"

namespace SQLite {
class Database;
}

namespace app::old_formats {

struct Table {
  std::string_view name, create;
};

/// Of a session of this schema, in the order of the file.
std::span<const Table> packedTables(std::int64_t schema);

/// The members of its ticks, with the planes where schema 5 has them too.
const std::vector<TickColumn>& packedTickColumns();

/// Own label by stored label.
LabelTable packedLabels();

/// Without voxels.
StoredStart packedAbout(SQLite::Database& database, std::int64_t schema);
/// Adds them, labels as stored.
void readPackedBone(SQLite::Database& database, StoredStart& about);
std::vector<SessionCommand> packedCommands(SQLite::Database& database);

}  // namespace app::old_formats
