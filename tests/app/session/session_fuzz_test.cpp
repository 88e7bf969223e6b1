// Damaged sessions of every schema: each is refused in one line, found to be changed, or read. As many as MOLAR_MUTANTS
// says.
#include <filesystem>

#include <gtest/gtest.h>

#include "app/session/command_keys.h"
#include "app/session/session_error.h"
#include "app/session/session_format.h"
#include "app/session/session_reader.h"
#include "app/session/session_writer.h"
#include "app/session/tick_columns.h"
#include "tests/app/session/small_session.h"
#include "tests/mutants.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using test::bytesOf;
using test::writeBytes;

constexpr std::uint64_t kUsual = 700;

void record(const std::string& path, bool closed) {
  const test::SmallBone bone;
  haptics::Bodies left(bone.grid, bone.solid, bone.label);
  SessionWriter writer(path, false, bone.start());
  haptics::Command louder;
  louder.serial = 2;
  writer.write({{}, test::imaginedTicks(0, 20), {{0, "start", "rehearsal"}}});
  writer.write({{{louder, 20}}, test::imaginedTicks(20, 10), {}});
  if (closed)
    writer.seal(0, &left);
  else
    for (const char* part : {"", "-wal"}) std::filesystem::copy_file(path + part, path + ".killed" + part);
}

void readToTheEnd(SessionReader& session) {
  const StoredStart start = session.start();
  session.commands();
  session.events();
  session.finalBone(start);
  while (!session.nextBlock().ticks.empty()) {
  }
}

/// Whether it was found out. What is no damage must be read to its end.
bool isRefused(const std::string& path) {
  try {
    SessionReader session(path);
    const bool damaged = session.damage().has_value();
    try {
      readToTheEnd(session);
    } catch (const SessionError& refusal) {
      EXPECT_TRUE(damaged) << refusal.what();
      throw;
    }
    return damaged;
  } catch (const SessionError& refusal) {
    EXPECT_EQ(std::string(refusal.what()).find('\n'), std::string::npos) << refusal.what();
    return true;
  }
}

TEST(SessionMutants, OfClosedFilesOfEverySchemaAreFoundOutOrWhole) {
  const tests::ScratchFolder folder;
  record(folder.file("s.molar"), true);
  const std::string recorded = MOLAR_RECORDED_SESSIONS;
  const std::vector<std::string> good = {bytesOf(folder.file("s.molar")), bytesOf(recorded + "/schema_3.molar"),
                                         bytesOf(recorded + "/schema_4.molar")};
  std::uint64_t refused = 0, tried = 0;
  mutants::forEachMutant(good, kUsual, [&](const std::string& mutant, std::size_t which, std::uint64_t) {
    writeBytes(folder.file("m.molar"), mutant);
    const bool found = isRefused(folder.file("m.molar"));
    // Cut at its seal it is whole; everything else that was changed is found.
    const bool seal_cut = mutant.size() < good[which].size() && good[which].starts_with(mutant) &&
                          mutant.size() + session_format::kTrailerBytes >= good[which].size();
    EXPECT_TRUE(found || mutant == good[which] || seal_cut);
    refused += found ? 1 : 0, ++tried;
  });
  EXPECT_GT(refused, tried / 2);
}

TEST(SessionMutants, OfAKilledRecordingAreReadOrRefused) {
  const tests::ScratchFolder folder;
  record(folder.file("s.molar"), false);
  const std::string killed = folder.file("s.molar.killed"), mutated = folder.file("m.molar");
  const std::vector<std::string> good = {bytesOf(killed), bytesOf(killed + "-wal")};
  mutants::forEachMutant(good, kUsual, [&](const std::string& mutant, std::size_t which, std::uint64_t) {
    writeBytes(mutated, which == 0 ? mutant : good[0]);
    writeBytes(mutated + "-wal", which == 1 ? mutant : good[1]);
    isRefused(mutated);
  });
}

/// What stands in the rows, past every checksum: as a stranger may have chained it.
TEST(SessionMutants, OfTextsAndBlocksAreReadOrRefused) {
  const test::SmallBone bone;
  haptics::Command command;
  command.serial = 3;
  const auto ticks = packTicks(test::imaginedTicks(0, 5));
  const std::vector<std::string> good = {
      commandText(command), aboutText(bone.start()), removedText({{"cortical", 1.5}, {"enamel", 2e-3}}),
      sealText({30, 2, 0x0330b2830389040du}), std::string(ticks.begin(), ticks.end())};
  mutants::forEachMutant(good, 10 * kUsual, [&](const std::string& mutant, std::size_t which, std::uint64_t) {
    try {
      if (which == 0) commandText(commandFromText(mutant));
      if (which == 1) refuseInvalidGrid(aboutFromText(mutant).start.grid);
      if (which == 2) removedText(removedFromText(mutant));
      if (which == 3) sealText(sealFromText(mutant));
      if (which == 4) TickUnpacker(tickColumns()).unpack(std::vector<std::uint8_t>(mutant.begin(), mutant.end()));
    } catch (const SessionError& refusal) {
      EXPECT_EQ(std::string(refusal.what()).find('\n'), std::string::npos) << refusal.what();
    }
  });
}

}  // namespace
}  // namespace app
