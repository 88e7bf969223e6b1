#include "app/session/session_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <sqlite3.h>

#include "app/session/chain.h"
#include "app/session/compressed.h"
#include "app/session/file_seal.h"
#include "app/session/packing.h"
#include "app/session/session_error.h"
#include "app/session/session_format.h"

namespace app {
namespace {

using session_format::kTables;

/// A file without log beside it is opened as what can not change, so that nothing is written next to it.
std::string address(const std::string& path) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c == '?' || c == '#' || c == '%') {
      static constexpr char kHex[] = "0123456789abcdef";
      uri += {'%', kHex[static_cast<unsigned char>(c) >> 4], kHex[c & 15]};
    } else {
      uri += c;
    }
  }
  const bool has_log = std::filesystem::exists(path + "-wal");
  return uri + (has_log ? "" : "?immutable=1");
}

std::span<const std::uint8_t> blobOf(const SQLite::Column& column) {
  const auto* bytes = static_cast<const std::uint8_t*>(column.getBlob());
  return {bytes, bytes == nullptr ? 0 : static_cast<std::size_t>(column.getBytes())};
}

std::string textOf(const SQLite::Column& column) { return column.getString(); }

std::uint64_t countOf(const SQLite::Column& column) { return static_cast<std::uint64_t>(column.getInt64()); }

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
  std::string_view table;
  SQLite::Statement rows;
  bool more;

  Cursor(const SQLite::Database& database, std::string_view name)
      : table(name), rows(database, "SELECT * FROM " + std::string(name) + " ORDER BY row"), more(rows.executeStep()) {}

  std::int64_t row() const { return rows.getColumn(0).getInt64(); }

  /// Whether the row carries the digest that follows from the row before; moves `last` on.
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

struct SessionReader::Impl {
  std::string path;
  SQLite::Database database;
  std::optional<SQLite::Statement> blocks;
  std::int64_t schema = 0;
  bool closed = false;
  std::uint64_t lost = 0, ticks = 0;

  explicit Impl(const std::string& file)
      : path(file), database(address(file), SQLite::OPEN_READONLY | SQLite::OPEN_URI) {
    database.exec("PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON;");
    checkSchema();
    SQLite::Statement seal(database, "SELECT ticks, lost FROM seal");
    closed = seal.executeStep();
    if (closed) ticks = countOf(seal.getColumn(0)), lost = countOf(seal.getColumn(1));
    blocks.emplace(database, "SELECT count, ticks FROM tick_block ORDER BY row");
  }

  void checkSchema() {
    // The newest has one table more than those before.
    const auto tables_there = database.execAndGet("SELECT count(*) FROM sqlite_schema").getInt64();
    const auto told = session_format::tablesOf(tables_there < static_cast<std::int64_t>(kTables.size())
                                                   ? session_format::kOldestSchema
                                                   : session_format::kSchema);
    SQLite::Statement tables(database, "SELECT name, sql FROM sqlite_schema ORDER BY rowid");
    bool same = database.execAndGet("PRAGMA application_id").getInt64() == session_format::kApplicationId;
    for (const session_format::Table& table : told) {
      same = same && tables.executeStep() && tables.getColumn(0).getString() == table.name &&
             tables.getColumn(1).getString() == table.create;
    }
    if (!same || tables.executeStep()) {
      throw SessionError(path + ": is no session of this version of the program: name a file made by `molar rehearse`");
    }
    SQLite::Statement meta(database, "SELECT schema FROM meta");
    if (meta.executeStep()) schema = meta.getColumn(0).getInt64();
    const bool known = schema >= session_format::kOldestSchema && schema <= session_format::kSchema;
    if (!known || session_format::tablesOf(schema).size() != told.size()) {
      throw SessionError(path + ": has a schema this program does not know: use the version that recorded it");
    }
  }

  std::optional<std::string> chainDamage() {
    std::vector<std::unique_ptr<Cursor>> cursors;
    for (const session_format::Table& table : session_format::tablesOf(schema))
      cursors.push_back(std::make_unique<Cursor>(database, table.name));
    Digest last{};
    for (std::int64_t row = 0;; ++row) {
      const auto next = std::ranges::find_if(cursors, [&](const auto& c) { return c->more && c->row() == row; });
      if (next == cursors.end()) {
        const bool all_read = std::ranges::none_of(cursors, [](const auto& c) { return c->more; });
        if (!all_read) return "row " + std::to_string(row) + " is missing";
        return std::nullopt;
      }
      Cursor& cursor = **next;
      if (!cursor.follows(last))
        return "row " + std::to_string(row) + " (" + std::string(cursor.table) + ") was changed";
      cursor.more = cursor.rows.executeStep();
      if (cursor.table == "seal" && std::ranges::any_of(cursors, [](const auto& c) { return c->more; })) {
        return "rows follow its seal";
      }
    }
  }

  SessionCalibration calibration() {
    SQLite::Statement row(database,
                          "SELECT rig, rig_id, device_serial, verdict, touches, rms_mm, p95_mm, max_mm, checked_utc, "
                          "age_days, despite FROM calibration");
    if (!row.executeStep()) throw SessionError("it has no calibration: the session is damaged");
    SessionCalibration c;
    c.rig = textOf(row.getColumn(0));
    c.rig_id = textOf(row.getColumn(1));
    c.device_serial = textOf(row.getColumn(2));
    c.verdict = textOf(row.getColumn(3));
    c.touches = row.getColumn(4).getInt();
    c.rms_mm = row.getColumn(5).getDouble();
    c.p95_mm = row.getColumn(6).getDouble();
    c.max_mm = row.getColumn(7).getDouble();
    c.checked_utc = textOf(row.getColumn(8));
    if (!row.getColumn(9).isNull()) c.age_days = row.getColumn(9).getDouble();
    c.despite = textOf(row.getColumn(10));
    return c;
  }

  /// Does `work`, telling trouble with the database as one line about this file.
  template <class Work>
  auto reading(Work&& work) {
    try {
      return work();
    } catch (const SQLite::Exception& trouble) {
      throw SessionError(path + ": can not be read (" + trouble.what() + "): the session is damaged");
    } catch (const SessionError& trouble) {
      throw SessionError(path + ": " + trouble.what());
    }
  }
};

SessionReader::SessionReader(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) {
    throw SessionError(path + ": there is no such session file: check the name");
  }
  try {
    impl_ = std::make_unique<Impl>(path);
  } catch (const SQLite::Exception& trouble) {
    throw SessionError(path + ": is no readable session (" + trouble.what() +
                       "): name a file made by `molar rehearse`");
  }
}

SessionReader::~SessionReader() = default;

bool SessionReader::closed() const { return impl_->closed; }
std::uint64_t SessionReader::lost() const { return impl_->lost; }

std::optional<std::string> SessionReader::damage() {
  try {
    if (auto damaged = impl_->chainDamage()) return damaged;
  } catch (const SQLite::Exception& trouble) {
    return std::string("its rows can not be read (") + trouble.what() + ")";
  }
  const FileSeal seal = fileSeal(impl_->path);
  if (seal == FileSeal::broken) return "a byte outside its rows was changed, or its end was cut off";
  if (seal == FileSeal::none && impl_->closed) return "it was closed, but its seal was cut off";
  return std::nullopt;
}

StoredStart SessionReader::start() {
  return impl_->reading([&] {
    StoredStart start;
    SQLite::Statement meta(impl_->database, "SELECT program, patient, dt_s FROM meta");
    SQLite::Statement bone(impl_->database, "SELECT * FROM bone");
    if (!meta.executeStep() || !bone.executeStep()) throw SessionError("it has no start: the session is damaged");
    start.program_version = textOf(meta.getColumn(0));
    start.patient_title = textOf(meta.getColumn(1));
    start.dt_s = meta.getColumn(2).getDouble();

    // The grid decides how much is allocated, so it is judged first.
    constexpr std::int64_t kMostVoxelsPerAxis = 4096;
    constexpr std::size_t kMostVoxels = std::size_t{1} << 31;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t voxels = bone.getColumn(1 + axis).getInt64();
      if (voxels < 1 || voxels > kMostVoxelsPerAxis) throw SessionError("its bone has no size: the session is damaged");
      start.grid.size[axis] = static_cast<int>(voxels);
      start.grid.origin_P_mm[axis] = bone.getColumn(5 + axis).getDouble();
    }
    start.grid.spacing_mm = bone.getColumn(4).getDouble();
    const bool placed = std::isfinite(start.grid.spacing_mm) && start.grid.spacing_mm > 0.0;
    if (!placed || start.grid.voxelCount() > kMostVoxels)
      throw SessionError("its bone has no size: the session is damaged");
    start.solid = decompress(blobOf(bone.getColumn(8)), start.grid.voxelCount());
    start.label = decompress(blobOf(bone.getColumn(9)), start.grid.voxelCount());
    if (impl_->schema >= 4) start.calibration = impl_->calibration();
    return start;
  });
}

std::vector<SessionCommand> SessionReader::commands() {
  return impl_->reading([&] {
    std::vector<SessionCommand> commands;
    SQLite::Statement rows(impl_->database, "SELECT first_tick, bytes FROM command ORDER BY row");
    while (rows.executeStep()) {
      commands.push_back({unpackCommand(blobOf(rows.getColumn(1))), countOf(rows.getColumn(0))});
    }
    return commands;
  });
}

std::vector<SessionEvent> SessionReader::events() {
  return impl_->reading([&] {
    std::vector<SessionEvent> events;
    SQLite::Statement rows(impl_->database, "SELECT tick, kind, text FROM event ORDER BY row");
    while (rows.executeStep()) {
      events.push_back({countOf(rows.getColumn(0)), textOf(rows.getColumn(1)), textOf(rows.getColumn(2))});
    }
    return events;
  });
}

std::vector<SessionPicture> SessionReader::pictures() {
  return impl_->reading([&] {
    std::vector<SessionPicture> pictures;
    SQLite::Statement rows(impl_->database, "SELECT tick, name, bytes FROM picture ORDER BY row");
    while (rows.executeStep()) {
      const auto bytes = blobOf(rows.getColumn(2));
      pictures.push_back({countOf(rows.getColumn(0)), textOf(rows.getColumn(1)),
                          std::vector<std::uint8_t>(bytes.begin(), bytes.end())});
    }
    return pictures;
  });
}

std::vector<haptics::Tick> SessionReader::nextTicks() {
  return impl_->reading([&] {
    if (impl_->blocks->isDone() || !impl_->blocks->executeStep()) return std::vector<haptics::Tick>{};
    const std::uint64_t count = countOf(impl_->blocks->getColumn(0));
    if (count < 1 || count > session_format::kTicksPerBlock) {
      throw SessionError("a block says it holds " + std::to_string(count) + " ticks: the session is damaged");
    }
    return unpackTicks(decompress(blobOf(impl_->blocks->getColumn(1)), count * packedTickBytes()));
  });
}

}  // namespace app
