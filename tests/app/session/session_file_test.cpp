#include <filesystem>
#include <limits>

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include "app/session/chain.h"
#include "app/session/file_seal.h"
#include "app/session/session_error.h"
#include "app/session/session_format.h"
#include "app/session/session_reader.h"
#include "app/session/session_writer.h"
#include "app/session/tick_columns.h"
#include "haptics/bone/carve.h"
#include "tests/app/session/small_session.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using test::bytesOf;
using test::imaginedTicks;
using test::writeBytes;

/// A session with something in every table.
void writeSession(const std::string& path, bool closed) {
  const test::SmallBone bone;
  SessionWriter writer(path, false, bone.start());
  haptics::Command louder;
  louder.serial = 2;
  writer.write({{}, imaginedTicks(0, 50), {{0, "start", "rehearsal"}}});
  writer.write({{{louder, 50}}, imaginedTicks(50, 30), {}});
  if (closed) writer.seal(0);
}

/// What a killed program leaves: database and log as they are at this moment.
void writeKilledSession(const std::string& path) {
  const std::string live = path + ".live";
  const test::SmallBone bone;
  SessionWriter writer(live, false, bone.start());
  for (std::uint64_t i = 0; i < 10; ++i) writer.write({{}, imaginedTicks(20 * i, 20), {{20 * i, "mark", "x"}}});
  std::filesystem::copy_file(live, path);
  std::filesystem::copy_file(live + "-wal", path + "-wal");
}

std::uint64_t readEverything(SessionReader& session) {
  session.start();
  session.commands();
  session.events();
  std::uint64_t ticks = 0;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock())
    ticks += block.ticks.size();
  return ticks;
}

TEST(SessionFile, GivesBackTheSoftTissue) {
  const tests::ScratchFolder folder;
  const test::SmallBone bone;
  assets::SoftTissueField soft;
  soft.grid = {{7, 5, 4}, 1.0, {-3.0, 0.5, 2.0}};
  for (std::size_t v = 0; v < soft.grid.voxelCount(); ++v) {
    soft.distance.push_back(static_cast<std::int16_t>(static_cast<int>(v * 37 % 3000) - 1000));
    soft.tissue.push_back(static_cast<std::uint8_t>(v % assets::kSoftTissueCount));
  }
  for (const assets::SoftTissueField* const stored : {&soft, static_cast<assets::SoftTissueField*>(nullptr)}) {
    SessionStart start = bone.start();
    start.soft_tissue = stored;
    SessionWriter(folder.file("s.molar"), true, start).seal(0);
    EXPECT_EQ(SessionReader(folder.file("s.molar")).start().soft_tissue, stored ? soft : assets::SoftTissueField());
  }
}

TEST(SessionFile, GivesBackWhatWasWritten) {
  const tests::ScratchFolder folder;
  writeSession(folder.file("s.molar"), true);
  SessionReader session(folder.file("s.molar"));
  EXPECT_EQ(session.damage(), std::nullopt);
  EXPECT_TRUE(session.closed());

  const test::SmallBone bone;
  const StoredStart start = session.start();
  EXPECT_EQ(start.patient_title, "built-in patient, right");
  EXPECT_EQ(start.program_version, "0.1.0");
  EXPECT_EQ(start.dt_s, 0.001);
  EXPECT_EQ(start.grid, bone.grid);
  EXPECT_EQ(start.solid, bone.solid);
  EXPECT_EQ(start.label, bone.label);
  ASSERT_TRUE(start.calibration);
  EXPECT_EQ(calibrationText(*start.calibration),
            "red, 1.24 mm RMS of 16, 3 days old, used despite that: demonstration without a patient");
  EXPECT_EQ(start.calibration->rig, "5d41");
  EXPECT_EQ(start.calibration->rig_id, "rig-02");
  EXPECT_EQ(start.calibration->device_serial, "60623");
  EXPECT_EQ(start.calibration->max_mm, 2.5);
  EXPECT_EQ(start.calibration->checked_utc, "2026-11-19T08:20:00Z");

  const auto commands = session.commands();
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(commands[0].command.serial, 1u);
  EXPECT_EQ(commands[1].first_tick, 50u);
  ASSERT_EQ(session.events().size(), 1u);
  EXPECT_EQ(session.events()[0].text, "rehearsal");

  std::vector<haptics::Tick> ticks;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock())
    ticks.insert(ticks.end(), block.ticks.begin(), block.ticks.end());
  EXPECT_EQ(packTicks(ticks), packTicks(imaginedTicks(0, 80)));
}

TEST(SessionCalibration, IsSaidInOneLine) {
  SessionCalibration c;
  EXPECT_EQ(calibrationText(c), "none");
  c.rig = "default";
  EXPECT_EQ(calibrationText(c), "a default rig, not measured");
  c = {"5d41", "rig-02", "60623", "green", 16, 0.24, 0.41, 0.55, "2026-11-19T08:20:00Z", 1.9, ""};
  EXPECT_EQ(calibrationText(c), "green, 0.24 mm RMS of 16, 1 day old");
  c.age_days = 0.5;
  EXPECT_EQ(calibrationText(c), "green, 0.24 mm RMS of 16, measured today");
  c.age_days = -2.0;
  EXPECT_EQ(calibrationText(c), "green, 0.24 mm RMS of 16, dated in the future");
  c.verdict.clear(), c.age_days.reset();
  EXPECT_EQ(calibrationText(c), "never verified");
}

TEST(SessionFile, IsOneSingleFileOnceClosed) {
  const tests::ScratchFolder folder;
  writeSession(folder.file("s.molar"), true);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"s.molar"});
}

TEST(SessionFile, IsAnOrdinaryDatabaseForOtherTools) {
  const tests::ScratchFolder folder;
  writeSession(folder.file("s.molar"), true);
  SQLite::Database database(folder.file("s.molar"));
  EXPECT_EQ(database.execAndGet("PRAGMA integrity_check").getString(), "ok");
  EXPECT_EQ(database.execAndGet("SELECT sum(count) FROM tick_block").getInt(), 80);
}

/// Adds a row of these values to the end of an unclosed session, chained as a program after this one would.
void append(SQLite::Database& database, const std::string& table, const std::vector<ColumnValue>& values) {
  const auto last = [&](const char* what) {
    std::string rows;
    for (const session_format::Table& one : session_format::kTables)
      rows += (rows.empty() ? "" : " UNION ALL ") + std::string("SELECT row, digest FROM ") + std::string(one.name);
    return std::string("SELECT ") + what + " FROM (" + rows + ") ORDER BY row DESC LIMIT 1";
  };
  const std::int64_t row = database.execAndGet(last("row")).getInt64() + 1;
  const std::string before = database.execAndGet(last("digest")).getString();
  Digest previous{};
  std::ranges::copy(before, previous.begin());
  const Digest digest = chained(previous, row, table, values);
  std::string sql = "INSERT INTO " + table + " VALUES(?";
  for (std::size_t i = 0; i <= values.size(); ++i) sql += ",?";
  SQLite::Statement insert(database, sql + ")");
  insert.bind(1, row);
  int place = 2;
  for (const ColumnValue& value : values) {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) insert.bind(place, *integer);
    if (const auto* text = std::get_if<std::string_view>(&value)) insert.bind(place, std::string(*text));
    ++place;
  }
  insert.bind(place, digest.data(), static_cast<int>(digest.size()));
  insert.exec();
}

TEST(SessionFile, OfAProgramAfterThisOneIsReadAsFarAsItIsKnown) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  writeSession(path, false);
  {
    SQLite::Database database(path, SQLite::OPEN_READWRITE);
    // A column more in the table of events, and a table of its own.
    database.exec("PRAGMA writable_schema=ON");
    database.exec(
        "UPDATE sqlite_schema SET sql = replace(sql, 'text TEXT, digest', 'text TEXT, author TEXT, digest') WHERE name "
        "= "
        "'event'");
    database.exec("PRAGMA writable_schema=OFF");
  }
  {
    SQLite::Database database(path, SQLite::OPEN_READWRITE);
    database.exec("DELETE FROM event");
    database.exec("CREATE TABLE gaze(row INTEGER PRIMARY KEY, tick INTEGER, at TEXT, digest BLOB) STRICT");
    append(database, "event",
           {std::int64_t{7}, std::string_view("note"), std::string_view("x"), std::string_view("A")});
  }
  SessionReader session(path);
  ASSERT_EQ(session.events().size(), 1u);
  EXPECT_EQ(session.events()[0].tick, 7u);
  EXPECT_EQ(readEverything(session), 80u);
}

TEST(SessionFile, WithATickThatHasNoTimeIsRefusedInOneLine) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [t_s, dt_s] : {std::pair(kNan, 1e-3), std::pair(0.01, kNan), std::pair(-1.0, 1e-3),
                                  std::pair(1e30, 1e-3), std::pair(0.01, 2.0)}) {
    const tests::ScratchFolder folder;
    const std::string path = folder.file("s.molar");
    {
      SessionWriter writer(path, false, test::SmallBone().start());
      std::vector<haptics::Tick> ticks = imaginedTicks(0, 20);
      ticks[10].t_s = t_s;
      ticks[10].dt_s = dt_s;
      writer.write({{}, ticks, {}});
      writer.seal(0);
    }
    SessionReader session(path);
    EXPECT_FALSE(session.damage()) << "every byte as it was written";
    try {
      session.nextBlock();
      ADD_FAILURE() << t_s << " " << dt_s;
    } catch (const SessionError& error) {
      EXPECT_NE(std::string(error.what()).find("tick 10 has no time"), std::string::npos) << error.what();
    }
  }
}

TEST(SessionFile, HoldsAsManyTicksAsItsSealSays) {
  const tests::ScratchFolder folder;
  for (const std::uint64_t ticks : {80u, 130u}) {
    const std::string path = folder.file(std::to_string(ticks));
    writeSession(path, false);
    {
      SQLite::Database database(path, SQLite::OPEN_READWRITE);
      const std::string seal = sealText({ticks, 0, {}});
      append(database, "seal", {std::string_view(seal)});
    }
    EXPECT_EQ(SessionReader(path).damage().has_value(), ticks != 80);
  }
}

TEST(SessionFile, RefusesTablesThatReadingWouldRun) {
  const tests::ScratchFolder folder;
  for (const char* table :
       {"CREATE TABLE more(row INTEGER PRIMARY KEY, x TEXT AS (hex(zeroblob(1000000000))), digest BLOB) STRICT",
        "CREATE VIEW more AS SELECT 1", "CREATE TABLE more(row INTEGER PRIMARY KEY, x TEXT, digest BLOB)",
        "CREATE TRIGGER more AFTER INSERT ON event BEGIN DELETE FROM seal; END", "CREATE INDEX more ON event(tick)",
        "DROP TABLE event", "ALTER TABLE event DROP COLUMN text"}) {
    const std::string path = folder.file("s.molar");
    writeSession(path, false);
    SQLite::Database(path, SQLite::OPEN_READWRITE).exec(table);
    EXPECT_THROW(SessionReader{path}, SessionError) << table;
    for (const std::string& file : folder.names()) std::filesystem::remove(folder.file(file));
  }
}

TEST(SessionFile, SplitsABoneLargerThanARowMayHold) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  SessionStart start = test::SmallBone().start();
  start.grid = {{300, 300, 200}, 0.2, {0.0, 0.0, 0.0}};
  ASSERT_GT(start.grid.voxelCount(), session_format::kBonePartBytes);
  std::vector<std::uint8_t> solid(start.grid.voxelCount());
  for (std::size_t v = 0; v < solid.size(); ++v) solid[v] = static_cast<std::uint8_t>(v / 90'000);
  start.solid = solid, start.label = {};
  haptics::Bodies bone(start.grid, start.solid, start.label);
  haptics::ErosionStep step;
  step.loss.fill(1.0);
  haptics::carveSphere(bone.bones().front(), {{30.0, 30.0, 39.0}}, 1.5, step, 1);
  ASSERT_GT(bone.removedByTissue_mm3()[0], 1.0);
  {
    SessionWriter writer(path, false, start);
    writer.write({{}, imaginedTicks(0, 5), {}});
    writer.seal(0, &bone);
  }
  EXPECT_EQ(SQLite::Database(path).execAndGet("SELECT count(*) FROM bone_part").getInt(), 4)
      << "two volumes, two parts";
  SessionReader session(path);
  const StoredStart stored = session.start();
  EXPECT_EQ(stored.solid, solid);
  EXPECT_EQ(stored.label, std::vector<std::uint8_t>(solid.size())) << "unlabelled";
  const auto left = session.finalBone(stored);
  ASSERT_TRUE(left.has_value());
  EXPECT_EQ(left->solid, bone.solidInGridOrder());
  EXPECT_EQ(left->digest, bone.digest());
}

TEST(SessionFile, IsReadWithoutTouchingTheDisk) {
  const tests::ScratchFolder folder;
  writeSession(folder.file("s.molar"), true);
  const std::string before = bytesOf(folder.file("s.molar"));
  {
    SessionReader session(folder.file("s.molar"));
    readEverything(session);
    EXPECT_EQ(session.damage(), std::nullopt);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"s.molar"});
  }
  EXPECT_EQ(bytesOf(folder.file("s.molar")), before);
}

TEST(SessionFile, IsFoundWhateverItsName) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("a b?c#d%20é.molar");
  writeSession(path, true);
  SessionReader session(path);
  EXPECT_EQ(readEverything(session), 80u);
}

TEST(SessionFile, LeftByAKillIsWholeToItsLastWrite) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar"), log = path + "-wal";
  writeKilledSession(path);
  const std::string path_before = bytesOf(path), log_before = bytesOf(log);
  {
    SessionReader session(path);
    EXPECT_EQ(session.damage(), std::nullopt);
    EXPECT_FALSE(session.closed());
    EXPECT_EQ(readEverything(session), 200u);
  }
  EXPECT_EQ(bytesOf(path), path_before);
  EXPECT_EQ(bytesOf(log), log_before);
}

TEST(SessionFile, OverwritesNothingUnasked) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  writeBytes(path, "precious");
  const test::SmallBone bone;
  EXPECT_THROW(SessionWriter(path, false, bone.start()), SessionError);
  EXPECT_EQ(bytesOf(path), "precious");
  SessionWriter(path, true, bone.start()).seal(0);
  EXPECT_EQ(SessionReader(path).damage(), std::nullopt);
}

TEST(SessionFile, RefusesToStartOnTheLogOfAnother) {
  const tests::ScratchFolder folder;
  writeBytes(folder.file("s.molar-wal"), "the rest of a killed session");
  const test::SmallBone bone;
  EXPECT_THROW(SessionWriter(folder.file("s.molar"), false, bone.start()), SessionError);
}

TEST(SessionFile, LeavesNothingWhereItCanNotBeWritten) {
  const tests::ScratchFolder folder;
  const test::SmallBone bone;
  EXPECT_THROW(SessionWriter(folder.file("missing/s.molar"), false, bone.start()), SessionError);
  EXPECT_THROW(SessionWriter(folder.file(""), true, bone.start()), SessionError);
  EXPECT_TRUE(folder.names().empty());
}

TEST(SessionFile, IsRefusedInOneLineWhenItIsNone) {
  const tests::ScratchFolder folder;
  writeBytes(folder.file("text"),
             "not a database, but long enough to have a header of one hundred bytes, or so it "
             "seems to anybody who counts them one by one");
  writeBytes(folder.file("empty"), "");
  SQLite::Database(folder.file("other"), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec("CREATE TABLE t(x)");
  for (const char* name : {"text", "empty", "other", "missing", ""}) {
    try {
      SessionReader session(folder.file(name));
      ADD_FAILURE() << name << " was read";
    } catch (const SessionError& refusal) {
      EXPECT_EQ(std::string(refusal.what()).find('\n'), std::string::npos);
      EXPECT_NE(std::string(refusal.what()).find(folder.file(name)), std::string::npos) << refusal.what();
    }
  }
}

/// Whether reading finds something wrong.
bool isFoundOut(const std::string& path) {
  try {
    return SessionReader(path).damage().has_value();
  } catch (const SessionError&) {
    return true;
  }
}

TEST(SessionChain, FindsAnyChangedByteOfAClosedFile) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  writeSession(path, true);
  const std::string whole = bytesOf(path);
  ASSERT_FALSE(isFoundOut(path));
  std::mt19937 random(1);
  for (std::size_t at = 0; at < whole.size(); at += 1 + random() % 31) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ (1 << (random() % 8)));
    writeBytes(path, changed);
    ASSERT_TRUE(isFoundOut(path)) << "byte " << at << " of " << whole.size();
  }
}

TEST(SessionChain, FindsAnythingCutFromTheRowsOfAClosedFile) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  writeSession(path, true);
  const std::string whole = bytesOf(path);
  for (const std::size_t cut :
       {std::size_t{41}, std::size_t{552}, std::size_t{4136}, whole.size() / 2, whole.size() - 1, whole.size()}) {
    writeBytes(path, whole.substr(0, whole.size() - cut));
    EXPECT_TRUE(isFoundOut(path)) << cut << " bytes cut";
  }
}

TEST(SessionSeal, MissingOrCutShortByAPowerCutIsNoChange) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  writeSession(path, true);
  const std::string whole = bytesOf(path), rows = whole.substr(0, whole.size() - 40);
  EXPECT_FALSE(SessionReader(path).isUnsealed());
  const auto unsealed = [&](const std::string& bytes) {
    writeBytes(path, bytes);
    SessionReader session(path);
    EXPECT_EQ(session.damage(), std::nullopt);
    return session.closed() && session.isUnsealed();
  };
  EXPECT_TRUE(unsealed(rows));
  for (const std::size_t bytes : {1u, 7u, 8u, 30u, 39u}) EXPECT_TRUE(unsealed(whole.substr(0, rows.size() + bytes)));
  EXPECT_TRUE(unsealed(rows + std::string(40, '\0'))) << "grown, never written";
  EXPECT_TRUE(unsealed(rows + whole.substr(rows.size(), 12) + std::string(28, '\0')));
  // A seal of other bytes is none that was cut short.
  writeBytes(path, rows + "MOLRSEAL" + std::string(32, 'x'));
  EXPECT_TRUE(isFoundOut(path));
}

TEST(SessionChain, FindsAChangeInEveryColumnOfAKilledFile) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  writeSession(path, false);
  ASSERT_FALSE(isFoundOut(path));
  const std::string whole = bytesOf(path);
  for (const session_format::Table& table : session_format::kTables) {
    SQLite::Database schema(path, SQLite::OPEN_READONLY);
    SQLite::Statement columns(schema, "SELECT name, type FROM pragma_table_info('" + std::string(table.name) + "')");
    while (columns.executeStep()) {
      const std::string column = columns.getColumn(0).getString(), name(table.name), changed = path + ".changed";
      writeBytes(changed, whole);
      // One step up for a number, one character or bit for the rest; the first row of the table.
      const std::string other = "CASE typeof(" + column + ") WHEN 'blob' THEN substr(" + column + ", 1, length(" +
                                column + ") - 1) WHEN 'text' THEN 'x' || substr(" + column + ", 2) ELSE " + column +
                                " + 1000 END";
      SQLite::Database database(changed, SQLite::OPEN_READWRITE);
      const int rows =
          database.exec("UPDATE " + name + " SET " + column + " = CAST(" + other + " AS " +
                        columns.getColumn(1).getString() + ") WHERE row = (SELECT min(row) FROM " + name + ")");
      if (name != "seal") {
        EXPECT_EQ(rows, 1) << name;
      }
      if (rows == 1) {
        EXPECT_TRUE(isFoundOut(changed)) << name << "." << column;
      }
    }
  }
}

TEST(SessionChain, FindsARowTakenOutOrMoved) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar"), changed = folder.file("changed.molar");
  writeSession(path, false);
  for (const char* change :
       {"DELETE FROM event", "DELETE FROM command WHERE serial = 2", "DELETE FROM tick_block WHERE first_tick = 0",
        "UPDATE event SET row = 99", "INSERT INTO seal VALUES(0, '{}', x'00')", "CREATE TABLE extra(x)",
        "DELETE FROM meta", "DROP TABLE event", "INSERT INTO event SELECT 50, tick, kind, text, digest FROM event"}) {
    std::filesystem::copy_file(path, changed, std::filesystem::copy_options::overwrite_existing);
    SQLite::Database(changed, SQLite::OPEN_READWRITE).exec(change);
    EXPECT_TRUE(isFoundOut(changed)) << change;
  }
}

TEST(SessionChain, HoldsForEveryPrefixOfWrites) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  writeKilledSession(path);
  const std::string log = bytesOf(path + "-wal");
  std::uint64_t most = 0;
  // A log cut anywhere is a kill at that moment: what is left is whole, and no tick comes back different.
  for (std::size_t size = 32; size < log.size(); size += 1777) {
    writeBytes(path + "-wal", log.substr(0, size));
    try {
      SessionReader session(path);
      EXPECT_EQ(session.damage(), std::nullopt);
      most = std::max(most, readEverything(session));
    } catch (const SessionError&) {
      EXPECT_EQ(most, 0u) << "a longer log reads worse";
    }
  }
  EXPECT_GE(most, 160u);
}

}  // namespace
}  // namespace app
