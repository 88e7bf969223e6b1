// A whole session by `molar evaluate --page`, in real time without a window, spoken for by two pages.

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <thread>

#include "app/evaluation/console/page_address.h"
#include "app/evaluation/console/page_link.h"
#include "app/study/session_log.h"
#include "tests/app/commands/program.h"
#include "tests/app/evaluation/console/raw_page.h"

namespace app {
namespace {

using nlohmann::json;
using test::RawPage;

const std::string kPageTemplate = R"(title = "At the page"
language = "en"
case = "block-groove"
consent = "consent.md"
[warm_up]
block = "block-plate"
seconds = 1
[[prompt]]
id = "why"
say = "Why has it done that?"
[[task]]
id = "open"
say = "Begin the groove"
time_box_s = 60
success = "O1.removed >= 0.5 mm3"
[[task]]
id = "on"
say = "Go on with it"
time_box_s = 60
success = "O1.removed >= 500 mm3 and not M1.drilling < 1 s"
[[questionnaire]]
use = "debrief-5"
[[questionnaire]]
use = "sus"
)";

/// One of the two pages: says it again until it is answered, as a browser does.
class SpeakingPage {
 public:
  SpeakingPage(int port, std::string role, std::string name)
      : port_(port), role_(std::move(role)), name_(std::move(name)) {
    connect();
  }
  void connect() {
    page_.emplace(port_);
    for (int n = 0; n < 3000 && !page_->open("/ws?role=" + role_ + "&page=" + name_); ++n) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      page_.emplace(port_);
    }
  }
  /// The first state that is so.
  json until(const std::function<bool(const json&)>& is_so) {
    const auto end = RawPage::Time::now() + std::chrono::seconds(120);
    while (RawPage::Time::now() < end) {
      const auto message = page_->hear(std::chrono::milliseconds(1000));
      if (!page_->isOpen()) connect();
      if (message) take(*message);
      if (message && message->opcode == 1 && state_.is_object() && is_so(state_)) return state_;
    }
    ADD_FAILURE() << "no such state, the last was " << state_.dump().substr(0, 2000);
    return state_;
  }
  json untilPhase(const std::string& phase, bool may_continue = false) {
    return until([&](const json& state) {
      return state["phase"] == phase && (!may_continue || state["may_continue"].get<bool>());
    });
  }
  /// Why it was refused; empty: it was taken.
  std::string say(const std::string& type, const json& data, std::int64_t ago_ns = 0) {
    const json said{{"kind", "event"},
                    {"page", name_},
                    {"session", state_["session"]},
                    {"seq", ++number_},
                    {"type", type},
                    {"t_ns", std::chrono::steady_clock::now().time_since_epoch().count() - ago_ns},
                    {"rtt_ms", 1.25},
                    {"data", data}};
    return sayAgain(said);
  }
  std::string sayAgain(const json& said) {
    last_ = said;
    const auto end = RawPage::Time::now() + std::chrono::seconds(120);
    auto again = RawPage::Time::time_point();
    while (RawPage::Time::now() < end) {
      if (RawPage::Time::now() > again) {
        page_->say(said);
        again = RawPage::Time::now() + std::chrono::milliseconds(700);
      }
      const auto message = page_->hear(std::chrono::milliseconds(100));
      if (!page_->isOpen()) connect(), again = {};
      if (!message) continue;
      take(*message);
      if (message->opcode != 1) continue;
      const json told = message->json();
      if (told.value("seq", json()) != said["seq"]) continue;
      if (told["kind"] == "ack") return "";
      if (told["kind"] == "refused") return told["why"];
    }
    return "no answer";
  }
  void take(const RawPage::Message& message) {
    if (message.opcode == 2) {
      ++pictures_;
      std::uint32_t serial = 0;
      std::memcpy(&serial, message.bytes.data() + 4, sizeof serial);
      page_->say(json{{"kind", "drawn"}, {"picture", serial}});
      return;
    }
    json told = message.json();
    if (told.is_object() && told["kind"] == "state") state_ = std::move(told);
  }
  /// The station hangs up.
  bool isLeft() {
    const auto end = RawPage::Time::now() + std::chrono::seconds(60);
    while (page_->isOpen() && RawPage::Time::now() < end) page_->hear(std::chrono::milliseconds(50));
    return !page_->isOpen();
  }

  const json& state() const { return state_; }
  const json& last() const { return last_; }
  int pictures() const { return pictures_; }

 private:
  int port_;
  std::string role_, name_;
  std::optional<RawPage> page_;
  json state_, last_;
  int number_ = 0, pictures_ = 0;
};

class PageSession : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("consent.md", "What is kept, and for how long.");
    write("page.toml", kPageTemplate);
  }
  void TearDown() override {
    if (station_ > 0) ::kill(station_, SIGKILL), ::waitpid(station_, nullptr, 0);
    ProgramTest::TearDown();
  }
  void start() {
    const std::string line = "exec " + std::string(MOLAR_PROGRAM) + " evaluate " + at("page.toml") +
                             " --participant P07 --out " + at("study") +
                             " --device scripted --headless --page 127.0.0.1:0 </dev/null >/dev/null 2>" + at("err");
    station_ = ::fork();
    if (station_ == 0) {
      ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      ::_exit(127);
    }
    const std::string mark = "http://127.0.0.1:";
    for (int n = 0; n < 6000 && port_ == 0; ++n) {
      const std::string said = read("err");
      if (const std::size_t at = said.find(mark); at != std::string::npos && said.find('\n', at) != std::string::npos)
        port_ = std::atoi(said.c_str() + at + mark.size());
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_GT(port_, 0) << read("err");
  }
  int status() {
    int ended = 0;
    ::waitpid(station_, &ended, 0);
    station_ = 0;
    return WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended);
  }
  /// The process that serves the page: the station's only child in these sessions.
  /// Of the station's processes the one that serves the page; 0: none. Each thread names those that it started.
  pid_t pageProcess() const {
    for (const auto& thread : std::filesystem::directory_iterator("/proc/" + std::to_string(station_) + "/task")) {
      std::ifstream of(thread.path() / "children");
      for (pid_t child = 0; of >> child;) {
        std::ifstream command("/proc/" + std::to_string(child) + "/cmdline");
        std::string program, subcommand;
        std::getline(command, program, '\0');
        std::getline(command, subcommand, '\0');
        if (subcommand == "page") return child;
      }
    }
    return 0;
  }
  std::vector<LogEvent> log() const { return readSessionLog(at("study/P07-1/events.jsonl")).events; }
  static std::size_t count(const std::vector<LogEvent>& events, const std::string& type) {
    return static_cast<std::size_t>(std::ranges::count(events, type, &LogEvent::type));
  }
  static void consent(SpeakingPage& page, bool picture) {
    for (const char* stream : {"log", "audio", "picture", "quotes", "reuse"})
      EXPECT_EQ(page.say("consent", {{"stream", stream}, {"given", std::string(stream) != "picture" || picture}}), "");
  }

  pid_t station_ = 0;
  int port_ = 0;
};

TEST_F(PageSession, GoesFromTheChecksToTheTablesAtTwoPages) {
  start();
  SpeakingPage evaluator(port_, "evaluator", "ev-1"), participant(port_, "participant", "pa-1");
  evaluator.untilPhase("prepare", true);
  EXPECT_FALSE(evaluator.state()["checks"].empty());
  EXPECT_EQ(evaluator.say("continue", json::object()), "");
  participant.untilPhase("consent");
  EXPECT_EQ(participant.state()["consent"]["streams"].size(), 5u);
  EXPECT_EQ(evaluator.say("continue", json::object()), "each stream needs a yes or no");
  EXPECT_EQ(participant.say("note", {{"kind", "behaviour"}, {"text", "x"}}), "that is the evaluator's to say");
  consent(participant, true);
  evaluator.untilPhase("consent", true);
  EXPECT_EQ(evaluator.say("continue", json::object()), "");
  evaluator.untilPhase("warm-up", true);
  EXPECT_EQ(evaluator.say("continue", json::object()), "");

  evaluator.untilPhase("tasks");
  EXPECT_EQ(evaluator.say("task", {{"result", "next"}}), "");
  evaluator.until([](const json& state) { return !state["task"].is_null(); });
  // A note of 100 ms ago, sent three times: it is one, with its own time.
  constexpr std::int64_t kAgo_ns = 100'000'000;
  EXPECT_EQ(evaluator.say("note", {{"kind", "behaviour"}, {"text", "looks up"}, {"severity", 2}}, kAgo_ns), "");
  const json noted = evaluator.last();
  EXPECT_EQ(evaluator.sayAgain(noted), "");
  EXPECT_EQ(evaluator.sayAgain(noted), "");
  json old = noted;
  old["seq"] = 901, old["t_ns"] = noted["t_ns"].get<std::int64_t>() - 700'000'000'000;
  EXPECT_EQ(evaluator.sayAgain(old), "it is older than ten minutes, write it again");
  json other = noted;
  other["seq"] = 902, other["session"] = "another";
  EXPECT_EQ(evaluator.sayAgain(other), "it is of another session");
  json early = noted;
  early["seq"] = 903, early["t_ns"] = noted["t_ns"].get<std::int64_t>() + 3'600'000'000'000;
  EXPECT_EQ(evaluator.sayAgain(early), "");
  evaluator.until([](const json& state) { return !state["tasks"][0]["result"].is_null(); });
  EXPECT_EQ(evaluator.state()["tasks"][0]["by"], "rule");
  EXPECT_EQ(evaluator.say("task", {{"result", "next"}}), "");
  const json rule = evaluator.until([](const json& state) {
    return !state["task"].is_null() && state["task"]["id"] == "on" && !state["task"]["success"][0]["value"].is_null();
  })["task"]["success"];
  EXPECT_EQ(rule[0]["text"], "O1.removed >= 500 mm3");
  EXPECT_EQ(rule[1]["text"], "M1.drilling >= 1 s");
  EXPECT_EQ(evaluator.say("task", {{"result", "pause"}}), "");
  evaluator.until([](const json& state) { return state["task"]["paused"] == true; });
  EXPECT_EQ(evaluator.say("task", {{"result", "pause"}}), "");
  evaluator.until([&](const json& state) {
    return !state["servo"].is_null() && !state["course"].empty() && evaluator.pictures() > 3;
  });
  EXPECT_EQ(evaluator.say("task", {{"result", "partly"}, {"reason", "enough"}}), "");
  evaluator.untilPhase("tasks", true);
  EXPECT_EQ(evaluator.say("continue", json::object()), "");

  participant.untilPhase("debrief");
  EXPECT_EQ(participant.say("answer", {{"questionnaire", "debrief-5"}, {"item", "D1"}, {"words", "the feel"}}), "");
  EXPECT_EQ(participant.say("submit", {{"questionnaire", "debrief-5"}}), "");
  EXPECT_EQ(evaluator.say("continue", json::object()), "");
  participant.untilPhase("questionnaires");
  EXPECT_EQ(evaluator.say("continue", json::object()).substr(0, 3),
            participant.state()["questionnaires"][0]["title"].get<std::string>().substr(0, 3));
  const json asked = participant.state()["questionnaires"][0]["items"];
  for (const json& item : asked)
    EXPECT_EQ(participant.say("answer", {{"questionnaire", "sus"}, {"item", item["id"]}, {"value", 3}}), "");
  EXPECT_NE(participant.say("answer", {{"questionnaire", "sus"}, {"item", "S1"}, {"value", 9}}), "");
  EXPECT_EQ(participant.say("submit", {{"questionnaire", "sus"}}), "");
  evaluator.untilPhase("questionnaires", true);
  EXPECT_EQ(evaluator.say("continue", json::object()), "");
  evaluator.untilPhase("close");
  EXPECT_EQ(evaluator.say("problem", {{"problem", "depth"}, {"title", "The depth is not seen"}, {"severity", 3}}), "");
  EXPECT_EQ(evaluator.say("continue", json::object()), "");
  const json closing = evaluator.until(
      [](const json& state) { return !state["closing"].is_null() && state["closing"]["done"] == true; })["closing"];
  EXPECT_EQ(closing["verified"], true);
  EXPECT_EQ(closing["deviate"], 0);
  EXPECT_EQ(closing["folder"], "P07-1");
  EXPECT_EQ(evaluator.say("note", {{"kind", "behaviour"}, {"text", "late"}}), "the session is closed");
  EXPECT_EQ(evaluator.say("continue", json::object()), "");
  EXPECT_TRUE(evaluator.isLeft());
  EXPECT_EQ(status(), 0) << read("err");

  const std::vector<LogEvent> events = log();
  EXPECT_EQ(events.back().type, "session.stop");
  EXPECT_EQ(count(events, "note"), 2u);
  const auto note = std::ranges::find(events, "note", &LogEvent::type);
  EXPECT_EQ(note->t_ns, noted["t_ns"].get<std::int64_t>());
  EXPECT_EQ(note->number("rtt_ms"), 1.25);
  ASSERT_TRUE(note->tick);
  EXPECT_EQ(count(events, "task.pause"), 1u);
  EXPECT_EQ(count(events, "task.resume"), 1u);
  EXPECT_EQ(count(events, "problem"), 1u);
  EXPECT_EQ(std::ranges::find(events, "answer", &LogEvent::type)->source, "participant");
  EXPECT_NE(read("study/P07-1/problems.csv").find("depth"), std::string::npos);
}

TEST_F(PageSession, APageProcessThatIsKilledAndStoppedLosesNoNoteAndNoTick) {
  start();
  SpeakingPage evaluator(port_, "evaluator", "ev-1");
  evaluator.untilPhase("prepare", true);
  EXPECT_EQ(evaluator.say("continue", json::object()), "");
  evaluator.untilPhase("consent");
  consent(evaluator, false);
  EXPECT_EQ(evaluator.say("continue", json::object()), "");
  evaluator.untilPhase("warm-up", true);
  EXPECT_EQ(evaluator.say("continue", json::object()), "");
  evaluator.untilPhase("tasks");
  EXPECT_EQ(evaluator.say("task", {{"result", "next"}}), "");
  constexpr int kNotes = 12;
  for (int n = 0; n < kNotes; ++n) {
    if (n % 4 == 1) ::kill(pageProcess(), SIGKILL);
    if (n % 4 == 3) ::kill(pageProcess(), SIGSTOP);
    EXPECT_EQ(evaluator.say("note", {{"kind", "behaviour"}, {"text", "note " + std::to_string(n)}}), "");
  }
  // A picture is not allowed: none was shown.
  EXPECT_EQ(evaluator.pictures(), 0);
  ::kill(station_, SIGINT);
  EXPECT_EQ(status(), 1);
  const std::vector<LogEvent> events = log();
  std::set<std::string> texts;
  for (const LogEvent& event : events)
    if (event.type == "note") texts.insert(event.textOr("text"));
  EXPECT_EQ(texts.size(), static_cast<std::size_t>(kNotes));
  EXPECT_EQ(count(events, "note"), static_cast<std::size_t>(kNotes));
  EXPECT_GE(count(events, "page.lost"), 4u);
  EXPECT_EQ(molar("replay " + at("study/P07-1/session.molar") + " --verify").status, 0);
}

TEST_F(PageSession, WhatContradictsItselfIsRefused) {
  const std::string session =
      "evaluate " + at("page.toml") + " --participant P07 --out " + at("study") + " --device scripted --headless ";
  expectRefusal(session + "--page 0.0.0.0:0", "--share");
  expectRefusal(session + "--page 8080", "127.0.0.1:8080");
  expectRefusal(session + "--page 127.0.0.1:0 --pace fast", "--pace fast");
  expectRefusal(session + "--page 127.0.0.1:0 --script " + at("page.toml"), "--script");
  expectRefusal(session + "--share", "--page");
  // A second program on the port: one line, before anything begins.
  const PageAddress taken("127.0.0.1:0", false);
  expectRefusal(session + "--page " + taken.text(), "cannot be opened");
  EXPECT_FALSE(std::filesystem::exists(at("study")));
}

}  // namespace
}  // namespace app
