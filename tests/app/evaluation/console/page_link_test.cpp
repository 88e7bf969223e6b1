#include "app/evaluation/console/page_link.h"

#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "app/evaluation/console/page_address.h"
#include "app/evaluation/console/page_pictures.h"
#include "app/text/usage_error.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

/// Programs in the place of the page. They get: page --listener N --pictures N --bell N --words N …
class PageLinkTest : public testing::Test {
 protected:
  std::unique_ptr<PageLink> linked(const std::string& lines) {
    const std::string path = folder_.file("page.sh");
    std::ofstream(path) << "#!/bin/bash\nwords=$9\n"
                        << "say() { printf \"\\\\x$(printf %02x ${#1})\\\\x00\\\\x00\\\\x00%s\" \"$1\" >&$words; }\n"
                        << lines << "\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    PageLink::Parts parts;
    parts.listener = address_.descriptor(), parts.pictures = pictures_.memory(), parts.bell = pictures_.bell();
    parts.program = path;
    return std::make_unique<PageLink>(std::move(parts));
  }
  static bool comesTrue(const std::function<bool()>& is_so) {
    for (int n = 0; n < 6000; ++n) {
      if (is_so()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  tests::ScratchFolder folder_;
  PageAddress address_{"127.0.0.1:0", false};
  PicturesOut pictures_;
};

TEST_F(PageLinkTest, WhatItSaysArrivesWithItsTime) {
  const auto link = linked(R"(say '{"kind":"ready"}'; say '{"kind":"alive","pages":2}'; cat <&$words >/dev/null)");
  std::vector<PageLink::Heard> heard;
  ASSERT_TRUE(comesTrue([&] {
    for (PageLink::Heard& one : link->take()) heard.push_back(std::move(one));
    return heard.size() == 2;
  }));
  EXPECT_TRUE(std::holds_alternative<PageServes>(heard[0].word));
  EXPECT_EQ(std::get<PageLives>(heard[1].word).pages, 2);
  EXPECT_LE(heard[1].at_ns, std::chrono::steady_clock::now().time_since_epoch().count());
  EXPECT_EQ(link->figures().starts, 1);
}

TEST_F(PageLinkTest, OneThatEndsIsStartedAgainAndAgainAndNeverGivenUp) {
  const auto link = linked("exit 3");
  EXPECT_TRUE(comesTrue([&] { return link->figures().starts > 4; }));
  EXPECT_FALSE(link->takeLosses().empty());
}

TEST_F(PageLinkTest, OneThatTalksNonsenseIsReplacedAndNothingOfItIsHeard) {
  const auto link = linked(R"(head -c 3000 /dev/urandom >&$words; sleep 60)");
  EXPECT_TRUE(comesTrue([&] { return link->figures().starts > 2; }));
  EXPECT_TRUE(link->take().empty());
  EXPECT_GE(link->figures().refused, 1u);
}

TEST_F(PageLinkTest, AWordThatNobodyKnowsIsNonsenseToo) {
  const auto link = linked(R"(say '{"kind":"own the servo"}'; sleep 60)");
  EXPECT_TRUE(comesTrue([&] { return link->figures().refused > 1; }));
  EXPECT_TRUE(link->take().empty());
}

TEST_F(PageLinkTest, OneThatIsStoppedIsReplaced) {
  const auto link = linked(R"(say '{"kind":"ready"}'; while sleep 0.1; do say '{"kind":"alive","pages":0}'; done)");
  ASSERT_TRUE(comesTrue([&] { return !link->take().empty(); }));
  const int first = link->figures().process;
  ::kill(first, SIGSTOP);
  EXPECT_TRUE(comesTrue([&] { return link->figures().starts == 2; }));
  EXPECT_NE(link->figures().process, first);
}

TEST_F(PageLinkTest, ToOneThatReadsNothingStatesAreNotQueued) {
  const auto link = linked(R"(say '{"kind":"ready"}'; while sleep 0.1; do say '{"kind":"alive","pages":0}'; done)");
  ASSERT_TRUE(comesTrue([&] { return !link->take().empty(); }));
  const std::string state = R"({"kind":"state","text":")" + std::string(500'000, 'x') + "\"}";
  for (int n = 0; n < 20; ++n) link->tellState(state);
  // The first fills the socket, the newest waits: the session may go on.
  for (int n = 0; n < 20'000; ++n) link->answer(acknowledged("a", 1));
  EXPECT_FALSE(link->isStateSent());
  EXPECT_EQ(link->figures().starts, 1);
}

TEST_F(PageLinkTest, ANewProcessIsToldTheGreetingAndTheNewestStateFirst) {
  const std::string told = folder_.file("told");
  PageLink::Parts parts;
  const std::string path = folder_.file("page.sh");
  std::ofstream(path) << "#!/bin/bash\nwords=$9\n(timeout 2 head -c 40 <&$words; echo) >> " << told << "\nexit 1\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  parts.listener = address_.descriptor(), parts.pictures = pictures_.memory(), parts.bell = pictures_.bell();
  parts.program = path;
  parts.greeting = R"({"kind":"tokens"})";
  PageLink link(std::move(parts));
  link.tellState(R"({"kind":"state","n":1})");
  ASSERT_TRUE(comesTrue([&] { return link.figures().starts > 2; }));
  std::ifstream file(told, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  std::size_t greetings = 0, states = 0;
  for (std::size_t at = 0; (at = all.find("tokens", at)) != std::string::npos; ++at) ++greetings;
  for (std::size_t at = 0; (at = all.find("state", at)) != std::string::npos; ++at) ++states;
  EXPECT_GE(greetings, 2u);
  EXPECT_GE(states, 1u);
}

TEST_F(PageLinkTest, OthersMayReachItOnlyWhereItIsShared) {
  const auto refusal = [](const std::string& text, bool is_shared) -> std::string {
    try {
      const PageAddress address(text, is_shared);
      return "";
    } catch (const UsageError& error) {
      return error.what();
    }
  };
  EXPECT_NE(refusal("0.0.0.0:0", false).find("--share"), std::string::npos);
  EXPECT_NE(refusal("192.0.2.7:8080", false).find("--share"), std::string::npos);
  EXPECT_EQ(refusal("0.0.0.0:0", true), "");
  EXPECT_EQ(refusal("localhost:0", false), "");
  EXPECT_NE(refusal("127.0.0.1:" + std::to_string(address_.port()), false).find("another port"), std::string::npos);
  for (const char* text :
       {"", "8080", "127.0.0.1", "127.0.0.1:", "127.0.0.1:99999", "station.example:80", "127.0.0.1:x"})
    EXPECT_NE(refusal(text, false).find("--page"), std::string::npos) << text;
}

}  // namespace
}  // namespace app
