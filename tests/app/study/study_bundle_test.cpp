#include "app/study/bundle/study_bundle.h"

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/study/bundle/bundle_check.h"
#include "app/study/privacy/session_seal.h"
#include "app/study/sealed_events.h"
#include "app/study/session_log.h"
#include "app/study/withdrawal.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "tests/mutants.h"
#include "tests/refusal.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

namespace fs = std::filesystem;

std::string readWhole(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}
void writeWhole(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

/// Of every file in it, unpacked, and of the file itself.
std::string everythingIn(const std::string& bundle) {
  const ZipReader zip(bundle);
  std::string all = readWhole(bundle);
  for (const std::string& name : zip.names()) all += name + "\n" + zip.text(name, 1U << 26U).value_or("");
  return all;
}

TEST(ZipFile, IsTheSameBytesOfTheSameContents) {
  const tests::ScratchFolder folder;
  writeWhole(folder.file("recording"), std::string(300'000, 'r'));
  const std::vector<ZipEntry> entries{
      {"b.txt", "bravo", ""}, {"a/ö.txt", std::string(10'000, 'a'), ""}, {"r", "", folder.file("recording")}};
  writeZip(folder.file("1.zip"), entries);
  fs::last_write_time(folder.file("recording"), fs::file_time_type::clock::now() - std::chrono::hours(99));
  writeZip(folder.file("2.zip"), {entries[2], entries[0], entries[1]});
  const std::string bytes = readWhole(folder.file("1.zip"));
  EXPECT_EQ(readWhole(folder.file("2.zip")), bytes);
  EXPECT_EQ(zipSeal(folder.file("1.zip")), ZipSeal::intact);
  const ZipReader zip(folder.file("1.zip"));
  EXPECT_EQ(zip.names(), (std::vector<std::string>{"a/ö.txt", "b.txt", "r"}));
  EXPECT_EQ(zip.text("b.txt", 5), "bravo");
  EXPECT_EQ(zip.text("b.txt", 4), std::nullopt) << "longer than it may be";
  EXPECT_EQ(zip.text("r", 1U << 20U), std::string(300'000, 'r'));
  EXPECT_EQ(zip.text("c.txt", 5), std::nullopt);
}

class BundleCheckTest : public testing::Test {
 protected:
  std::vector<ZipEntry> made(const PrivateStudyKeys* owner) const {
    return withManifest({{"report.html", "<p>report</p>", ""}, {"sessions/P07-1/tasks.csv", "participant\nP07\n", ""}},
                        {"P07-1"}, owner);
  }
  std::vector<std::string> wrong(std::vector<ZipEntry> entries,
                                 const std::optional<PublicStudyKeys>& known = {}) const {
    writeZip(path_, std::move(entries));
    return checkBundle(path_, known).wrong;
  }
  static ZipEntry& named(std::vector<ZipEntry>& entries, const std::string& name) {
    return *std::ranges::find(entries, name, &ZipEntry::name);
  }
  using Lines = std::vector<std::string>;

  const tests::ScratchFolder folder_;
  const std::string path_ = folder_.file("F.zip");
  const PrivateStudyKeys owner_{SecretKey::random()}, stranger_{SecretKey::random()};
};

TEST_F(BundleCheckTest, NamesWhatWasChangedMissingOrAdded) {
  EXPECT_EQ(wrong(made(&owner_)), Lines());
  EXPECT_EQ(wrong(made(&owner_), owner_.publicKeys()), Lines());
  EXPECT_EQ(checkBundle(path_).signed_by, owner_.publicKeys());
  EXPECT_EQ(checkBundle(path_).files, 2u);
  auto changed = made(&owner_);
  named(changed, "report.html").bytes[3] = 'R';
  EXPECT_EQ(wrong(changed), Lines{"report.html was changed"});
  auto longer = made(nullptr);
  named(longer, "report.html").bytes += " ";
  EXPECT_EQ(wrong(longer), Lines{"report.html was changed"});
  auto missing = made(&owner_);
  std::erase_if(missing, [](const ZipEntry& one) { return one.name == "report.html"; });
  EXPECT_EQ(wrong(missing), Lines{"report.html is missing"});
  auto added = made(&owner_);
  added.push_back({"virus\n.txt", "x", ""});
  EXPECT_EQ(wrong(added), Lines{"virus?.txt was added"});
}

TEST_F(BundleCheckTest, ASignatureIsOfTheManifestAndTheKey) {
  // Manifest and file changed together: the hashes hold, the signature does not.
  auto forged = made(&owner_);
  auto others = withManifest({{"report.html", "forged", ""}, {"sessions/P07-1/tasks.csv", "participant\nP07\n", ""}},
                             {"P07-1"}, &owner_);
  named(others, "manifest.sig").bytes = named(forged, "manifest.sig").bytes;
  EXPECT_EQ(wrong(others), Lines{"manifest.json does not fit its signature"});
  EXPECT_EQ(wrong(made(&stranger_)), Lines());
  EXPECT_EQ(wrong(made(&stranger_), owner_.publicKeys()), Lines{"manifest.json is signed by another key"});
  EXPECT_EQ(wrong(made(nullptr)), Lines()) << "unsigned, and says so";
  EXPECT_EQ(checkBundle(path_).signed_by, std::nullopt);
  EXPECT_EQ(wrong(made(nullptr), owner_.publicKeys()), Lines{"manifest.sig is missing"});
  auto unsigned_now = made(&owner_);
  std::erase_if(unsigned_now, [](const ZipEntry& one) { return one.name == "manifest.sig"; });
  EXPECT_EQ(wrong(unsigned_now), Lines{"manifest.sig is missing"});
}

TEST_F(BundleCheckTest, OneChangedByteIsFoundWhereverItIs) {
  writeZip(path_, made(&owner_));
  const std::string good = readWhole(path_);
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string changed = good;
    changed[at] = static_cast<char>(changed[at] ^ (1 << at % 8));
    writeWhole(path_, changed);
    try {
      EXPECT_FALSE(checkBundle(path_).wrong.empty()) << at;
    } catch (const assets::LoadError&) {
      EXPECT_GE(at, good.size() - 90) << "its mark was changed";
    }
  }
}

TEST_F(BundleCheckTest, MutantsAreJudgedInLines) {
  writeZip(path_, made(&owner_));
  const std::vector<std::string> good{readWhole(path_)};
  mutants::forEachMutant(good, 2000, [&](const std::string& mutant, std::size_t which, std::uint64_t) {
    writeWhole(path_, mutant);
    const std::string refusal = tests::refusalOf<assets::LoadError>(
        [&] { EXPECT_EQ(checkBundle(path_).wrong.empty(), mutant == good[which]); });
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
  });
}

/// Names that must not be found in anything that leaves the house.
const std::vector<std::string> kCanaries{
    "Aldebaran", "Betelgeuse", "Canopus", "Denebola", "Elnath", "Fomalhaut", "Gacrux", "Hamal",   "Izar",   "Jabbah",
    "Kochab",    "Larawag",    "Mirfak",  "Naos",     "Okab",   "Procyon",   "Quaoar", "Regulus", "Sirius", "Tarazed"};

class StudyBundleTest : public testing::Test {
 protected:
  StudyBundleTest() {
    fs::create_directories(study_);
    publishKeys();
    addSession("P07-1", "surgeon", "gryphon of P07");
    addSession("P08-1", "student", kCanaries[2]);
  }

  void publishKeys() const { writeWhole(study_ + "/" + kStudyKeysName, textOf(owner_.publicKeys())); }
  /// A sealed session as it is left, with canaries in all that must stay.
  void addSession(const std::string& name, const std::string& group, const std::string& words) const {
    const std::string place = study_ + "/" + name, participant = name.substr(0, 3);
    fs::create_directories(place + "/voice");
    const SessionSeal seal(owner_.publicKeys(), place, name);
    const std::vector<LogEvent> events{
        {1,
         {},
         "system",
         "session.start",
         {{"participant", participant},
          {"group", group},
          {"evaluator", std::string("E1")},
          {"visit", std::int64_t{1}}}},
        {2, {}, "participant", "consent", {{"stream", std::string("quotes")}, {"given", true}}},
        {1'500'000'002,
         5,
         "evaluator",
         "note",
         {{"kind", std::string("comment")}, {"text", "=" + words}, {"severity", std::int64_t{3}}}},
        {4,
         6,
         "evaluator",
         "problem",
         {{"problem", std::string("pedal")},
          {"title", std::string("The pedal is not found")},
          {"task", std::string("open")},
          {"severity", std::int64_t{3}}}},
        {5,
         {},
         "participant",
         "answer",
         {{"questionnaire", std::string("tlx-raw")}, {"item", std::string("effort")}, {"value", std::int64_t{77}}}},
        {6, {}, "system", "verified", {{"recording", true}, {"rules_deviate", std::int64_t{0}}}},
        {7,
         {},
         "system",
         "session.stop",
         {{"retention_days", std::int64_t{30}}, {"utc", std::string("2026-11-28T10:00:00Z")}}}};
    SessionLogWriter log(place + "/events.jsonl");
    for (std::size_t row = 0; row < events.size(); ++row) log.add(sealedEvent(seal, events[row], row));
    writeWhole(place + "/session.molar", "recording");
    writeWhole(place + "/template.toml",
               "title = \"Trough\"\n[[task]]\nid = \"open\"\nsay = \"Open it\"\ntime_box_s = 480.5\nsuccess = "
               "\"O1.removed >= 2 mm3\"\n");
    writeWhole(place + "/tasks.csv", "participant,task,result,time_s\n" + participant + ",open,success,12.5\n");
    for (std::size_t n = 3; n < 8; ++n) writeWhole(place + "/voice/" + kCanaries[n] + ".flac", kCanaries[n]);
    writeWhole(place + "/" + kCanaries[8] + ".png", kCanaries[9]);
    writeWhole(place + "/session.bookmarks.json", kCanaries[10]);
    writeWhole(place + "/scribble.txt", kCanaries[11]);
  }
  std::string bundle(const PrivateStudyKeys* owner, const std::string& session = "") const {
    const std::string file = folder_.file("out.zip");
    writeBundle(study_, session, owner, file, true);
    return file;
  }

  const tests::ScratchFolder folder_;
  /// The study's own place is a canary, too.
  const std::string study_ = folder_.file(kCanaries[0] + "/" + kCanaries[1]);
  const PrivateStudyKeys owner_{SecretKey::random()};
};

TEST_F(StudyBundleTest, HoldsReportTablesAndRecordings) {
  const ZipReader zip(bundle(&owner_));
  EXPECT_EQ(zip.names(),
            (std::vector<std::string>{
                "manifest.json", "manifest.sig", "report.html", "sessions/P07-1/answers-tlx-raw.csv",
                "sessions/P07-1/events.jsonl", "sessions/P07-1/notes.csv", "sessions/P07-1/problems.csv",
                "sessions/P07-1/session.molar", "sessions/P07-1/tasks.csv", "sessions/P07-1/template.toml",
                "sessions/P08-1/answers-tlx-raw.csv", "sessions/P08-1/events.jsonl", "sessions/P08-1/notes.csv",
                "sessions/P08-1/problems.csv", "sessions/P08-1/session.molar", "sessions/P08-1/tasks.csv",
                "sessions/P08-1/template.toml", "study-tlx-raw.csv", "study-tlx-raw.json"}));
  // What a spreadsheet would take for a formula has a ' before it.
  EXPECT_EQ(zip.text("sessions/P07-1/notes.csv", 1000),
            "time_s,tick,type,kind,severity,task,words\n1.500000001,5,note,comment,3,,'=gryphon of P07\n");
  const std::string report = *zip.text("report.html", 1U << 20U);
  for (const char* part :
       {"Goals", "Participants", "Context of use", "Tasks and rules", "Measures", "Problems", "Limits",
        "O1.removed &gt;= 2 mm3", "480.5", "The pedal is not found", "2 of 2", "surgeon: 1", "quotes"})
    EXPECT_NE(report.find(part), std::string::npos) << part;
  EXPECT_NE(report.find("content=\"default-src 'none';"), std::string::npos);
  for (const char* request : {"http:", "https:", "<script", "<link", " src=", "url("})
    EXPECT_EQ(report.find(request), std::string::npos) << request;
  const auto json = nlohmann::json::parse(*zip.text("study-tlx-raw.json", 1U << 20U));
  EXPECT_EQ(json["problems"][0]["met_by"], 2);
}

TEST_F(StudyBundleTest, IsTheSameBytesInEveryLocaleAndZone) {
  const std::string plain = readWhole(bundle(&owner_));
  EXPECT_NE(everythingIn(folder_.file("out.zip")).find("12.5"), std::string::npos);
  /// A decimal comma whatever is installed.
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    std::string do_grouping() const override { return "\3"; }
  };
  const char* const zone = std::getenv("TZ");
  const std::string before = zone == nullptr ? "" : zone;
  for (const char* locale : {"C", "sv_SE.UTF-8", "de_DE.UTF-8"}) {
    std::setlocale(LC_ALL, locale);
    setenv("TZ", "Pacific/Auckland", 1);
    tzset();
    const std::locale kept = std::locale::global(std::locale(std::locale::classic(), new Comma));
    EXPECT_TRUE(readWhole(bundle(&owner_)) == plain) << locale;
    std::locale::global(kept);
  }
  std::setlocale(LC_ALL, "C");
  before.empty() ? unsetenv("TZ") : setenv("TZ", before.c_str(), 1);
  tzset();
}

TEST_F(StudyBundleTest, WithoutTheKeyWordsAndAnswersStayClosed) {
  const std::string all = everythingIn(bundle(nullptr));
  for (const char* said : {"gryphon", "pedal is not found", "\"value\"", "answers-tlx-raw", "problems.csv"})
    EXPECT_EQ(all.find(said), std::string::npos) << said;
  EXPECT_NE(all.find("sealed"), std::string::npos);
  EXPECT_EQ(all.find(".key"), std::string::npos) << "no sealed key leaves";
}

TEST_F(StudyBundleTest, CanariesAreNowhereOpenedPartsIncluded) {
  // Withdrawn words, a passphrase, a key's file, who works here.
  withdraw(study_, "P08", "words", withdrawalOf(study_, "P08", "words"), 1'800'000'000);
  const std::vector<const char*> names{"HOME", "USER", "LOGNAME", "HOSTNAME"};
  std::vector<std::string> before;
  for (std::size_t n = 0; n < names.size(); ++n) {
    before.emplace_back(std::getenv(names[n]) == nullptr ? "" : std::getenv(names[n]));
    setenv(names[n], kCanaries[12 + n].c_str(), 1);
  }
  const std::string file = folder_.file(kCanaries[16] + ".zip");
  const std::string key_file = folder_.file(kCanaries[17] + ".key");
  const std::string other = folder_.file("other");
  createStudyKeys(other, key_file, kCanaries[18] + " " + kCanaries[19], {1, 8192});
  writeBundle(study_, "", &owner_, file, false);
  for (std::size_t n = 0; n < names.size(); ++n)
    before[n].empty() ? unsetenv(names[n]) : setenv(names[n], before[n].c_str(), 1);
  const std::string all = everythingIn(file);
  ASSERT_EQ(kCanaries.size(), 20u);
  for (const std::string& canary : kCanaries) EXPECT_EQ(all.find(canary), std::string::npos) << canary;
  EXPECT_EQ(all.find(folder_.file("")), std::string::npos) << "no path";
  EXPECT_NE(all.find("gryphon of P07"), std::string::npos) << "the search would find it";
  // What is sealed in the logs opens to no canary, either.
  const ZipReader zip(file);
  const std::string log = folder_.file("log");
  for (const char* session : {"P07-1", "P08-1"}) {
    writeWhole(log, *zip.text(std::string("sessions/") + session + "/events.jsonl", 1U << 20U));
    const OpenedSession opened(owner_, study_ + "/" + session, session);
    for (const LogEvent& event : openedEvents(readSessionLog(log).events, &opened, log).events)
      for (const std::string& canary : kCanaries) EXPECT_EQ(event.textOr("text").find(canary), std::string::npos);
  }
}

TEST_F(StudyBundleTest, OfOneSessionAndOfNone) {
  const std::string all = everythingIn(bundle(&owner_, "P07-1"));
  EXPECT_EQ(all.find("P08"), std::string::npos);
  EXPECT_NE(tests::refusalOf<UsageError>([&] { bundle(&owner_, "P09-1"); }).find("P09-1 is no session"),
            std::string::npos);
  // A log that was changed is not handed on, and nothing is left of the attempt.
  fs::remove(folder_.file("out.zip"));
  std::string log = readWhole(study_ + "/P07-1/events.jsonl");
  log[log.find("surgeon")] = 'S';
  writeWhole(study_ + "/P07-1/events.jsonl", log);
  EXPECT_THROW(bundle(&owner_), assets::LoadError);
  EXPECT_FALSE(fs::exists(folder_.file("out.zip")));
  EXPECT_EQ(folder_.names().size(), 1u);
}

}  // namespace
}  // namespace app
