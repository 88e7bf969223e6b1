#include "app/session/session_writer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <map>
#include <optional>

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>

#include "app/session/chain.h"
#include "app/session/command_keys.h"
#include "app/session/compressed.h"
#include "app/session/fragment_trail.h"
#include "app/session/fragments_event.h"
#include "app/session/recording_file.h"
#include "app/session/session_error.h"
#include "app/session/session_format.h"
#include "app/session/session_text.h"
#include "app/session/tables.h"
#include "app/session/tick_columns.h"

namespace app {
namespace {

using session_format::createStatement;
using session_format::kBonePartBytes;
using session_format::kTicksPerBlock;

std::int64_t sqlInteger(std::uint64_t value) { return static_cast<std::int64_t>(value); }

void bind(SQLite::Statement& insert, int column, const ColumnValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) insert.bind(column, *integer);
  if (const auto* real = std::get_if<double>(&value)) insert.bind(column, *real);
  if (const auto* text = std::get_if<std::string_view>(&value)) insert.bind(column, std::string(*text));
  if (const auto* blob = std::get_if<std::span<const std::uint8_t>>(&value)) {
    static constexpr std::uint8_t kNothing = 0;  // SQLite stores a null pointer as NULL
    insert.bindNoCopy(column, blob->empty() ? &kNothing : blob->data(), static_cast<int>(blob->size()));
  }
}

SessionError notWritten(const std::string& path, const std::exception& error) {
  return SessionError(path + ": cannot be written (" + error.what() + "): check the free space on the disk",
                      SessionErrorKind::failed);
}

}  // namespace

struct SessionWriter::Impl {
  RecordingFile recording;
  assets::VolumeGrid grid;
  std::optional<SQLite::Database> database;
  std::map<std::string, SQLite::Statement, std::less<>> inserts;  // of the open database
  Compressor compressor;
  std::int64_t next_row = 0;
  Digest last_digest{};
  std::uint64_t ticks = 0;
  FragmentTrail fragments;
  std::vector<SessionCommand> in_force;  // the last one of the ticks written, and those that came after it

  Impl(const std::string& name, bool overwrite, const SessionStart& start)
      : recording(name, overwrite), grid(start.grid), fragments(start.setup.fragments), in_force{{start.command, 0}} {}

  void open() { database.emplace(recording.file(), SQLite::OPEN_READWRITE); }
  void close() {
    inserts.clear();
    database.reset();
  }

  /// Appends one row to a table and to the chain.
  void append(std::string_view table, std::initializer_list<ColumnValue> columns) {
    const Digest digest = chained(last_digest, next_row, table, {columns.begin(), columns.size()});
    auto insert = inserts.find(table);
    if (insert == inserts.end()) {
      std::string sql = "INSERT INTO " + std::string(table) + " VALUES(?";
      for (std::size_t i = 0; i < columns.size() + 1; ++i) sql += ",?";
      insert = inserts.try_emplace(std::string(table), *database, sql + ")").first;
    }
    SQLite::Statement& statement = insert->second;
    int column = 1;
    statement.bind(column++, next_row);
    for (const ColumnValue& value : columns) bind(statement, column++, value);
    statement.bindNoCopy(column, digest.data(), static_cast<int>(digest.size()));
    statement.exec();
    statement.reset();
    statement.clearBindings();  // they point to temporaries
    last_digest = digest;
    ++next_row;
  }

  void appendTicks(std::span<const haptics::Tick> ticks_now) {
    for (std::size_t first = 0; first < ticks_now.size(); first += kTicksPerBlock) {
      const auto block = ticks_now.subspan(first, std::min(kTicksPerBlock, ticks_now.size() - first));
      const std::string removed_mm3 = removedText(removedByKey(block.back().removed_total_mm3));
      append("tick_block", {sqlInteger(block.front().index), sqlInteger(block.size()), removed_mm3,
                            compressor.compress(packTicks(block))});
    }
    ticks += ticks_now.size();
  }

  /// What broken files leave in the tooth, whenever it changes.
  void appendFragments(const SessionBatch& batch) {
    in_force.insert(in_force.end(), batch.commands.begin(), batch.commands.end());
    for (const haptics::Tick& tick : batch.ticks) {
      while (in_force.size() > 1 && in_force[1].first_tick <= tick.index) in_force.erase(in_force.begin());
      if (!fragments.follow(tick, in_force.front().command.tool.file)) continue;
      const auto lying = fragments.lying();
      append("event",
             {sqlInteger(tick.index), std::string_view(kFragmentsEvent), fragmentsText({lying.begin(), lying.end()})});
    }
  }

  /// `fill(first, part)` writes the voxels of a part.
  template <class Fill>
  void appendVolume(std::string_view volume, std::size_t voxels, Fill&& fill) {
    std::vector<std::uint8_t> part(std::min(kBonePartBytes, voxels));
    for (std::size_t first = 0; first < voxels; first += part.size()) {
      part.resize(std::min(kBonePartBytes, voxels - first));
      fill(first, std::span(part));
      append("bone_part", {volume, sqlInteger(first), sqlInteger(part.size()), compressor.compress(part)});
    }
  }

  void appendSoftTissue(const assets::SoftTissueField& soft) {
    const std::size_t voxels = soft.distance.size();
    appendVolume(session_format::kSoftDistance, 2 * voxels, [&](std::size_t first, std::span<std::uint8_t> part) {
      for (std::size_t n = 0; n < part.size(); ++n) {
        const std::size_t at = first + n;
        const auto bits = static_cast<std::uint16_t>(soft.distance[at % voxels]);
        part[n] = static_cast<std::uint8_t>(at < voxels ? bits : bits >> 8);
      }
    });
    appendVolume(session_format::kSoftTissue, voxels, [&](std::size_t first, std::span<std::uint8_t> part) {
      std::copy_n(soft.tissue.begin() + static_cast<std::ptrdiff_t>(first), part.size(), part.begin());
    });
  }

  void appendStart(const SessionStart& start) {
    append("meta", {session_format::kSchema, aboutText(start)});
    for (const TickColumn& c : tickColumns()) append("tick_column", {c.name, c.type, c.unit, c.frame, c.meaning});
    appendVolume(session_format::kSolid, grid.voxelCount(), [&](std::size_t first, std::span<std::uint8_t> part) {
      std::ranges::copy(start.solid.subspan(first, part.size()), part.begin());
    });
    if (!start.label.empty())
      appendVolume(session_format::kLabel, grid.voxelCount(), [&](std::size_t first, std::span<std::uint8_t> part) {
        std::ranges::copy(start.label.subspan(first, part.size()), part.begin());
      });
    if (!start.whole.empty())
      appendVolume(session_format::kWhole, grid.voxelCount(), [&](std::size_t first, std::span<std::uint8_t> part) {
        std::ranges::copy(start.whole.subspan(first, part.size()), part.begin());
      });
    if (!start.is_tooth.empty())
      appendVolume(session_format::kIsTooth, grid.voxelCount(), [&](std::size_t first, std::span<std::uint8_t> part) {
        std::ranges::copy(start.is_tooth.subspan(first, part.size()), part.begin());
      });
    if (!start.teeth.empty())
      appendVolume(session_format::kTeeth, grid.voxelCount(), [&](std::size_t first, std::span<std::uint8_t> part) {
        std::ranges::copy(start.teeth.subspan(first, part.size()), part.begin());
      });
    if (const auto& prepared = start.setup.prepared; prepared && prepared->given) {
      const std::vector<std::uint8_t>& ideal = prepared->given->solid;
      appendVolume(session_format::kIdeal, ideal.size(), [&](std::size_t first, std::span<std::uint8_t> part) {
        std::copy_n(ideal.begin() + static_cast<std::ptrdiff_t>(first), part.size(), part.begin());
      });
    }
    if (const auto& prepared = start.setup.prepared; prepared && prepared->opposing) {
      const std::vector<float>& height = prepared->opposing->height_mm;
      const auto byte = [&](std::size_t n) {
        return static_cast<std::uint8_t>(std::bit_cast<std::uint32_t>(height[n % height.size()]) >>
                                         8 * (n / height.size()));
      };
      appendVolume(session_format::kOpposing, 4 * height.size(), [&](std::size_t first, std::span<std::uint8_t> part) {
        for (std::size_t n = 0; n < part.size(); ++n) part[n] = byte(first + n);
      });
    }
    if (start.soft_tissue != nullptr && !start.soft_tissue->isEmpty()) appendSoftTissue(*start.soft_tissue);
    if (start.laid != nullptr) appendLaid(*start.laid, session_format::kLaidBefore);
    append("command", {sqlInteger(start.command.serial), std::int64_t{0}, commandText(start.command)});
  }

  /// Initial minus final solid fraction; the initial parts are read back one by one.
  void appendRemoved(const haptics::Bodies& bodies) {
    SQLite::Statement parts(*database, "SELECT bytes FROM bone_part WHERE volume = 'solid' ORDER BY row");
    std::vector<std::uint8_t> start;
    const std::vector<std::uint8_t> left = bodies.solidInMouth();
    appendVolume(session_format::kRemoved, grid.voxelCount(), [&](std::size_t first, std::span<std::uint8_t> part) {
      if (!parts.executeStep()) throw damagedSession("a part of its bone is missing");
      start.resize(part.size());
      decompressInto(start, blobOf(parts.getColumn(0)));
      for (std::size_t n = 0; n < part.size(); ++n) {
        part[n] = static_cast<std::uint8_t>(start[n] - left[first + n]);
      }
    });
  }

  void appendLaid(const haptics::Filling::Volumes& at, const session_format::LaidNames& names) {
    const auto append_bytes = [&](std::string_view name, const std::vector<std::uint8_t>& bytes) {
      appendVolume(name, bytes.size(), [&](std::size_t first, std::span<std::uint8_t> part) {
        std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(first), part.size(), part.begin());
      });
    };
    append_bytes(names.laid, at.laid);
    append_bytes(names.tissue, at.tissue);
    append_bytes(names.increment, at.increment);
    const std::size_t voxels = at.light.size();
    if (voxels == 0) return;
    appendVolume(names.light, 2 * voxels, [&](std::size_t first, std::span<std::uint8_t> part) {
      for (std::size_t n = 0; n < part.size(); ++n) {
        const std::size_t v = first + n;
        part[n] = static_cast<std::uint8_t>(v < voxels ? at.light[v] : at.light[v - voxels] >> 8);
      }
    });
  }

  /// Runs `work`; if it throws, runs `restore` and reports a database error as one line on this file.
  template <class Work, class Restore>
  void attempt(Work&& work, Restore&& restore) {
    try {
      work();
    } catch (const SQLite::Exception& error) {
      restore();
      throw notWritten(recording.file(), error);
    } catch (...) {
      restore();
      throw;
    }
  }

  /// `work` in one transaction; if it fails, file and chain are unchanged.
  template <class Work>
  void inTransaction(Work&& work) {
    attempt(
        [&] {
          SQLite::Transaction transaction(*database);
          work();
          transaction.commit();
        },
        [this, row = next_row, digest = last_digest, count = ticks] {
          next_row = row, last_digest = digest, ticks = count;
        });
  }

  /// All or nothing: an unfinished start is marked by its journal.
  void begin(const SessionStart& start) {
    open();
    inTransaction([&] {
      database->exec("PRAGMA application_id=" + std::to_string(session_format::kApplicationId));
      for (const session_format::Table& table : session_format::kTables)
        database->exec(createStatement(table.name, table.columns));
      appendStart(start);
    });
    close();
  }

  /// The first batch is written before the file gets its name; later ones go through the WAL. The exclusive lock keeps
  /// other programs out and avoids a -shm file.
  template <class Work>
  void write(Work&& work) {
    recording.refuseIfReplaced();
    if (database) return inTransaction(work);
    attempt(
        [&] {
          open();
          inTransaction(work);
          close();
          recording.publish();
          open();
          database->exec("PRAGMA locking_mode=EXCLUSIVE; PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;");
        },
        [this] { close(); });
  }
};

SessionWriter::SessionWriter(const std::string& path, bool overwrite, const SessionStart& start)
    : impl_(std::make_unique<Impl>(path, overwrite, start)) {
  assert(start.solid.size() == start.grid.voxelCount());
  assert(start.label.empty() || start.label.size() == start.grid.voxelCount());
  assert(start.is_tooth.empty() || start.is_tooth.size() == start.grid.voxelCount());
  assert(start.whole.empty() || start.whole.size() == start.grid.voxelCount());
  assert(start.teeth.empty() || start.teeth.size() == start.grid.voxelCount());
  impl_->attempt([&] { impl_->begin(start); }, [] {});
}

SessionWriter::~SessionWriter() {
  if (!impl_->database) return;
  try {
    // Ended early, but not killed: the log is merged into the file.
    impl_->inserts.clear();
    impl_->database->exec("PRAGMA journal_mode=DELETE");
  } catch (const std::exception&) {
    // The log stays and is read from there.
  }
}

std::uint64_t SessionWriter::ticks() const { return impl_->ticks; }

const std::string& SessionWriter::file() const { return impl_->recording.file(); }

bool SessionWriter::replaces() const { return impl_->recording.replaces(); }

void SessionWriter::write(const SessionBatch& batch) {
  impl_->write([&] {
    for (const SessionCommand& change : batch.commands)
      impl_->append("command",
                    {sqlInteger(change.command.serial), sqlInteger(change.first_tick), commandText(change.command)});
    impl_->appendTicks(batch.ticks);
    impl_->appendFragments(batch);
    for (const SessionEvent& event : batch.events)
      impl_->append("event", {sqlInteger(event.tick), event.kind, event.text});
  });
}

void SessionWriter::seal(std::uint64_t lost, const haptics::Bodies* bodies) {
  SessionEnd end{impl_->ticks, lost, {}};
  impl_->write([&] {
    if (bodies != nullptr) {
      impl_->appendRemoved(*bodies);
      if (const haptics::Filling* const filling = bodies->filling(); filling != nullptr && !filling->isEmpty())
        impl_->appendLaid(filling->volumes(), session_format::kLaid);
      end.bone_digest = bodies->digest();
    }
    impl_->append("seal", {sealText(end)});
  });
  try {
    // The log is merged into the file and removed, then the digest of the whole file is appended.
    impl_->inserts.clear();
    impl_->database->exec("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode=DELETE;");
    impl_->close();
  } catch (const SQLite::Exception& error) {
    throw SessionError(file() + ": cannot be closed (" + error.what() + "): check the free space on the disk",
                       SessionErrorKind::failed);
  }
  impl_->recording.finish();
}

}  // namespace app
