#include "app/session/session_reader.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <sqlite3.h>

#include "app/session/chain.h"
#include "app/session/command_keys.h"
#include "app/session/compressed.h"
#include "app/session/file_seal.h"
#include "app/session/old_formats/packed_format.h"
#include "app/session/recording_file.h"
#include "app/session/session_error.h"
#include "app/session/session_format.h"
#include "app/session/tables.h"
#include "app/session/tick_columns.h"

namespace app {
namespace {

namespace fs = std::filesystem;

enum class Log { none, present, missing };

/// A log next to a closed file belongs to another recording.
Log logOf(const std::string& path) {
  if (!needsLog(path)) return Log::none;
  std::error_code failed;
  const auto bytes = fs::file_size(path + "-wal", failed);
  return !failed && bytes > 0 ? Log::present : Log::missing;
}

/// A file without log is opened as immutable. One with a log is read without locks, which works in a read-only folder,
/// creates no third file and merges nothing.
std::string address(const std::string& path) {
  std::string uri = "file:";
  for (const char c : fs::absolute(path).string()) {
    if (c == '?' || c == '#' || c == '%') {
      static constexpr char kHex[] = "0123456789abcdef";
      uri += {'%', kHex[static_cast<unsigned char>(c) >> 4], kHex[c & 15]};
    } else {
      uri += c;
    }
  }
  return uri + (logOf(path) == Log::present ? "?vfs=unix-none" : "?immutable=1");
}

std::uint64_t countOf(const SQLite::Column& column) { return static_cast<std::uint64_t>(column.getInt64()); }

/// Whether a database error means changed bytes or a failure to read them.
SessionErrorKind errorKindOf(const SQLite::Exception& exception) {
  const int code = exception.getErrorCode() & 0xff;
  const bool by_bytes = code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_ERROR ||
                        code == SQLITE_TOOBIG || code == SQLITE_SCHEMA || code == SQLITE_CONSTRAINT ||
                        code == SQLITE_MISMATCH || code == SQLITE_FORMAT;
  return by_bytes ? SessionErrorKind::damaged : SessionErrorKind::failed;
}

/// What a servo can have written: all that is told over time relies on it.
bool hasTime(const haptics::Tick& tick) {
  constexpr double kLongest_s = 1e6, kSlowest_s = 1.0;
  return tick.t_s >= 0.0 && tick.t_s <= kLongest_s && tick.dt_s >= 0.0 && tick.dt_s <= kSlowest_s;
}

SessionError notRead(const std::string& path, const SQLite::Exception& exception) {
  const SessionErrorKind kind = errorKindOf(exception);
  const std::string what = path + ": cannot be read (" + exception.what() + "): ";
  return SessionError(what + (kind == SessionErrorKind::damaged ? "the session is damaged" : "check disk and rights"),
                      kind);
}

}  // namespace

struct SessionReader::Impl {
  std::string path;
  SQLite::Database database;
  std::int64_t schema = 0;
  bool closed = false;
  SessionEnd end;
  LabelTable label{};
  std::optional<FileSeal> trailer;
  std::optional<TickUnpacker> unpacker;
  std::optional<SQLite::Statement> blocks;
  SessionReader::BlockPlace place;  // gaps of the tick indices read so far

  /// Runs `work` and reports database errors as one line on this file.
  template <class Work>
  auto reading(Work&& work) {
    try {
      return work();
    } catch (const SQLite::Exception& error) {
      throw notRead(path, error);
    } catch (const SessionError& error) {
      throw SessionError(path + ": " + error.what(), error.kind);
    }
  }

  explicit Impl(const std::string& file)
      : path(file), database(address(file), SQLite::OPEN_READONLY | SQLite::OPEN_URI) {
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    database.exec("PRAGMA locking_mode=EXCLUSIVE; PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON;");
    checkSchema();
    reading([&] {
      isPacked() ? readPackedTables() : readTables();
      blocks->bind(1, place.after_row);
    });
  }

  bool isPacked() const { return schema < session_format::kSchema; }

  void checkSchema() {
    const auto refuse = [&](const std::string& why) {
      const bool changed = !needsLog(path) && seal() == FileSeal::broken;
      throw SessionError(path + ": " + why, changed ? SessionErrorKind::damaged : SessionErrorKind::refused);
    };
    if (database.execAndGet("PRAGMA application_id").getInt64() != session_format::kApplicationId)
      refuse("is not a session: name a file made by `molar rehearse`");
    if (!database.tableExists("meta")) {
      if (const auto log = missingLog()) throw missingLogError(path, *log);
      refuse("is not a session of this version of the program: name a file made by `molar rehearse`");
    }
    SQLite::Statement meta(database, "SELECT schema FROM meta");
    if (meta.executeStep()) schema = meta.getColumn(0).getInt64();
    if (schema < session_format::kOldestSchema || schema > session_format::kSchema)
      refuse("has a schema this program does not know: use the version that recorded it");
    if (const auto wrong = isPacked() ? packedTableError(database, schema) : tableError(database))
      throw SessionError(path + ": " + *wrong + ": the session is damaged", SessionErrorKind::damaged);
  }

  void readPackedTables() {
    SQLite::Statement seal(database, "SELECT ticks, lost FROM seal");
    closed = seal.executeStep();
    if (closed) end = {countOf(seal.getColumn(0)), countOf(seal.getColumn(1)), {}};
    label = old_formats::packedLabels();
    unpacker.emplace(old_formats::packedTickColumns());
    blocks.emplace(database, "SELECT count, ticks, row FROM tick_block WHERE row > ? ORDER BY row");
  }

  void readTables() {
    SQLite::Statement seal(database, "SELECT about FROM seal");
    closed = seal.executeStep();
    if (closed) end = sealFromText(seal.getColumn(0).getString());
    label = aboutWithLabels().label;
    SQLite::Statement rows(database, "SELECT name, type, unit, frame FROM tick_column ORDER BY row");
    std::vector<TickColumn> columns;
    while (rows.executeStep())
      columns.push_back({rows.getColumn(0).getString(), rows.getColumn(1).getString(), rows.getColumn(2).getString(),
                         rows.getColumn(3).getString(), ""});
    unpacker.emplace(columns);
    blocks.emplace(database, "SELECT count, ticks, row, removed_mm3 FROM tick_block WHERE row > ? ORDER BY row");
  }

  /// Hashes the file once.
  FileSeal seal() {
    if (!trailer) trailer = fileSeal(path);
    return *trailer;
  }

  std::optional<std::string> missingLog() const {
    return logOf(path) == Log::missing ? std::optional(path + "-wal") : std::nullopt;
  }

  SessionAbout aboutWithLabels() {
    SQLite::Statement meta(database, "SELECT about FROM meta");
    if (!meta.executeStep()) throw damagedSession("it has no start");
    SessionAbout about = aboutFromText(meta.getColumn(0).getString());
    refuseInvalidGrid(about.start.grid);
    return about;
  }

  /// All voxels of a volume; empty: it is not stored. The sizes are checked before anything is allocated.
  std::vector<std::uint8_t> volume(std::string_view name, std::size_t voxels) {
    SQLite::Statement parts(database, "SELECT voxels, bytes FROM bone_part WHERE volume = ? ORDER BY row");
    parts.bind(1, std::string(name));
    std::size_t found = 0;
    for (bool more = parts.executeStep(); more; more = parts.executeStep()) {
      const std::uint64_t in_part = countOf(parts.getColumn(0));
      if (in_part < 1 || in_part > voxels - found) throw damagedSession("a volume has too many voxels");
      refuseUnlessContentSize(blobOf(parts.getColumn(1)), in_part);
      found += in_part;
    }
    if (found == 0) return {};
    if (found != voxels) throw damagedSession("a part of a volume is missing");
    std::vector<std::uint8_t> values(voxels);
    parts.reset();
    for (std::size_t first = 0; first < voxels;) {
      parts.executeStep();
      const std::uint64_t in_part = countOf(parts.getColumn(0));
      decompressInto(std::span(values).subspan(first, in_part), blobOf(parts.getColumn(1)));
      first += in_part;
    }
    return values;
  }

  StoredStart about() { return isPacked() ? old_formats::packedAbout(database, schema) : aboutWithLabels().start; }

  void readOpposing(SessionSetup& setup) {
    if (!setup.prepared || !setup.prepared->opposing) return;
    constexpr std::size_t kPlaces =
        static_cast<std::size_t>(assets::OpposingTeeth::kSide) * assets::OpposingTeeth::kSide;
    const std::vector<std::uint8_t> bytes = volume(session_format::kOpposing, 4 * kPlaces);
    if (bytes.empty()) throw damagedSession("its opposing teeth are missing");
    std::vector<float>& height = setup.prepared->opposing->height_mm;
    height.resize(kPlaces);
    for (std::size_t n = 0; n < kPlaces; ++n) {
      std::uint32_t bits = 0;
      for (std::size_t b = 4; b-- > 0;) bits = bits << 8 | bytes[b * kPlaces + n];
      height[n] = std::bit_cast<float>(bits);
      if (!std::isnan(height[n]) && !(std::abs(height[n]) < 1e3F))
        throw damagedSession("its opposing teeth are at no place");
    }
  }

  /// The grid is known.
  void readIdeal(SessionSetup& setup) {
    if (!setup.prepared || !setup.prepared->given) return;
    assets::GivenIdeal& given = *setup.prepared->given;
    given.solid = volume(session_format::kIdeal, given.grid.voxelCount());
    if (given.solid.empty()) throw damagedSession("its ideal is missing");
  }

  /// The grid is known; size 0: none is stored.
  void readSoftTissue(assets::SoftTissueField& soft) {
    if (soft.grid.size.x == 0) return;
    refuseInvalidGrid(soft.grid);
    const std::size_t voxels = soft.grid.voxelCount();
    const std::vector<std::uint8_t> bytes = volume(session_format::kSoftDistance, 2 * voxels);
    soft.tissue = volume(session_format::kSoftTissue, voxels);
    if (bytes.empty() || soft.tissue.empty()) throw damagedSession("its soft tissue is missing");
    soft.distance.resize(voxels);
    for (std::size_t v = 0; v < voxels; ++v)
      soft.distance[v] = static_cast<std::int16_t>(static_cast<std::uint16_t>(bytes[v] | bytes[v + voxels] << 8));
  }

  /// Without ages; none: nothing is laid.
  std::optional<haptics::Filling::Volumes> laid(const session_format::LaidNames& names, std::size_t voxels) {
    haptics::Filling::Volumes at{
        volume(names.laid, voxels), volume(names.tissue, voxels), volume(names.increment, voxels), {}, {}};
    if (at.laid.empty()) return std::nullopt;
    if (at.tissue.empty() || at.increment.empty()) throw damagedSession("a part of its filling is missing");
    for (std::uint8_t& tissue : at.tissue) tissue = label[tissue];
    const std::vector<std::uint8_t> bytes = volume(names.light, 2 * voxels);
    if (bytes.empty()) return at;
    at.light.resize(voxels);
    for (std::size_t v = 0; v < voxels; ++v)
      at.light[v] = static_cast<std::uint16_t>(bytes[v] | bytes[v + voxels] << 8);
    return at;
  }

  StoredStart start() {
    StoredStart start = about();
    if (isPacked()) {
      old_formats::readPackedBone(database, start);
    } else {
      const std::size_t voxels = start.grid.voxelCount();
      start.solid = volume(session_format::kSolid, voxels);
      if (start.solid.empty()) throw damagedSession("it has no bone");
      start.label = volume(session_format::kLabel, voxels);
      if (start.label.empty()) start.label.resize(voxels);
      start.whole = volume(session_format::kWhole, voxels);
      start.is_tooth = volume(session_format::kIsTooth, voxels);
      start.teeth = volume(session_format::kTeeth, voxels);
      readIdeal(start.setup);
      readOpposing(start.setup);
      readSoftTissue(start.soft_tissue);
      start.laid = laid(session_format::kLaidBefore, voxels);
      if (start.laid) start.laid->age_s = aboutWithLabels().laid_before_age_s;
    }
    for (std::uint8_t& value : start.label) value = label[value];
    return start;
  }
};

SessionError missingLogError(const std::string& path, const std::string& log) {
  return SessionError(path + ": was being recorded when its program was killed, and its log " + log +
                      " is not next to it: copy both files");
}

SessionReader::SessionReader(const std::string& named) {
  const std::string path = resolvedLinks(named);
  std::error_code failed;
  if (!fs::exists(path, failed)) throw SessionError(path + ": no such session file: check the name");
  if (!fs::is_regular_file(path, failed))
    throw SessionError(path + ": is not a plain file: name a file made by `molar rehearse`");
  if (isBeingRecorded(path)) throw SessionError(path + ": is being recorded: read it after the rehearsal");
  try {
    impl_ = std::make_unique<Impl>(path);
  } catch (const SQLite::Exception& error) {
    if (errorKindOf(error) == SessionErrorKind::failed) throw notRead(path, error);
    throw SessionError(
        path + ": is not a readable session (" + error.what() + "): name a file made by `molar rehearse`",
        hasSessionMark(path) ? SessionErrorKind::damaged : SessionErrorKind::refused);
  }
}

StoredStart SessionReader::startWhileRecorded(const std::string& path) {
  try {
    Impl impl(path);
    return impl.reading([&] { return impl.start(); });
  } catch (const SQLite::Exception& error) {
    throw notRead(path, error);
  }
}

SessionReader::~SessionReader() = default;

bool SessionReader::closed() const { return impl_->closed; }
std::uint64_t SessionReader::lost() const { return std::max(impl_->end.lost, impl_->place.gaps); }
std::optional<std::string> SessionReader::missingLog() const {
  return impl_->isPacked() && impl_->closed ? std::nullopt : impl_->missingLog();
}

bool SessionReader::isUnsealed() const { return impl_->closed && impl_->seal() != FileSeal::intact; }

std::optional<std::string> SessionReader::damage() {
  try {
    if (auto damaged = chainDamage(impl_->database)) return damaged;
    const std::uint64_t count = countOf(impl_->database.execAndGet("SELECT total(count) FROM tick_block"));
    if (impl_->closed && count != impl_->end.ticks)
      return "it holds " + std::to_string(count) + " ticks, its seal says " + std::to_string(impl_->end.ticks);
  } catch (const SQLite::Exception& error) {
    if (errorKindOf(error) == SessionErrorKind::failed) throw notRead(impl_->path, error);
    return std::string("its rows cannot be read (") + error.what() + ")";
  }
  // A file with a log is not a whole database and has no trailer.
  if (!needsLog(impl_->path) && impl_->seal() == FileSeal::broken)
    return "a byte outside its rows was changed, or its end was cut off";
  return std::nullopt;
}

double SessionReader::length_s() {
  return impl_->reading([&] {
    SQLite::Statement last(impl_->database, "SELECT first_tick, count FROM tick_block ORDER BY row DESC LIMIT 1");
    if (!last.executeStep()) return 0.0;
    return static_cast<double>(countOf(last.getColumn(0)) + countOf(last.getColumn(1))) * impl_->about().dt_s;
  });
}

StoredStart SessionReader::about() {
  return impl_->reading([&] { return impl_->about(); });
}

StoredStart SessionReader::start() {
  return impl_->reading([&] { return impl_->start(); });
}

std::vector<SessionCommand> SessionReader::commands() {
  return impl_->reading([&] {
    if (impl_->isPacked()) return old_formats::packedCommands(impl_->database);
    std::vector<SessionCommand> commands;
    SQLite::Statement rows(impl_->database, "SELECT first_tick, command FROM command ORDER BY row");
    while (rows.executeStep()) {
      commands.push_back({commandFromText(rows.getColumn(1).getString()), countOf(rows.getColumn(0))});
    }
    return commands;
  });
}

std::vector<SessionEvent> SessionReader::events() {
  return impl_->reading([&] {
    std::vector<SessionEvent> events;
    SQLite::Statement rows(impl_->database, "SELECT tick, kind, text FROM event ORDER BY row");
    while (rows.executeStep())
      events.push_back({countOf(rows.getColumn(0)), rows.getColumn(1).getString(), rows.getColumn(2).getString()});
    return events;
  });
}

TickBlock SessionReader::nextBlock() {
  return impl_->reading([&] {
    TickBlock block;
    SQLite::Statement& rows = *impl_->blocks;
    if (rows.isDone() || !rows.executeStep()) return block;
    const std::uint64_t count = countOf(rows.getColumn(0));
    BlockPlace& place = impl_->place;
    place.after_row = rows.getColumn(2).getInt64();
    if (count < 1 || count > session_format::kTicksPerBlock)
      throw damagedSession("a block says it holds " + std::to_string(count) + " ticks");
    block.ticks =
        impl_->unpacker->unpack(decompress(blobOf(rows.getColumn(1)), count * impl_->unpacker->bytesPerTick()));
    if (!impl_->isPacked()) block.removed_mm3 = removedFromText(rows.getColumn(3).getString());
    for (haptics::Tick& tick : block.ticks) {
      if (!hasTime(tick)) throw damagedSession("tick " + std::to_string(tick.index) + " has no time");
      tick.contact_tissue = impl_->label[tick.contact_tissue];
      if (tick.index > place.next_index) place.gaps += tick.index - place.next_index;
      place.next_index = tick.index + 1;
    }
    return block;
  });
}

void SessionReader::rewind() { continueAt({}); }

SessionReader::BlockPlace SessionReader::place() const { return impl_->place; }

void SessionReader::continueAt(const BlockPlace& place) {
  impl_->reading([&] {
    impl_->blocks->reset();
    impl_->blocks->bind(1, place.after_row);
  });
  impl_->place = place;
}

std::optional<SessionReader::FinalBone> SessionReader::finalBone(const StoredStart& start) {
  return impl_->reading([&]() -> std::optional<FinalBone> {
    if (impl_->isPacked() || !impl_->closed || !impl_->end.bone_digest) return std::nullopt;
    FinalBone left{impl_->volume(session_format::kRemoved, start.grid.voxelCount()), *impl_->end.bone_digest};
    if (left.solid.size() != start.solid.size()) throw damagedSession("the final bone is missing");
    for (std::size_t v = 0; v < left.solid.size(); ++v)
      left.solid[v] = static_cast<std::uint8_t>(start.solid[v] - left.solid[v]);
    return left;
  });
}

std::optional<haptics::Filling::Volumes> SessionReader::finalFilling(const StoredStart& start) {
  return impl_->reading([&]() -> std::optional<haptics::Filling::Volumes> {
    if (impl_->isPacked()) return std::nullopt;
    return impl_->laid(session_format::kLaid, start.grid.voxelCount());
  });
}

}  // namespace app
