// `molar page` as a session starts it, and clients that lie to it.

#include "app/evaluation/console/page_server.h"

#include <signal.h>

#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "app/evaluation/console/page_address.h"
#include "app/evaluation/console/page_link.h"
#include "app/evaluation/console/page_pictures.h"
#include "tests/app/evaluation/console/raw_page.h"
#include "tests/mutants.h"

namespace app {
namespace {

using nlohmann::json;
using test::RawPage;

class PageServerTest : public testing::Test {
 protected:
  void SetUp() override {
    PageLink::Parts parts;
    parts.listener = address_.descriptor(), parts.pictures = pictures_.memory(), parts.bell = pictures_.bell();
    parts.program = MOLAR_PROGRAM;
    link_.emplace(std::move(parts));
    link_->tellState(json{{"kind", "state"}, {"phase", "tasks"}, {"serial", 1}}.dump());
  }
  std::vector<PageEvent> heard() {
    for (PageLink::Heard& one : link_->take())
      if (auto* said = std::get_if<PageEvent>(&one.word)) heard_.push_back(std::move(*said));
    return heard_;
  }
  template <class Condition>
  static bool comesTrue(const Condition& condition) {
    for (int n = 0; n < 6000; ++n) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  std::string own() const { return "127.0.0.1:" + std::to_string(address_.port()); }
  static json note(int number) {
    return {{"kind", "event"},
            {"page", "p1"},
            {"seq", number},
            {"type", "note"},
            {"t_ns", std::chrono::steady_clock::now().time_since_epoch().count()},
            {"rtt_ms", 0.5},
            {"data", {{"kind", "behaviour"}, {"text", "looks up"}}}};
  }
  long residentKb() const {
    std::ifstream status("/proc/" + std::to_string(link_->figures().process) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("VmRSS:")) return std::strtol(line.c_str() + 6, nullptr, 10);
    return 0;
  }

  PageAddress address_{"127.0.0.1:0", false};
  PicturesOut pictures_;
  std::optional<PageLink> link_;
  std::vector<PageEvent> heard_;
};

TEST_F(PageServerTest, ServesItsFilesWithTheHeadersThatHoldThePageTogether) {
  RawPage page(address_.port());
  const std::string answer = page.get("/pair.html");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
  EXPECT_NE(answer.find("Content-Security-Policy: default-src 'none'; script-src 'self'"), std::string::npos);
  EXPECT_NE(answer.find("require-trusted-types-for 'script'"), std::string::npos);
  EXPECT_NE(answer.find("X-Content-Type-Options: nosniff"), std::string::npos);
  EXPECT_NE(answer.find("Content-Type: text/html; charset=utf-8"), std::string::npos);
  EXPECT_EQ(answer.find("Server:"), std::string::npos);
  EXPECT_TRUE(page.get("/pair.js").starts_with("HTTP/1.1 200"));
  for (const char* path : {"/nothing", "/../CMakeLists.txt", "/web/pair.js", "//pair.js", "/%2e%2e/pair.js"}) {
    RawPage other(address_.port());
    EXPECT_TRUE(other.get(path).starts_with("HTTP/1.1 404")) << path;
  }
}

TEST_F(PageServerTest, RefusesForeignHostsAndOriginsAndWhatIsTooLarge) {
  const auto answer = [&](const std::string& request) {
    RawPage page(address_.port());
    return page.ask(request).substr(0, 12);
  };
  const std::string host = "Host: " + own() + "\r\n";
  EXPECT_EQ(answer("GET / HTTP/1.1\r\nHost: evil.example:" + std::to_string(address_.port()) + "\r\n\r\n"),
            "HTTP/1.1 421");
  EXPECT_EQ(answer("GET / HTTP/1.1\r\n\r\n"), "HTTP/1.1 421");
  EXPECT_EQ(answer("DELETE / HTTP/1.1\r\n" + host + "\r\n"), "HTTP/1.1 405");
  EXPECT_EQ(answer("POST /pair HTTP/1.1\r\n" + host + "Content-Length: 1\r\n\r\nx"), "HTTP/1.1 403");
  EXPECT_EQ(answer("GET / HTTP/1.1\r\n" + host + "X: " + std::string(20'000, 'x') + "\r\n\r\n"), "HTTP/1.1 431");
  EXPECT_EQ(answer("POST / HTTP/1.1\r\n" + host + "Content-Length: 100000\r\n\r\n"), "HTTP/1.1 413");
  EXPECT_EQ(answer("\x16\x03\x01 nonsense\r\n\r\n"), "HTTP/1.1 400");
  for (const std::string& origin :
       {std::string(), std::string("http://evil.example"), "https://" + own(), std::string("null")}) {
    RawPage page(address_.port());
    EXPECT_EQ(page.upgrade("/ws", origin, own()).substr(0, 12), "HTTP/1.1 403") << origin;
  }
  RawPage page(address_.port());
  EXPECT_EQ(page.upgrade("/other", "http://" + own(), own()).substr(0, 12), "HTTP/1.1 404");
}

TEST_F(PageServerTest, AStateGoesDownAndAnEventUpAndItsAnswerBack) {
  RawPage page(address_.port());
  ASSERT_TRUE(page.open());
  const auto state = page.awaitState([](const json&) { return true; });
  ASSERT_TRUE(state);
  EXPECT_EQ((*state)["writer"], true);
  page.say(json{{"kind", "ping"}, {"t0", 7.0}});
  const auto pong = page.await([](const json& told) { return told["kind"] == "pong"; });
  ASSERT_TRUE(pong);
  EXPECT_LE((*pong)["t1"].get<std::int64_t>(), (*pong)["t2"].get<std::int64_t>());
  page.say(note(1));
  ASSERT_TRUE(comesTrue([&] { return heard().size() == 1; }));
  EXPECT_EQ(heard_[0].event.source, "evaluator");
  link_->answer(acknowledged("p1", 1));
  EXPECT_TRUE(page.await([](const json& told) { return told["kind"] == "ack" && told["seq"] == 1; }));
}

TEST_F(PageServerTest, KilledItIsBackOnTheSamePortWithTheNewestState) {
  RawPage before(address_.port());
  ASSERT_TRUE(before.open());
  ASSERT_TRUE(before.awaitState([](const json&) { return true; }));
  const auto killed = RawPage::Time::now();
  ::kill(link_->figures().process, SIGKILL);
  link_->tellState(json{{"kind", "state"}, {"phase", "debrief"}, {"serial", 2}}.dump());
  // The socket listens all the while: who comes now waits, and is not refused.
  RawPage after(address_.port());
  ASSERT_TRUE(after.isOpen());
  ASSERT_TRUE(after.open());
  EXPECT_TRUE(after.awaitState([](const json& told) { return told["serial"] == 2; }));
  RecordProperty("back_ms",
                 static_cast<int>(std::chrono::duration<double, std::milli>(RawPage::Time::now() - killed).count()));
}

TEST_F(PageServerTest, OneThatReadsNothingCostsNoMemoryAndGetsTheNewestPictureAfterwards) {
  RawPage page(address_.port(), 4096);
  ASSERT_TRUE(page.open());
  ASSERT_TRUE(page.awaitState([](const json&) { return true; }));
  render::Image noise{960, 540, std::vector<std::uint8_t>(4U * 960 * 540)};
  std::uint32_t random = 1;
  for (std::uint8_t& value : noise.rgba)
    value = static_cast<std::uint8_t>((random = random * 1664525 + 1013904223) >> 24U);
  const std::string state = json{{"kind", "state"}, {"text", std::string(300'000, 'x')}}.dump();
  long settled = 0;
  for (int n = 0; n < 300; ++n) {
    pictures_.write(noise, n);
    link_->tellState(state);
    if (n == 100) settled = residentKb();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_LT(residentKb() - settled, 1024);
  pictures_.write(noise, 12345);
  // Two may have been on their way; then the newest.
  std::int64_t newest_ns = 0;
  for (int n = 0; n < 2000 && newest_ns != 12345; ++n) {
    const auto message = page.hear(std::chrono::seconds(30));
    ASSERT_TRUE(message);
    if (message->opcode != 2) continue;
    ASSERT_GT(message->bytes.size(), 18u);
    std::memcpy(&newest_ns, message->bytes.data() + 8, 8);
    std::uint32_t serial = 0;
    std::memcpy(&serial, message->bytes.data() + 4, 4);
    EXPECT_EQ(message->bytes.substr(16, 2), "\xff\xd8");
    page.say(json{{"kind", "drawn"}, {"picture", serial}});
  }
  EXPECT_EQ(newest_ns, 12345);
}

TEST_F(PageServerTest, LyingClientsReachNobody) {
  RawPage honest(address_.port());
  ASSERT_TRUE(honest.open());
  const int process = link_->figures().process;
  const std::vector<std::string> good{note(5).dump(), R"({"kind":"ping","t0":1})", R"({"kind":"drawn","picture":4})"};
  std::optional<RawPage> liar;
  const auto newLiar = [&] {
    liar.emplace(address_.port());
    return liar->open();
  };
  ASSERT_TRUE(newLiar());
  int dropped = 0;
  mutants::forEachMutant(good, 3000, [&](const std::string& text, std::size_t, std::uint64_t number) {
    // Whole messages, bare bytes, and frames that lie about their length.
    if (number % 7 == 3)
      liar->sendBytes(text.substr(0, 40));
    else
      liar->sayText(text, number % 11 == 5 ? 2 : 1);
    while (liar->hear(std::chrono::milliseconds(0))) continue;
    if (liar->isOpen()) return;
    ++dropped;
    for (int n = 0; n < 3000 && !newLiar(); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  });
  EXPECT_GT(dropped, 0);
  liar.reset();
  // Whoever sends a message that is too long is dropped; many that say nothing are not more than so many.
  RawPage loud(address_.port());
  ASSERT_TRUE(loud.open());
  loud.sayText(std::string(200'000, 'x'));
  EXPECT_TRUE(comesTrue([&] { return !loud.hear(std::chrono::milliseconds(20)) && !loud.isOpen(); }));
  {
    std::vector<std::unique_ptr<RawPage>> idle;
    for (int n = 0; n < 100; ++n) idle.push_back(std::make_unique<RawPage>(address_.port()));
  }
  honest.say(json{{"kind", "ping"}, {"t0", 99.0}});
  EXPECT_TRUE(honest.await([](const json& told) { return told["kind"] == "pong" && told["t0"] == 99.0; }));
  EXPECT_EQ(link_->figures().process, process);
  EXPECT_EQ(link_->figures().refused, 0u);
}

TEST_F(PageServerTest, WithoutItsSessionItEnds) {
  RawPage page(address_.port());
  ASSERT_TRUE(page.open());
  link_.reset();
  EXPECT_TRUE(comesTrue([&] { return !page.hear(std::chrono::milliseconds(20)) && !page.isOpen(); }));
}

}  // namespace
}  // namespace app
