#include "app/session/session_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>

#include "app/session/chain.h"
#include "app/session/compressed.h"
#include "app/session/file_seal.h"
#include "app/session/packing.h"
#include "app/session/session_error.h"
#include "app/session/session_format.h"

namespace app {
namespace {

using session_format::kTicksPerBlock;

std::array<std::string, 4> filesOf(const std::string& path) {
  return {path, path + "-wal", path + "-shm", path + "-journal"};
}

void removeFiles(const std::string& path) {
  std::error_code failed;
  for (const std::string& file : filesOf(path)) std::filesystem::remove(file, failed);
}

/// The file is made here and now, so that two programs never record into one and nothing is overwritten unasked.
void claimNewFile(const std::string& path, bool overwrite) {
  std::error_code failed;
  if (std::filesystem::is_directory(path, failed))
    throw SessionError(path + ": is a folder: name a file to record into");
  if (overwrite) removeFiles(path);
  for (const std::string& file : filesOf(path)) {
    if (std::filesystem::exists(file, failed)) {
      throw SessionError(file + ": exists already: choose another name for the recording or use --force");
    }
  }
  const int created = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (created < 0) {
    throw SessionError(path + ": can not be created (" + std::strerror(errno) + "): check the folder and its rights");
  }
  ::close(created);
}

std::int64_t sqlInteger(std::uint64_t value) { return static_cast<std::int64_t>(value); }

/// SQLite keeps no negative zero, and the digest is taken of what will be read back.
double sqlReal(double value) { return value + 0.0; }

void bind(SQLite::Statement& insert, int place, const ColumnValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) insert.bind(place, *integer);
  if (const auto* real = std::get_if<double>(&value)) insert.bind(place, *real);
  if (const auto* text = std::get_if<std::string_view>(&value)) insert.bind(place, std::string(*text));
  if (const auto* blob = std::get_if<std::span<const std::uint8_t>>(&value)) {
    static constexpr std::uint8_t kNothing = 0;  // a null pointer would be stored as NULL
    insert.bindNoCopy(place, blob->empty() ? &kNothing : blob->data(), static_cast<int>(blob->size()));
  }
}

}  // namespace

struct SessionWriter::Impl {
  std::string path;
  std::optional<SQLite::Database> database;
  std::int64_t next_row = 0;
  Digest last_digest{};
  std::uint64_t ticks = 0;

  /// Appends one row to a table and to the chain.
  void append(std::string_view table, std::initializer_list<ColumnValue> columns) {
    const Digest digest = chained(last_digest, next_row, table, {columns.begin(), columns.size()});
    std::string sql = "INSERT INTO " + std::string(table) + " VALUES(?";
    for (std::size_t i = 0; i < columns.size() + 1; ++i) sql += ",?";
    SQLite::Statement insert(*database, sql + ")");
    int place = 1;
    insert.bind(place++, next_row);
    for (const ColumnValue& value : columns) bind(insert, place++, value);
    insert.bindNoCopy(place, digest.data(), static_cast<int>(digest.size()));
    insert.exec();
    last_digest = digest;
    ++next_row;
  }

  void appendTicks(std::span<const haptics::Tick> ticks_now) {
    for (std::size_t first = 0; first < ticks_now.size(); first += kTicksPerBlock) {
      const auto block = ticks_now.subspan(first, std::min(kTicksPerBlock, ticks_now.size() - first));
      const std::vector<std::uint8_t> bytes = compress(packTicks(block));
      append("tick_block", {sqlInteger(block.front().index), sqlInteger(block.size()), bytes});
    }
    ticks += ticks_now.size();
  }

  void appendStart(const SessionStart& start) {
    append("meta", {session_format::kSchema, start.program_version, start.patient_title, sqlReal(start.dt_s)});
    const assets::VolumeGrid& grid = start.grid;
    const std::vector<std::uint8_t> unlabelled(start.label.empty() ? start.solid.size() : 0);
    const std::vector<std::uint8_t> solid = compress(start.solid);
    const std::vector<std::uint8_t> label = compress(start.label.empty() ? unlabelled : start.label);
    append("bone",
           {std::int64_t{grid.size.x}, std::int64_t{grid.size.y}, std::int64_t{grid.size.z}, sqlReal(grid.spacing_mm),
            sqlReal(grid.origin_P_mm.x), sqlReal(grid.origin_P_mm.y), sqlReal(grid.origin_P_mm.z), solid, label});
    const std::vector<std::uint8_t> command = packCommand(start.command);
    append("command", {sqlInteger(start.command.serial), std::int64_t{0}, command});
    const SessionCalibration& c = start.calibration;
    append("calibration", {c.rig, c.rig_id, c.device_serial, c.verdict, std::int64_t{c.touches}, sqlReal(c.rms_mm),
                           sqlReal(c.p95_mm), sqlReal(c.max_mm), c.checked_utc,
                           c.age_days ? ColumnValue(sqlReal(*c.age_days)) : ColumnValue(), c.despite});
  }

  /// Does `work` in one transaction; when it fails, neither the file nor the chain has moved.
  template <class Work>
  void inTransaction(Work&& work) {
    const auto row_before = next_row;
    const auto digest_before = last_digest;
    const auto ticks_before = ticks;
    try {
      SQLite::Transaction transaction(*database);
      work();
      transaction.commit();
    } catch (const SQLite::Exception& trouble) {
      next_row = row_before;
      last_digest = digest_before;
      ticks = ticks_before;
      throw SessionError(path + ": can not be written (" + trouble.what() + "): check the free space on the disk");
    }
  }
};

SessionWriter::SessionWriter(const std::string& path, bool overwrite, const SessionStart& start)
    : impl_(std::make_unique<Impl>()) {
  assert(start.solid.size() == start.grid.voxelCount());
  assert(start.label.empty() || start.label.size() == start.grid.voxelCount());
  impl_->path = path;
  claimNewFile(path, overwrite);
  try {
    SQLite::Database& database = impl_->database.emplace(path, SQLite::OPEN_READWRITE);
    // Exclusive: no second program meets a file that is being written, and no -shm file is needed.
    database.exec("PRAGMA locking_mode=EXCLUSIVE; PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;");
    database.exec("PRAGMA application_id=" + std::to_string(session_format::kApplicationId));
    impl_->inTransaction([&] {
      for (const session_format::Table& table : session_format::kTables) database.exec(std::string(table.create));
      impl_->appendStart(start);
    });
  } catch (const SessionError&) {
    impl_->database.reset();
    removeFiles(path);
    throw;
  } catch (const std::exception& trouble) {
    impl_->database.reset();
    removeFiles(path);
    throw SessionError(path + ": can not be written (" + trouble.what() + "): check the folder and the free space");
  }
}

SessionWriter::~SessionWriter() = default;

std::uint64_t SessionWriter::ticks() const { return impl_->ticks; }

void SessionWriter::write(const SessionBatch& batch) {
  impl_->inTransaction([&] {
    for (const SessionCommand& change : batch.commands) {
      const std::vector<std::uint8_t> bytes = packCommand(change.command);
      impl_->append("command", {sqlInteger(change.command.serial), sqlInteger(change.first_tick), bytes});
    }
    impl_->appendTicks(batch.ticks);
    for (const SessionEvent& event : batch.events) {
      impl_->append("event", {sqlInteger(event.tick), event.kind, event.text});
    }
    for (const SessionPicture& picture : batch.pictures) {
      impl_->append("picture", {sqlInteger(picture.tick), picture.name, picture.bytes});
    }
  });
}

void SessionWriter::seal(std::uint64_t lost) {
  impl_->inTransaction([&] { impl_->append("seal", {sqlInteger(impl_->ticks), sqlInteger(lost)}); });
  try {
    // Everything into the one file: the log is folded in and goes, then the digest of the whole is put behind it.
    impl_->database->exec("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode=DELETE;");
    impl_->database.reset();
  } catch (const SQLite::Exception& trouble) {
    throw SessionError(impl_->path + ": can not be closed (" + trouble.what() + "): check the free space on the disk");
  }
  sealFile(impl_->path);
}

}  // namespace app
