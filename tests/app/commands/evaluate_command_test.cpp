#include <algorithm>
#include <csignal>
#include <thread>

#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

const std::string kExample = std::string(MOLAR_SOURCE_DIR) + "/app/evaluation/";

class EvaluateCommand : public ProgramTest {
 protected:
  std::string session(const std::string& participant, const std::string& study_template = kExample + "example.toml",
                      const std::string& script = kExample + "example_script.jsonl") const {
    return "evaluate " + study_template + " --participant " + participant + " --out " + at("study") + " --script " +
           script + " --device scripted --headless --pace fast";
  }
  std::vector<nlohmann::json> log(const std::string& folder) const {
    std::vector<nlohmann::json> lines;
    std::istringstream text(read("study/" + folder + "/events.jsonl"));
    for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
  }
  static std::vector<nlohmann::json> ofType(const std::vector<nlohmann::json>& lines, const std::string& type) {
    std::vector<nlohmann::json> found;
    std::ranges::copy_if(lines, std::back_inserter(found), [&](const auto& line) { return line["type"] == type; });
    return found;
  }
};

TEST_F(EvaluateCommand, GoesFromConsentToTheStudysTables) {
  const ProgramOutput first = molar(session("P01"));
  ASSERT_EQ(first.status, 0) << first.err;
  const ProgramOutput second = molar(session("P02"));
  ASSERT_EQ(second.status, 0) << second.err;

  const auto lines = log("P01-1");
  EXPECT_EQ(lines.front()["type"], "session.start");
  EXPECT_EQ(lines.back()["type"], "session.stop");
  EXPECT_EQ(ofType(lines, "consent").size(), 5u);
  EXPECT_EQ(ofType(lines, "task.start").size(), 3u);
  EXPECT_EQ(ofType(lines, "task.stop").size(), 3u);
  for (std::size_t n = 0; n < lines.size(); ++n) EXPECT_EQ(lines[n]["seq"], n);
  // Rules fired, and in the recording at the very same ticks.
  const auto verified = ofType(lines, "verified").at(0)["data"];
  EXPECT_EQ(verified["recording"], true);
  EXPECT_GE(verified["rules"], 2);
  EXPECT_EQ(verified["rules_deviate"], 0);
  // Another order for the next participant.
  EXPECT_NE(lines.front()["data"]["order"], log("P02-1").front()["data"]["order"]);

  const auto study = nlohmann::json::parse(molar("study " + at("study") + " --questionnaire sus --json -").out);
  EXPECT_EQ(study["participants"], 2);
  EXPECT_EQ(study["tasks"].size(), 3u);
  EXPECT_FALSE(study["problems"].empty());
  EXPECT_EQ(study["scores"].size(), 1u);
  // What is kept can be looked at with its moments; words lie beside the recording, not in it.
  EXPECT_NE(read("study/P01-1/session.bookmarks.json").find("looks for the pedal"), std::string::npos);
  EXPECT_EQ(read("study/P01-1/session.molar").find("looks for the pedal"), std::string::npos);
  EXPECT_EQ(read("study/P01-1/template.toml"), read("study/P02-1/template.toml"));
}

// A tooth is cut with the burs and the feel that the template names.
TEST_F(EvaluateCommand, ThePublishedStudyIsRunAgain) {
  const std::string study_template = kExample + "gajananan.toml", script = kExample + "gajananan_script.jsonl";
  const ProgramOutput said = molar(session("P01", study_template, script));
  ASSERT_EQ(said.status, 0) << said.err;
  const auto lines = log("P01-1");
  const auto stops = ofType(lines, "task.stop");
  ASSERT_EQ(stops.size(), 4u);
  for (const auto& stop : stops) EXPECT_EQ(stop["data"]["result"], "success") << stop;
  EXPECT_EQ(ofType(lines, "verified").at(0)["data"]["rules_deviate"], 0);
  const auto measured = nlohmann::json::parse(molar("metrics " + at("study/P01-1/session.molar") + " --json").out);
  EXPECT_GT(measured["preparation"]["enamel_mm3"].get<double>(), 3.0);
  EXPECT_LT(measured["preparation"]["P7_neighbour_mm3"].get<double>(), 0.01);
  const auto study = nlohmann::json::parse(molar("study " + at("study") + " --questionnaire gajananan --json -").out);
  EXPECT_EQ(study["items"].size(), 20u);
  EXPECT_EQ(study["items"][0]["published"]["mean"], 4.8);
  const ProgramOutput twice = molar(session("P02", study_template, script) + " --preset density-weighted");
  EXPECT_EQ(twice.status, 2);
  EXPECT_NE(twice.err.find("names density-weighted, leave it out"), std::string::npos) << twice.err;
}

TEST_F(EvaluateCommand, TheSameSessionTwiceIsTheSameLog) {
  ASSERT_EQ(molar(session("P03")).status, 0);
  const std::string first = read("study/P03-1/events.jsonl"), tasks = read("study/P03-1/tasks.csv");
  std::filesystem::remove_all(at("study"));
  ASSERT_EQ(molar(session("P03")).status, 0);
  EXPECT_EQ(read("study/P03-1/events.jsonl"), first);
  EXPECT_EQ(read("study/P03-1/tasks.csv"), tasks);
}

/// A session of a study with keys, and what its owner does with it.
TEST_F(EvaluateCommand, WithKeysWordsAreSealedForTheOwnerAlone) {
  const std::string owner = " --key " + at("owner.key") + " --passphrase-file " +
                            write("passphrase", "eight words nobody else would ever say\n");
  const ProgramOutput made = molar("study keys " + at("study") + owner);
  ASSERT_EQ(made.status, 0) << made.err;
  const ProgramOutput first = molar(session("P01"));
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.err.find("has no keys"), std::string::npos);
  // Times and kinds are open, words and answers are not; the rules fired as ever.
  const std::string log_text = read("study/P01-1/events.jsonl");
  for (const char* said : {"looks for the pedal", "\"value\":", "\"title\":\"The"})
    EXPECT_EQ(log_text.find(said), std::string::npos) << said;
  EXPECT_FALSE(ofType(log("P01-1"), "note").empty());
  EXPECT_EQ(ofType(log("P01-1"), "verified").at(0)["data"]["rules_deviate"], 0);
  EXPECT_FALSE(std::filesystem::exists(at("study/P01-1/problems.csv")));
  EXPECT_TRUE(std::filesystem::exists(at("study/P01-1/tasks.csv")));
  EXPECT_EQ(read("study/P01-1/session.bookmarks.json").find("looks for"), std::string::npos);

  const ProgramOutput closed = molar("study " + at("study"));
  EXPECT_NE(closed.err.find("rows are closed, give --key FILE"), std::string::npos) << closed.err;
  const ProgramOutput opened = molar("study " + at("study") + owner + " --questionnaire sus --json -");
  ASSERT_EQ(opened.status, 0) << opened.err;
  const auto study = nlohmann::json::parse(opened.out);
  EXPECT_FALSE(study["problems"].empty());
  EXPECT_EQ(study["scores"].size(), 1u);

  // Handed on, checked, one byte changed.
  ASSERT_EQ(molar("study export " + at("study") + " --out " + at("F.zip") + owner).status, 0);
  const ProgramOutput whole = molar("study check " + at("F.zip") + " --study " + at("study"));
  EXPECT_EQ(whole.status, 0) << whole.out << whole.err;
  EXPECT_NE(whole.out.find("signed by the study's key " + made.out.substr(0, 16)), std::string::npos) << whole.out;
  std::string bytes = read("F.zip");
  bytes[bytes.find("sessions/P01-1/session.molar") + 5000] ^= 1;
  const ProgramOutput changed = molar("study check " + write("G.zip", bytes));
  EXPECT_EQ(changed.status, 1);
  EXPECT_EQ(changed.out, "sessions/P01-1/session.molar was changed\n");

  // With what is asked for: pictures of the moments, the same twice; a voice that was never recorded is told of.
  const std::string more = "study export " + at("study") + owner + " --pictures --voice --out ";
  const ProgramOutput with_pictures = molar(more + at("M.zip"));
  ASSERT_EQ(with_pictures.status, 0) << with_pictures.err;
  EXPECT_NE(with_pictures.err.find("P01-1: voice: "), std::string::npos) << with_pictures.err;
  ASSERT_EQ(molar(more + at("N.zip")).status, 0);
  EXPECT_NE(read("M.zip").find("sessions/P01-1/pictures/01-"), std::string::npos);
  EXPECT_TRUE(read("M.zip") == read("N.zip"));
  EXPECT_EQ(molar("study check " + at("M.zip") + " --study " + at("study")).status, 0);

  // Looked at again: what is closed is told, the key opens it, another recording needs none.
  const std::string looks =
      "debrief " + at("study/P01-1/session.molar") + " --headless --size 64x48 --force --snapshot " + at("moment.png");
  EXPECT_NE(molar(looks).err.find("voice and words are sealed, --key"), std::string::npos);
  const ProgramOutput with_key = molar(looks + owner);
  EXPECT_EQ(with_key.status, 0) << with_key.err;
  EXPECT_EQ(with_key.err.find("sealed"), std::string::npos) << with_key.err;

  // Taken back: the chain and the recording stay.
  EXPECT_EQ(molar("study withdraw " + at("study") + " P01 --stream words --dry-run").out,
            "P01-1/keys/words.key\nP01-1/session.bookmarks.json\n");
  ASSERT_EQ(molar("study withdraw " + at("study") + " P01 --stream words").status, 0);
  EXPECT_EQ(read("study/P01-1/events.jsonl"), log_text);
  EXPECT_EQ(molar("replay " + at("study/P01-1/session.molar") + " --verify").status, 0);
  const ProgramOutput after = molar("study " + at("study") + owner + " --questionnaire sus --json -");
  EXPECT_TRUE(nlohmann::json::parse(after.out)["problems"].empty());
  EXPECT_EQ(nlohmann::json::parse(after.out)["scores"].size(), 1u) << "answers are another stream";

  // After a year and a day, and a clock that goes back.
  EXPECT_EQ(molar("study retain " + at("study") + " --dry-run").out, "");
  EXPECT_NE(molar("study retain " + at("study") + " --today 2199-01-01").out.find("P01-1  ended"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(at("study/P01-1")));
  expectRefusal("study retain " + at("study"), "set the clock");
  EXPECT_NE(read("study/audit.jsonl").find("\"type\":\"retain\""), std::string::npos);
}

TEST_F(EvaluateCommand, ABundleIsEncryptedForWhoIsNamed) {
  if (std::system("command -v age-keygen >/dev/null") != 0)
    GTEST_SKIP() << "age is not installed (apt-get install age)";
  ASSERT_EQ(molar(session("P01")).status, 0);
  ASSERT_EQ(std::system(("age-keygen -o " + at("id") + " 2>/dev/null").c_str()), 0);
  std::string key = read("id");
  key = key.substr(key.find("age1"));
  key = key.substr(0, key.find('\n'));
  const std::string line = "study export " + at("study") + " --out " + at("F.zip");
  ASSERT_EQ(molar(line).status, 0);
  const std::string plain = read("F.zip");
  std::filesystem::remove(at("F.zip"));
  const ProgramOutput wrapped = molar(line + " --recipient " + key);
  ASSERT_EQ(wrapped.status, 0) << wrapped.err;
  // Only the encrypted one is left, and it opens to the bundle.
  EXPECT_FALSE(std::filesystem::exists(at("F.zip")));
  EXPECT_EQ(read("F.zip.age").find("session.molar"), std::string::npos);
  ASSERT_EQ(std::system(("age -d -i " + at("id") + " -o " + at("D.zip") + " " + at("F.zip.age")).c_str()), 0);
  EXPECT_TRUE(read("D.zip") == plain);
  expectRefusal(line + " --recipient " + key, "it exists");
  expectRefusal(line + " --force --recipient nobody", "age refuses it");
  EXPECT_FALSE(std::filesystem::exists(at("F.zip")));
}

TEST_F(EvaluateCommand, ABundlesReportIsPrintedWhereverItIsNamedFrom) {
  if (std::system("command -v chromium >/dev/null") != 0)
    GTEST_SKIP() << "chromium is not installed (apt-get install chromium)";
  ASSERT_EQ(molar(session("P01")).status, 0);
  const std::string name = std::filesystem::relative(at("R")).string(),
                    line = "study export " + at("study") + " --out ";
  const ProgramOutput printed = molar(line + name + ".zip --pdf " + name + ".pdf");
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_TRUE(read("R.pdf").starts_with("%PDF-"));
  // What cannot be written is told before the bundle is.
  expectRefusal(line + at("S.zip") + " --pdf " + at("nowhere/S.pdf"), "there is no folder");
  EXPECT_FALSE(std::filesystem::exists(at("S.zip")));
}

TEST_F(EvaluateCommand, TheStudysCommandsRefuseInOneLine) {
  std::filesystem::create_directory(at("study"));
  const std::string passphrase = " --passphrase-file " + write("passphrase", "short\n");
  expectRefusal("study keys " + at("study") + passphrase, "give --key FILE");
  expectRefusal("study keys " + at("study") + " --key " + at("owner.key") + passphrase, "fewer than 12");
  expectRefusal("study " + at("study") + passphrase, "of which --key");
  expectRefusal("study withdraw " + at("study") + " Anna --stream all", "never a name");
  expectRefusal("study withdraw " + at("study") + " P01 --stream smell", "--stream");
  expectRefusal("study withdraw " + at("study") + " P01 --stream all", "P01 is in no session");
  expectRefusal("study retain " + at("study") + " --today tomorrow", "--today tomorrow");
  expectRefusal("study export " + at("study") + " --out " + at("F.tar"), "name it .zip");
  expectRefusal("study export " + at("study") + " --out " + at("F.zip"), "no session that was closed");
  expectRefusal("study check " + write("F.zip", "PK"), "is no bundle");
  expectRefusal("study unmerge " + at("study") + " pedal", "is not merged");
  EXPECT_FALSE(std::filesystem::exists(at("owner.key")));
}

TEST_F(EvaluateCommand, WithoutTheLogNothingIsKept) {
  std::string script;
  for (const char* stream : {"log", "audio", "picture", "quotes", "reuse"})
    script += R"({"during": "consent", "type": "consent", "data": {"stream": ")" + std::string(stream) +
              R"(", "given": false}})" + "\n";
  const ProgramOutput said = molar(session("P01", kExample + "example.toml", write("s.jsonl", script)));
  EXPECT_EQ(said.status, 1);
  EXPECT_NE(said.err.find("allows no log"), std::string::npos) << said.err;
  EXPECT_FALSE(std::filesystem::exists(at("study")));
}

TEST_F(EvaluateCommand, ASessionThatIsKilledIsTold) {
  const std::string line = "exec " + std::string(MOLAR_PROGRAM) + " " + session("P01") + " 2>/dev/null >/dev/null";
  const pid_t child = fork();
  if (child == 0) {
    execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  // Once a task has begun.
  for (int n = 0; n < 6000 && read("study/P01-1/events.jsonl").find("task.start") == std::string::npos; ++n)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  ASSERT_NE(read("study/P01-1/events.jsonl").find("task.start"), std::string::npos);
  EXPECT_NE(molar("study " + at("study")).err.find("P01-1 was interrupted"), std::string::npos);
  ASSERT_EQ(molar(session("P01")).status, 0);
  const ProgramOutput said = molar("study " + at("study"));
  EXPECT_NE(said.err.find("was begun anew and does not count"), std::string::npos) << said.err;
  EXPECT_TRUE(std::filesystem::exists(at("study/P01-1-2/tasks.csv")));
}

const std::string kBoneTemplate = R"(title = "Rules that ask for the bone"
language = "en"
case = "block-groove"
consent = "consent.md"
[[task]]
id = "open"
say = "Begin the groove"
time_box_s = 30
at_time_box = "failed"
success = "O2.plan >= 0.02 and O3.over < 50 mm3"
[[task]]
id = "on"
say = "Go on with it"
time_box_s = 30
at_time_box = "failed"
success = "O1.bone > 4 mm3 and M1.drilling > 0.5 s"
hold_s = 0.2
)";

class BoneRules : public EvaluateCommand {
 protected:
  void SetUp() override {
    EvaluateCommand::SetUp();
    write("consent.md", "What is kept, and for how long.");
    write("bone.toml", kBoneTemplate);
    std::string script;
    for (const char* stream : {"log", "audio", "picture", "quotes", "reuse"})
      script += R"({"during": "consent", "type": "consent", "data": {"stream": ")" + std::string(stream) +
                R"(", "given": true}})" + "\n";
    write("script.jsonl", script);
  }
  std::string boneSession() const { return session("P01", at("bone.toml"), at("script.jsonl")); }
};

TEST_F(BoneRules, FireLiveAtTheTicksOfTheRecordingTwiceAlike) {
  const ProgramOutput said = molar(boneSession());
  ASSERT_EQ(said.status, 0) << said.err;
  const auto lines = log("P01-1");
  const auto verified = ofType(lines, "verified").at(0)["data"];
  EXPECT_EQ(verified["recording"], true);
  EXPECT_EQ(verified["rules"], 2);
  EXPECT_EQ(verified["rules_deviate"], 0);
  for (const auto& rule : ofType(lines, "rule")) EXPECT_EQ(rule["data"]["verdict"], "success");
  const std::string first = read("study/P01-1/events.jsonl");
  std::filesystem::remove_all(at("study"));
  ASSERT_EQ(molar(boneSession()).status, 0);
  EXPECT_EQ(read("study/P01-1/events.jsonl"), first);
}

TEST_F(BoneRules, OverWhatTheCaseNeverTellsTheSessionIsNotBegun) {
  std::string text = kBoneTemplate;
  text.replace(text.find("O1.bone > 4 mm3"), 15, "O10.second_molar == 0 mm3");
  write("bone.toml", text);
  const ProgramOutput said = molar(boneSession());
  EXPECT_EQ(said.status, 1);
  EXPECT_NE(
      said.err.find("rules: task on: O10.second_molar cannot be told here, the case has no numbered second molar"),
      std::string::npos)
      << said.err;
  EXPECT_FALSE(std::filesystem::exists(at("study/P01-1/session.molar")));
}

TEST_F(EvaluateCommand, RefusesInOneLine) {
  const std::string example = kExample + "example.toml",
                    rest = " --out " + at("study") + " --script " + kExample +
                           "example_script.jsonl --device scripted --headless --pace fast";
  expectRefusal("evaluate " + example + " --participant Anna" + rest, "--participant: give a code as P07");
  expectRefusal("evaluate " + example + " --participant P01 --no-record" + rest, "--no-record");
  expectRefusal("evaluate " + example + " --participant P01 --case deep" + rest, "names the case");
  expectRefusal("evaluate " + example + " --participant P01 --tool round:2.0" + rest, "--tool");
  expectRefusal("evaluate " + example + " --participant P01 --out " + at("study") + " --headless --device scripted",
                "at a terminal");
  expectRefusal("evaluate " + write("t.toml", "title = 3\n") + " --participant P01" + rest, "line 1: title");
  expectRefusal(session("P01", example, write("s.jsonl", "{}\n")), "line 1, during");
  EXPECT_FALSE(std::filesystem::exists(at("study")));
}

}  // namespace
}  // namespace app
