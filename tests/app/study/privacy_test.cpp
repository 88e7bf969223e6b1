#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "app/study/privacy/passphrase.h"
#include "app/study/sealed_events.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "tests/mutants.h"
#include "tests/refusal.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr PassphraseCost kCheap{1, 8192};
constexpr char kWords[] = "eight words nobody else would ever say";

std::string contentOf(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(Sealing, OpensAtItsOwnPlaceAlone) {
  const SecretKey key = SecretKey::random();
  const std::string plain = "can't see how deep";
  const std::string sealed = sealedWith(key, {"P07-1", "events", 12}, plain);
  EXPECT_EQ(openedWith(key, {"P07-1", "events", 12}, sealed), plain);
  EXPECT_EQ(openedWith(key, {"P07-2", "events", 12}, sealed), std::nullopt);
  EXPECT_EQ(openedWith(key, {"P07-1", "audio", 12}, sealed), std::nullopt);
  EXPECT_EQ(openedWith(key, {"P07-1", "events", 13}, sealed), std::nullopt);
  // The same letters, parted otherwise.
  EXPECT_EQ(openedWith(key, {"P07-1e", "vents", 12}, sealed), std::nullopt);
  EXPECT_EQ(openedWith(SecretKey::random(), {"P07-1", "events", 12}, sealed), std::nullopt);
  EXPECT_NE(sealedWith(key, {"P07-1", "events", 12}, plain), sealed) << "never the same bytes twice";
  for (std::size_t at = 0; at < sealed.size(); ++at) {
    std::string changed = sealed;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    EXPECT_EQ(openedWith(key, {"P07-1", "events", 12}, changed), std::nullopt) << at;
    EXPECT_EQ(openedWith(key, {"P07-1", "events", 12}, sealed.substr(0, at)), std::nullopt) << at;
  }
}

TEST(Sealing, ItsLengthTellsStepsOf64BytesOnly) {
  const SecretKey key = SecretKey::random();
  // Nonce 24, tag 16, and at least one byte of padding.
  for (const auto& [length, sealed] :
       std::vector<std::pair<std::size_t, std::size_t>>{{0, 104}, {1, 104}, {63, 104}, {64, 168}, {127, 168}}) {
    const std::string plain(length, 'a'), bytes = sealedWith(key, {"s", "t", 0}, plain);
    EXPECT_EQ(bytes.size(), sealed) << length;
    EXPECT_EQ(openedWith(key, {"s", "t", 0}, bytes), plain);
  }
}

TEST(Sealing, Base64IsThatOfTheStandard) {
  EXPECT_EQ(base64Of("foobar"), "Zm9vYmFy");  // RFC 4648
  EXPECT_EQ(base64Of("foob"), "Zm9vYg==");
  EXPECT_EQ(fromBase64("Zm9vYg=="), "foob");
  EXPECT_EQ(fromBase64(""), "");
  for (const char* wrong : {"Zm9vYg=", "Zm9vYg", "Zm9v Yg==", "Zm9vYg==x", "ä", "Zm9v\xd9g=="})
    EXPECT_EQ(fromBase64(wrong), std::nullopt);
}

class StudyKeysTest : public testing::Test {
 protected:
  const tests::ScratchFolder folder_;
  const std::string study_ = folder_.file("study"), key_ = folder_.file("owner.key");
  const PublicStudyKeys keys_ = createStudyKeys(study_, key_, kWords, kCheap);
};

TEST_F(StudyKeysTest, ThePassphraseOpensThemAndNoOther) {
  EXPECT_EQ(publicKeysOf(study_), keys_);
  EXPECT_EQ(openStudyKeys(key_, kWords).publicKeys(), keys_);
  EXPECT_EQ(keys_.fingerprint().size(), 16u);
  EXPECT_THROW(openStudyKeys(key_, "eight words nobody else would ever sai"), assets::LoadError);
  EXPECT_EQ(fs::status(key_).permissions(), fs::perms::owner_read);
  EXPECT_EQ(publicKeysOf(folder_.file("another")), std::nullopt);
  // The private half is nowhere in the study.
  EXPECT_EQ(std::distance(fs::directory_iterator(study_), fs::directory_iterator()), 1);
}

TEST_F(StudyKeysTest, AreMadeOnceAndTakenAway) {
  EXPECT_THROW(createStudyKeys(study_, folder_.file("b.key"), kWords, kCheap), UsageError);
  const std::string other = folder_.file("other");
  EXPECT_THROW(createStudyKeys(other, other + "/owner.key", kWords, kCheap), UsageError);
  EXPECT_THROW(createStudyKeys(other, other + "/../other/owner.key", kWords, kCheap), UsageError);
  EXPECT_THROW(createStudyKeys(other, key_, kWords, kCheap), UsageError) << "another key's file";
  EXPECT_THROW(createStudyKeys(other, folder_.file("c.key"), "too short", kCheap), UsageError);
  EXPECT_EQ(publicKeysOf(other), std::nullopt) << "nothing half made";
  EXPECT_FALSE(fs::exists(folder_.file("c.key")));
  EXPECT_EQ(openStudyKeys(key_, kWords).publicKeys(), keys_);
}

TEST_F(StudyKeysTest, SignWhatTheyKnow) {
  const PrivateStudyKeys owner = openStudyKeys(key_, kWords);
  const std::string signature = owner.signatureOf("manifest");
  EXPECT_TRUE(isSignedBy(keys_, "manifest", signature));
  EXPECT_FALSE(isSignedBy(keys_, "Manifest", signature));
  EXPECT_FALSE(isSignedBy(PrivateStudyKeys(SecretKey::random()).publicKeys(), "manifest", signature));
  EXPECT_FALSE(isSignedBy(keys_, "manifest", signature.substr(1)));
}

TEST_F(StudyKeysTest, MutantsOfBothFilesAreRefusedOrRead) {
  const std::string path = folder_.file("mutant");
  const std::vector<std::string> good{contentOf(study_ + "/" + kStudyKeysName), contentOf(key_)};
  std::size_t refused = 0, tried = 0;
  mutants::forEachMutant(good, 2000, [&](const std::string& mutant, std::size_t which, std::uint64_t) {
    ++tried;
    // Its cost is bounded by the reader; here so that a test takes seconds.
    if (which == 1 && mutant.find("\"argon2id_bytes\": 8192,") == std::string::npos) return;
    std::ofstream(path, std::ios::binary) << mutant;
    try {
      if (which == 0)
        publicKeysFrom(mutant, path);
      else
        openStudyKeys(path, kWords);
    } catch (const assets::LoadError& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    } catch (const UsageError&) {
      ++refused;
    }
  });
  EXPECT_TRUE(tried < mutants::kEnoughToJudge || refused > tried / 4);
}

class SealedEventsTest : public StudyKeysTest {
 protected:
  SealedEventsTest() { fs::create_directory(session_); }

  const std::string session_ = folder_.file("P07-1");
  const std::vector<LogEvent> said_{
      {1, {}, "system", "session.start", {{"participant", std::string("P07")}}},
      {2,
       7,
       "evaluator",
       "note",
       {{"kind", std::string("comment")}, {"text", std::string("gryphon")}, {"severity", std::int64_t{3}}}},
      {3, 8, "evaluator", "problem", {{"problem", std::string("pedal gryphon")}, {"title", std::string("gryphon")}}},
      {4, 9, "system", "task.stop", {{"reason", std::string("the time was over")}}},
      {5, 9, "evaluator", "task.stop", {{"reason", std::string("gryphon")}}},
      {6,
       {},
       "participant",
       "answer",
       {{"questionnaire", std::string("sus")}, {"item", std::string("S1")}, {"value", std::int64_t{4}}}},
      {7,
       {},
       "participant",
       "answer",
       {{"questionnaire", std::string("d")}, {"item", std::string("D1")}, {"words", std::string("gryphon")}}}};

  std::vector<LogEvent> sealed(const SessionSeal& seal) const {
    std::vector<LogEvent> made;
    for (std::size_t row = 0; row < said_.size(); ++row) made.push_back(sealedEvent(seal, said_[row], row));
    return made;
  }
};

TEST_F(SealedEventsTest, WordsStandEncryptedInAWholeLog) {
  const SessionSeal seal(keys_, session_, "P07-1");
  const std::string path = session_ + "/events.jsonl";
  {
    SessionLogWriter log(path);
    for (const LogEvent& event : sealed(seal)) log.add(event);
  }
  const std::string text = contentOf(path);
  EXPECT_EQ(text.find("gryphon"), std::string::npos);
  EXPECT_EQ(text.find("\"value\""), std::string::npos);
  EXPECT_NE(text.find("the time was over"), std::string::npos) << "the program's own word";
  EXPECT_NE(text.find("\"kind\":\"comment\",\"severity\":3"), std::string::npos) << "kinds stay open";

  // By the owner alone, by another nobody.
  const SessionLog log = readSessionLog(path);
  ASSERT_EQ(log.damage, std::nullopt);
  const OpenedSession owner(openStudyKeys(key_, kWords), session_, "P07-1");
  const OpenedEvents opened = openedEvents(log.events, &owner, path);
  EXPECT_EQ(opened.sealed, 0u);
  EXPECT_EQ(*opened.events[1].text("text"), "gryphon");
  EXPECT_EQ(*opened.events[2].text("problem"), "pedal gryphon");
  EXPECT_EQ(*opened.events[4].text("reason"), "gryphon");
  EXPECT_EQ(opened.events[5].number("value"), 4.0);
  EXPECT_EQ(*opened.events[6].text("words"), "gryphon");
  const OpenedSession stranger(PrivateStudyKeys(SecretKey::random()), session_, "P07-1");
  EXPECT_EQ(openedEvents(log.events, &stranger, path).sealed, 5u);
  EXPECT_EQ(openedEvents(log.events, nullptr, path).sealed, 5u);
}

TEST_F(SealedEventsTest, AStreamWhoseKeyIsGoneIsClosedForGood) {
  const SessionSeal seal(keys_, session_, "P07-1");
  const std::vector<LogEvent> log = sealed(seal);
  EXPECT_TRUE(fs::remove(sealedKeyPath(session_, SealedStream::words)));
  const OpenedSession owner(openStudyKeys(key_, kWords), session_, "P07-1");
  const OpenedEvents opened = openedEvents(log, &owner, "log");
  EXPECT_EQ(opened.sealed, 3u);
  EXPECT_EQ(opened.events[1].text("text"), nullptr);
  EXPECT_EQ(opened.events[1].number("severity"), 3.0) << "the row stays";
  EXPECT_EQ(opened.events[5].number("value"), 4.0) << "another stream";
}

TEST_F(SealedEventsTest, WordsThatWereMovedAreFound) {
  const SessionSeal seal(keys_, session_, "P07-1");
  std::vector<LogEvent> log = sealed(seal);
  std::swap(log[1], log[2]);
  const OpenedSession owner(openStudyKeys(key_, kWords), session_, "P07-1");
  EXPECT_THROW(openedEvents(log, &owner, "log"), assets::LoadError);
}

TEST_F(SealedEventsTest, MutantsOfSealedWordsAreRefused) {
  const SessionSeal seal(keys_, session_, "P07-1");
  const OpenedSession owner(openStudyKeys(key_, kWords), session_, "P07-1");
  const LogEvent note = sealedEvent(seal, said_[1], 0);
  mutants::forEachMutant({*note.text("sealed")}, 2000, [&](const std::string& mutant, std::size_t, std::uint64_t) {
    LogEvent changed = note;
    for (auto& [key, value] : changed.data)
      if (key == "sealed") value = mutant;
    const bool is_same = mutant == *note.text("sealed");
    const std::string said = tests::refusalOf<assets::LoadError>([&] { openedEvents({changed}, &owner, "log"); });
    EXPECT_EQ(said == "accepted", is_same);
  });
}

TEST_F(SealedEventsTest, WithdrawnInMidSessionNothingMoreIsSealed) {
  SessionSeal seal(keys_, session_, "P07-1");
  seal.destroy(SealedStream::words);
  EXPECT_FALSE(fs::exists(sealedKeyPath(session_, SealedStream::words)));
  EXPECT_FALSE(seal.holds(SealedStream::words));
  const LogEvent note = sealedEvent(seal, said_[1], 1);
  EXPECT_EQ(note.text("text"), nullptr);
  EXPECT_EQ(note.text("sealed"), nullptr);
  EXPECT_NE(sealedEvent(seal, said_[5], 5).text("sealed"), nullptr);
}

TEST(Passphrase, IsTheFirstLineOfAFileOrDescriptor) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("words");
  std::ofstream(path) << "one two three\r\nfour\n";
  EXPECT_EQ(passphraseFrom(path, true).words(), "one two three");
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  ASSERT_EQ(write(ends[1], "by a pipe\n", 10), 10);
  EXPECT_EQ(passphraseFrom("/dev/fd/" + std::to_string(ends[0]), false).words(), "by a pipe");
  close(ends[0]), close(ends[1]);
  std::ofstream(path) << "\n";
  EXPECT_THROW(passphraseFrom(path, false), UsageError);
  EXPECT_THROW(passphraseFrom(folder.file("none"), false), UsageError);
}

}  // namespace
}  // namespace app
