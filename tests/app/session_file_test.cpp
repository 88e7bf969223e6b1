#include <filesystem>

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include "app/session/chain.h"
#include "app/session/packing.h"
#include "app/session/session_error.h"
#include "app/session/session_format.h"
#include "app/session/session_reader.h"
#include "app/session/session_writer.h"
#include "tests/app/small_session.h"

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
  writer.write({{}, imaginedTicks(0, 50), {{0, "start", "rehearsal"}}, {}});
  writer.write({{{louder, 50}}, imaginedTicks(50, 30), {}, {{79, "left.png", {1, 2, 3}}}});
  if (closed) writer.seal(0);
}

/// What a killed program leaves: database and log as they are at this moment.
void writeKilledSession(const std::string& path) {
  const std::string live = path + ".live";
  const test::SmallBone bone;
  SessionWriter writer(live, false, bone.start());
  for (std::uint64_t i = 0; i < 10; ++i) writer.write({{}, imaginedTicks(20 * i, 20), {{20 * i, "mark", "x"}}, {}});
  std::filesystem::copy_file(live, path);
  std::filesystem::copy_file(live + "-wal", path + "-wal");
}

std::uint64_t readEverything(SessionReader& session) {
  session.start();
  session.commands();
  session.events();
  session.pictures();
  std::uint64_t ticks = 0;
  for (auto block = session.nextTicks(); !block.empty(); block = session.nextTicks()) ticks += block.size();
  return ticks;
}

TEST(SessionFile, GivesBackWhatWasWritten) {
  const test::ScratchFolder folder;
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
  EXPECT_EQ(calibrationWords(*start.calibration),
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
  ASSERT_EQ(session.pictures().size(), 1u);
  EXPECT_EQ(session.pictures()[0].bytes, (std::vector<std::uint8_t>{1, 2, 3}));

  std::vector<haptics::Tick> ticks;
  for (auto block = session.nextTicks(); !block.empty(); block = session.nextTicks()) {
    ticks.insert(ticks.end(), block.begin(), block.end());
  }
  EXPECT_EQ(packTicks(ticks), packTicks(imaginedTicks(0, 80)));
}

TEST(SessionCalibration, IsSaidInOneLine) {
  SessionCalibration c;
  EXPECT_EQ(calibrationWords(c), "none");
  c.rig = "default";
  EXPECT_EQ(calibrationWords(c), "a default rig, not measured");
  c = {"5d41", "rig-02", "60623", "green", 16, 0.24, 0.41, 0.55, "2026-11-19T08:20:00Z", 1.9, ""};
  EXPECT_EQ(calibrationWords(c), "green, 0.24 mm RMS of 16, 1 day old");
  c.age_days = 0.5;
  EXPECT_EQ(calibrationWords(c), "green, 0.24 mm RMS of 16, of today");
  c.age_days = -2.0;
  EXPECT_EQ(calibrationWords(c), "green, 0.24 mm RMS of 16, dated in the future");
  c.verdict.clear(), c.age_days.reset();
  EXPECT_EQ(calibrationWords(c), "never proved");
}

/// As the program before wrote it: without the calibration, the rows numbered and chained anew.
void writeAsSchema3(const std::string& newer, const std::string& older) {
  SQLite::Database from(newer, SQLite::OPEN_READONLY);
  SQLite::Database to(older, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  to.exec("PRAGMA application_id=" + std::to_string(session_format::kApplicationId));
  for (const auto& table : session_format::tablesOf(3)) to.exec(std::string(table.create));
  Digest last{};
  std::int64_t number = 0;
  const auto rows = from.execAndGet(
                            "SELECT max(row) FROM (SELECT max(row) AS row FROM event UNION SELECT max(row) FROM "
                            "tick_block UNION SELECT max(row) FROM picture)")
                        .getInt64();
  for (std::int64_t row = 0; row <= rows; ++row)
    for (const auto& table : session_format::tablesOf(3)) {
      SQLite::Statement one(from, "SELECT * FROM " + std::string(table.name) + " WHERE row = " + std::to_string(row));
      if (!one.executeStep()) continue;
      std::vector<ColumnValue> values;
      std::vector<SQLite::Column> kept;
      for (int i = 1; i < one.getColumnCount() - 1; ++i) kept.push_back(one.getColumn(i));
      std::string sql = "INSERT INTO " + std::string(table.name) + " VALUES(?";
      for (const SQLite::Column& column : kept) {
        if (column.isInteger())
          values.emplace_back(table.name == "meta" ? std::int64_t{3} : column.getInt64());
        else if (column.isFloat())
          values.emplace_back(column.getDouble());
        else if (column.isText())
          values.emplace_back(std::string_view(column.getText(), static_cast<std::size_t>(column.getBytes())));
        else
          values.emplace_back(std::span(static_cast<const std::uint8_t*>(column.getBlob()),
                                        static_cast<std::size_t>(column.getBytes())));
        sql += ",?";
      }
      last = chained(last, number, table.name, values);
      SQLite::Statement insert(to, sql + ",?)");
      insert.bind(1, number++);
      for (std::size_t i = 0; i < values.size(); ++i) {
        const int place = static_cast<int>(i) + 2;
        if (const auto* integer = std::get_if<std::int64_t>(&values[i])) insert.bind(place, *integer);
        if (const auto* real = std::get_if<double>(&values[i])) insert.bind(place, *real);
        if (const auto* text = std::get_if<std::string_view>(&values[i])) insert.bind(place, std::string(*text));
        if (const auto* blob = std::get_if<std::span<const std::uint8_t>>(&values[i]))
          insert.bind(place, blob->data(), static_cast<int>(blob->size()));
      }
      insert.bind(static_cast<int>(values.size()) + 2, last.data(), static_cast<int>(last.size()));
      insert.exec();
    }
}

TEST(SessionFile, OfTheProgramBeforeIsStillRead) {
  const test::ScratchFolder folder;
  writeSession(folder.file("now.molar"), false);
  writeAsSchema3(folder.file("now.molar"), folder.file("before.molar"));
  SessionReader session(folder.file("before.molar"));
  EXPECT_EQ(session.damage(), std::nullopt);
  EXPECT_EQ(session.start().calibration, std::nullopt);
  EXPECT_EQ(session.start().patient_title, "built-in patient, right");
  EXPECT_EQ(readEverything(session), 80u);
}

TEST(SessionFile, IsOneSingleFileOnceClosed) {
  const test::ScratchFolder folder;
  writeSession(folder.file("s.molar"), true);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"s.molar"});
}

TEST(SessionFile, IsAnOrdinaryDatabaseForOtherTools) {
  const test::ScratchFolder folder;
  writeSession(folder.file("s.molar"), true);
  SQLite::Database database(folder.file("s.molar"));
  EXPECT_EQ(database.execAndGet("PRAGMA integrity_check").getString(), "ok");
  EXPECT_EQ(database.execAndGet("SELECT sum(count) FROM tick_block").getInt(), 80);
}

TEST(SessionFile, IsReadWithoutTouchingTheDisk) {
  const test::ScratchFolder folder;
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
  const test::ScratchFolder folder;
  const std::string path = folder.file("a b?c#d%20é.molar");
  writeSession(path, true);
  SessionReader session(path);
  EXPECT_EQ(readEverything(session), 80u);
}

TEST(SessionFile, LeftByAKillIsWholeToItsLastWrite) {
  const test::ScratchFolder folder;
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
  const test::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  writeBytes(path, "precious");
  const test::SmallBone bone;
  EXPECT_THROW(SessionWriter(path, false, bone.start()), SessionError);
  EXPECT_EQ(bytesOf(path), "precious");
  SessionWriter(path, true, bone.start()).seal(0);
  EXPECT_EQ(SessionReader(path).damage(), std::nullopt);
}

TEST(SessionFile, RefusesToStartOnTheLogOfAnother) {
  const test::ScratchFolder folder;
  writeBytes(folder.file("s.molar-wal"), "the rest of a killed session");
  const test::SmallBone bone;
  EXPECT_THROW(SessionWriter(folder.file("s.molar"), false, bone.start()), SessionError);
}

TEST(SessionFile, LeavesNothingWhereItCanNotBeWritten) {
  const test::ScratchFolder folder;
  const test::SmallBone bone;
  EXPECT_THROW(SessionWriter(folder.file("missing/s.molar"), false, bone.start()), SessionError);
  EXPECT_THROW(SessionWriter(folder.file(""), true, bone.start()), SessionError);
  EXPECT_TRUE(folder.names().empty());
}

TEST(SessionFile, IsRefusedInOneLineWhenItIsNone) {
  const test::ScratchFolder folder;
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
  const test::ScratchFolder folder;
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

TEST(SessionChain, FindsAnythingCutFromAClosedFile) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  writeSession(path, true);
  const std::string whole = bytesOf(path);
  for (const std::size_t cut : {std::size_t{1}, std::size_t{8}, std::size_t{40}, std::size_t{41}, std::size_t{4136},
                                whole.size() / 2, whole.size() - 1, whole.size()}) {
    writeBytes(path, whole.substr(0, whole.size() - cut));
    EXPECT_TRUE(isFoundOut(path)) << cut << " bytes cut";
  }
}

TEST(SessionChain, FindsAChangeInEveryColumnOfAKilledFile) {
  const test::ScratchFolder folder;
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
  const test::ScratchFolder folder;
  const std::string path = folder.file("s.molar"), changed = folder.file("changed.molar");
  writeSession(path, false);
  for (const char* change :
       {"DELETE FROM event", "DELETE FROM command WHERE serial = 2", "DELETE FROM tick_block WHERE first_tick = 0",
        "UPDATE event SET row = 99", "INSERT INTO seal VALUES(0, 0, 0, x'00')", "CREATE TABLE extra(x)",
        "DELETE FROM meta", "DROP TABLE picture", "INSERT INTO event SELECT 50, tick, kind, text, digest FROM event"}) {
    std::filesystem::copy_file(path, changed, std::filesystem::copy_options::overwrite_existing);
    SQLite::Database(changed, SQLite::OPEN_READWRITE).exec(change);
    EXPECT_TRUE(isFoundOut(changed)) << change;
  }
}

TEST(SessionChain, HoldsForEveryPrefixOfWrites) {
  const test::ScratchFolder folder;
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

TEST(SessionFuzz, MutatedFilesAreReadOrRefusedButNeverCrash) {
  const test::ScratchFolder folder;
  const std::string closed = folder.file("closed.molar"), killed = folder.file("killed.molar");
  writeSession(closed, true);
  writeKilledSession(killed);
  const std::string mutated = folder.file("m.molar");
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 1500; ++i) {
    const bool with_log = i % 3 == 0;
    std::string bytes = bytesOf(with_log ? killed : closed), log = with_log ? bytesOf(killed + "-wal") : "";
    std::string& target = with_log && i % 2 == 0 ? log : bytes;
    const std::size_t changes = 1 + random() % 12;
    for (std::size_t c = 0; c < changes; ++c) {
      const std::size_t at = random() % target.size();
      switch (random() % 4) {
        case 0:
          target[at] = static_cast<char>(random());
          break;
        case 1:
          target[at % 200] = static_cast<char>(random());
          break;
        case 2:
          target.replace(at, 16, target, random() % target.size(), 16);
          break;
        default:
          target[at] = static_cast<char>(random() % 2 == 0 ? 0xff : 0x00);
      }
    }
    if (i % 10 == 0) target.resize(random() % target.size());
    writeBytes(mutated, bytes);
    std::filesystem::remove(mutated + "-wal");
    std::filesystem::remove(mutated + "-shm");
    if (with_log) writeBytes(mutated + "-wal", log);
    try {
      SessionReader session(mutated);
      refused += session.damage().has_value() ? 1 : 0;
      readEverything(session);
    } catch (const SessionError& refusal) {
      ++refused;
      ASSERT_EQ(std::string(refusal.what()).find('\n'), std::string::npos) << refusal.what();
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace app
