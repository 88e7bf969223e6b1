// The voice in a whole session of `molar evaluate`, from a file that stands for the microphone.

#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"
#include "tests/app/evaluation/voice/spoken.h"

namespace app {
namespace {

const std::string kAloud = R"(title = "Aloud"
language = "en"
case = "block-groove"
consent = "consent.md"
[[task]]
id = "groove"
say = "Go on with the groove"
time_box_s = 30
success = "time > 4 s"
)";

class EvaluateVoiceCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("t.toml", kAloud);
    write("consent.md", "You are recorded.\n");
    tests::writeSound(at("heard.flac"), tests::spoken(20));
  }
  ProgramOutput session(bool to_audio, const std::string& more = "", const std::string& pace = "fast") const {
    std::string script;
    for (const std::string stream : {"log", "audio", "picture", "quotes", "reuse"})
      script += R"({"during": "consent", "src": "participant", "type": "consent", "data": {"stream": ")" + stream +
                R"(", "given": )" + (to_audio || stream != "audio" ? "true" : "false") + "}}\n";
    write("s.jsonl", script + more);
    return molar("evaluate " + at("t.toml") + " --participant P01 --out " + at("study") + " --script " + at("s.jsonl") +
                 " --device scripted --headless --pace " + pace + " --microphone file:" + at("heard.flac"));
  }
  nlohmann::json first(const std::string& type) const {
    std::istringstream text(read("study/P01-1/events.jsonl"));
    for (std::string line; std::getline(text, line);)
      if (const auto event = nlohmann::json::parse(line); event["type"] == type) return event;
    return {};
  }
  bool isVoiceThere() const { return std::filesystem::exists(at("study/P01-1/voice")); }
};

TEST_F(EvaluateVoiceCommand, IsRecordedWithItsFiguresAndTwiceTheSame) {
  ASSERT_EQ(session(true).status, 0);
  EXPECT_EQ(read("study/P01-1/voice/000000.flac").substr(0, 4), "fLaC");
  EXPECT_TRUE(first("speech.on").is_object());
  const nlohmann::json voice = first("voice");
  ASSERT_TRUE(voice.is_object());
  EXPECT_GT(voice["data"]["seconds"], 3.9);
  EXPECT_GT(voice["data"]["speech_s"], 3.0);
  EXPECT_EQ(voice["data"]["gaps"], 0);
  EXPECT_EQ(first("verified")["data"]["recording"], true);
  const std::string log = read("study/P01-1/events.jsonl"), sound = read("study/P01-1/voice/000000.flac");
  std::filesystem::remove_all(at("study"));
  ASSERT_EQ(session(true).status, 0);
  EXPECT_EQ(read("study/P01-1/events.jsonl"), log);
  EXPECT_EQ(read("study/P01-1/voice/000000.flac"), sound);
}

TEST_F(EvaluateVoiceCommand, WithoutTheConsentThereIsNoByteOfIt) {
  ASSERT_EQ(session(false).status, 0);
  EXPECT_FALSE(isVoiceThere());
  EXPECT_FALSE(first("voice").is_object());
  EXPECT_FALSE(first("speech.on").is_object());
}

TEST_F(EvaluateVoiceCommand, TakenBackInMidSessionItIsDeletedAndTheRecordingStillVerifies) {
  const std::string back = R"({"during": "groove", "at_s": 3.0, "src": "participant", "type": "consent", "data": )"
                           R"({"stream": "audio", "given": false}})"
                           "\n";
  ASSERT_EQ(session(true, back).status, 0);
  EXPECT_TRUE(first("speech.on").is_object());
  const nlohmann::json deleted = first("voice.deleted");
  ASSERT_TRUE(deleted.is_object());
  EXPECT_FALSE(isVoiceThere());
  EXPECT_EQ(first("verified")["data"]["recording"], true);
  EXPECT_EQ(molar("replay " + at("study/P01-1/session.molar") + " --verify").status, 0);
  // Within a second of the word.
  std::int64_t taken_ns = 0;
  std::istringstream text(read("study/P01-1/events.jsonl"));
  for (std::string line; std::getline(text, line);)
    if (const auto event = nlohmann::json::parse(line); event["type"] == "consent") taken_ns = event["t_ns"];
  EXPECT_LE(deleted["t_ns"].get<std::int64_t>() - taken_ns, 1'000'000'000);
}

TEST_F(EvaluateVoiceCommand, IsRecordedInRealTimeToo) {
  ASSERT_EQ(session(true, "", "real").status, 0);
  EXPECT_TRUE(first("voice.on").is_object());
  const nlohmann::json voice = first("voice");
  ASSERT_TRUE(voice.is_object());
  EXPECT_EQ(voice["data"]["gaps"], 0);
  EXPECT_GT(voice["data"]["processor_s"], 0.0);
  EXPECT_EQ(first("verified")["data"]["recording"], true);
}

TEST_F(EvaluateVoiceCommand, AMicrophoneThatIsNoneIsRefused) {
  write("s.jsonl", "");
  expectRefusal("evaluate " + at("t.toml") + " --participant P01 --out " + at("study") + " --script " + at("s.jsonl") +
                    " --device scripted --headless --pace fast --microphone file:none.wav",
                "none.wav");
}

}  // namespace
}  // namespace app
