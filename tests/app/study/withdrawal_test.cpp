#include "app/study/withdrawal.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "app/study/audit.h"
#include "app/study/privacy/session_seal.h"
#include "app/study/sealed_events.h"
#include "app/study/study_folder.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "calibration/record/utc.h"
#include "tests/refusal.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

namespace fs = std::filesystem;

const std::int64_t kNoon_s = *calibration::secondsOfUtc("2026-11-28T12:00:00Z");

class WithdrawalTest : public testing::Test {
 protected:
  WithdrawalTest() { fs::create_directory(study_); }

  std::string bytesOf(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(study_ + "/" + name, std::ios::binary).rdbuf();
    return text.str();
  }
  bool has(const std::string& name) const { return fs::exists(study_ + "/" + name); }
  void put(const std::string& name, const std::string& text) const { std::ofstream(study_ + "/" + name) << text; }

  /// As a session leaves it: a log, tables, sound, a picture, a recording.
  void addSession(const std::string& name, bool is_sealed, const std::string& stopped_utc = "2026-11-28T10:00:00Z",
                  std::int64_t days = 30) const {
    const std::string folder = study_ + "/" + name, participant = name.substr(0, 3);
    fs::create_directory(folder);
    std::optional<SessionSeal> seal;
    if (is_sealed) seal.emplace(owner_.publicKeys(), folder, name);
    const std::vector<LogEvent> events{
        {1, {}, "system", "session.start", {{"participant", participant}, {"visit", std::int64_t{1}}}},
        {2,
         5,
         "evaluator",
         "note",
         {{"kind", std::string("comment")}, {"text", std::string("gryphon " + participant)}}},
        {3,
         6,
         "evaluator",
         "problem",
         {{"problem", std::string("pedal")}, {"title", std::string("gryphon pedal")}, {"severity", std::int64_t{3}}}},
        {4,
         {},
         "participant",
         "answer",
         {{"questionnaire", std::string("tlx-raw")}, {"item", std::string("effort")}, {"value", std::int64_t{77}}}},
        {5, {}, "system", "session.stop", {{"retention_days", days}, {"utc", stopped_utc}}}};
    SessionLogWriter log(folder + "/events.jsonl");
    for (std::size_t row = 0; row < events.size(); ++row)
      log.add(seal ? sealedEvent(*seal, events[row], row) : events[row]);
    put(name + "/session.molar", "recording");
    put(name + "/tasks.csv", "participant,task,result\n" + participant + ",open,success\n");
    put(name + "/picture.png", "pixels");
    fs::create_directory(folder + "/voice");
    put(name + "/voice/000000.flac", "sound");
    put(name + "/session.bookmarks.json", "gryphon");
    if (is_sealed) return;
    put(name + "/problems.csv", "problem,title,participant,severity\npedal,gryphon pedal," + participant + ",3\n");
    put(name + "/answers-tlx-raw.csv", "participant,effort\n" + participant + ",77\n");
  }
  std::vector<Removal> takeBack(const std::string& participant, const std::string& stream) const {
    auto removals = withdrawalOf(study_, participant, stream);
    withdraw(study_, participant, stream, removals, kNoon_s);
    return removals;
  }
  /// Everything of the study, names and bytes.
  std::string everything() const {
    std::string all;
    for (const auto& entry : fs::recursive_directory_iterator(study_))
      if (entry.is_regular_file()) all += entry.path().string() + bytesOf(fs::relative(entry.path(), study_).string());
    return all;
  }

  const tests::ScratchFolder folder_;
  const std::string study_ = folder_.file("study");
  const PrivateStudyKeys owner_{SecretKey::random()};
};

TEST_F(WithdrawalTest, OfASealedStreamTheKeyGoesAndTheChainStays) {
  addSession("P07-1", true), addSession("P08-1", true);
  const std::string log = bytesOf("P07-1/events.jsonl");
  EXPECT_EQ(everything().find("gryphon P07"), std::string::npos);
  const auto removals = takeBack("P07", "words");
  ASSERT_EQ(removals.size(), 1u);
  EXPECT_EQ(joined(removals[0].files), "keys/words.key, session.bookmarks.json");
  EXPECT_FALSE(removals[0].rewrites_log);
  EXPECT_EQ(bytesOf("P07-1/events.jsonl"), log) << "no byte of the chain";
  EXPECT_EQ(bytesOf("P07-1/session.molar"), "recording");
  EXPECT_TRUE(has("P07-1/voice/000000.flac"));
  std::vector<std::string> remarks;
  const auto tables = tablesOf(study_, sessionsIn(study_)[0], &owner_, remarks);
  EXPECT_FALSE(tables.contains("problems.csv"));
  EXPECT_TRUE(tables.contains("answers-tlx-raw.csv")) << "another stream";
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0], "P07-1: words and answers of 2 rows are closed: withdrawn, or sealed to another study");
  // The other participant's.
  remarks.clear();
  EXPECT_TRUE(tablesOf(study_, sessionsIn(study_)[1], &owner_, remarks).contains("problems.csv"));
  EXPECT_TRUE(remarks.empty());
}

TEST_F(WithdrawalTest, EachStreamTakesItsOwn) {
  const std::vector<std::pair<std::string, std::string>> taken{
      {"audio", "keys/audio.key, voice/"},
      {"words", "keys/words.key, session.bookmarks.json"},
      {"answers", "keys/answers.key"},
      {"picture", "picture.png"},
      {"all", "keys/words.key, keys/audio.key, keys/answers.key, picture.png, session.bookmarks.json, voice/"}};
  for (const auto& [stream, files] : taken) {
    fs::remove_all(study_ + "/P07-1");
    addSession("P07-1", true);
    const auto removals = takeBack("P07", stream);
    ASSERT_EQ(removals.size(), 1u);
    EXPECT_EQ(joined(removals[0].files), files) << stream;
    for (const std::string& file : removals[0].files) EXPECT_FALSE(has("P07-1/" + file));
    EXPECT_TRUE(has("P07-1/session.molar") && has("P07-1/tasks.csv"));
    EXPECT_TRUE(withdrawalOf(study_, "P07", stream).empty()) << "nothing is left of it";
  }
}

TEST_F(WithdrawalTest, OpenWordsAreTakenOutOfTheLogAndTheAuditSaysSo) {
  addSession("P07-1", false), addSession("P07-2", false);
  const std::string before = readSessionLog(study_ + "/P07-1/events.jsonl").digest;
  takeBack("P07", "all");
  EXPECT_EQ(everything().find("gryphon"), std::string::npos);
  const SessionLog log = readSessionLog(study_ + "/P07-1/events.jsonl");
  EXPECT_EQ(log.damage, std::nullopt);
  ASSERT_EQ(log.events.size(), 5u) << "the rows stay";
  EXPECT_EQ(log.events[1].t_ns, 2);
  EXPECT_EQ(log.events[2].number("severity"), 3.0);
  EXPECT_EQ(log.events[3].number("value"), std::nullopt);
  const SessionLog audited = readSessionLog(study_ + "/audit.jsonl");
  ASSERT_EQ(audited.events.size(), 3u);
  EXPECT_EQ(audited.events[0].type, "withdraw");
  EXPECT_EQ(audited.events[0].textOr("sessions"), "P07-1, P07-2");
  EXPECT_EQ(audited.events[1].textOr("digest_before"), before);
  EXPECT_EQ(audited.events[1].textOr("digest_after"), log.digest);
  EXPECT_EQ(audited.events[1].textOr("utc"), "2026-11-28T12:00:00Z");
}

TEST_F(WithdrawalTest, OfNobodyIsRefused) {
  addSession("P07-1", true);
  EXPECT_NE(tests::refusalOf<UsageError>([&] { withdrawalOf(study_, "P09", "all"); }).find("P09 is in no session"),
            std::string::npos);
}

TEST_F(WithdrawalTest, RetentionCountsFromTheStop) {
  addSession("P01-1", true, "2026-10-29T12:00:00Z", 30);  // to the second 30 days before noon
  addSession("P02-1", true, "2026-10-29T12:00:01Z", 30);
  addSession("P03-1", false, "2026-11-27T11:00:00Z", 1);
  const auto expired = expiredSessions(study_, kNoon_s);
  EXPECT_EQ(joined(expired, &Expired::session), "P01-1, P03-1");
  EXPECT_EQ(expired[0].stopped_utc, "2026-10-29T12:00:00Z");
  removeExpired(study_, expired, kNoon_s);
  EXPECT_FALSE(has("P01-1") || has("P03-1"));
  EXPECT_TRUE(has("P02-1"));
  const SessionLog audited = readSessionLog(study_ + "/audit.jsonl");
  ASSERT_EQ(audited.events.size(), 2u);
  EXPECT_EQ(audited.events[1].textOr("session"), "P03-1");
  EXPECT_EQ(audited.events[1].number("retention_days"), 1.0);
}

TEST_F(WithdrawalTest, AnInterruptedSessionIsOfTheTimeItWasWritten) {
  addSession("P01-1", true);
  const std::string log = study_ + "/P01-1/events.jsonl", text = bytesOf("P01-1/events.jsonl");
  put("P01-1/events.jsonl", text.substr(0, text.find('\n') + 1));
  EXPECT_TRUE(expiredSessions(study_, nowUnix_s()).empty());
  constexpr std::int64_t kYear_s = 365 * 86'400;
  ASSERT_EQ(expiredSessions(study_, nowUnix_s() + kYear_s + 60).size(), 1u);
}

TEST_F(WithdrawalTest, AClockThatWentBackRemovesNothing) {
  addSession("P01-1", true, "2020-01-01T00:00:00Z", 1);
  audit(study_, kNoon_s, "export", {});
  EXPECT_NE(tests::refusalOf<UsageError>([&] { expiredSessions(study_, kNoon_s - 1); }).find("set the clock"),
            std::string::npos);
  EXPECT_EQ(expiredSessions(study_, kNoon_s).size(), 1u);
}

TEST_F(WithdrawalTest, AnAuditThatWasChangedIsFound) {
  audit(study_, kNoon_s, "export", {{"sessions", std::string("P07-1")}});
  audit(study_, kNoon_s, "export", {});
  std::string text = bytesOf("audit.jsonl");
  text.replace(text.find("P07"), 3, "P08");
  put("audit.jsonl", text);
  EXPECT_THROW(audit(study_, kNoon_s, "export", {}), assets::LoadError);
  EXPECT_THROW(newestAudit_s(study_), assets::LoadError);
}

TEST_F(WithdrawalTest, AnAuditLineThatAKillCutOffIsWrittenOver) {
  audit(study_, kNoon_s, "export", {});
  put("audit.jsonl", bytesOf("audit.jsonl") + R"({"seq":1,"t_n)");
  audit(study_, kNoon_s, "keys", {});
  const SessionLog audited = readSessionLog(study_ + "/audit.jsonl");
  EXPECT_EQ(audited.damage, std::nullopt);
  ASSERT_EQ(audited.events.size(), 2u);
  EXPECT_EQ(audited.events[1].type, "keys");
}

}  // namespace
}  // namespace app
