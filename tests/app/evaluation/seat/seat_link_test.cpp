#include "app/evaluation/seat/seat_link.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "tests/app/session/small_session.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds kNoWait{0}, kLong{60'000};

/// Programs in the place of a seat. They get: seat --recording N --feed N --words N …
class SeatLinkTest : public testing::Test {
 protected:
  std::string program(const std::string& lines) {
    const std::string path = folder_.file("seat.sh");
    std::ofstream(path) << "#!/bin/bash\nwords=$7\n" << lines << "\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
  }
  std::string recording() {
    const std::string path = folder_.file("s.molar");
    std::ofstream(path) << "nothing";
    return path;
  }
  /// Until it is lost, or a minute is over.
  static std::vector<std::string> newsOf(SeatLink& link) {
    std::vector<std::string> types;
    for (int n = 0; n < 6000 && !link.isLost(); ++n) {
      link.update(10, kNoWait);
      for (const BoneSource::News& news : link.takeNews()) types.push_back(news.type);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return types;
  }

  tests::ScratchFolder folder_;
  InputFeed feed_;
};

TEST_F(SeatLinkTest, OneThatEndsAtOnceIsStartedAgainAndThenGivenUp) {
  SeatLink link(feed_, {"O2.plan"}, "/bin/true");
  link.start(recording());
  const std::vector<std::string> news = newsOf(link);
  EXPECT_TRUE(link.isLost());
  EXPECT_EQ(std::ranges::count(news, "seat.lost"), SeatLink::kMostStarts);
  EXPECT_EQ(std::ranges::count(news, "seat.given_up"), 1);
  EXPECT_EQ(link.followed(), 0u);
  EXPECT_EQ(link.figures().starts, SeatLink::kMostStarts);
}

TEST_F(SeatLinkTest, OneThatTalksNonsenseIsEnded) {
  SeatLink link(feed_, {"O2.plan"}, program("head -c 320 /dev/urandom >&$words; exec sleep 1000"));
  link.start(recording());
  const int first = link.process();
  const std::vector<std::string> news = newsOf(link);
  EXPECT_TRUE(link.isLost());
  EXPECT_EQ(std::ranges::count(news, "seat.lost"), SeatLink::kMostStarts);
  // Neither it nor the last is left.
  EXPECT_FALSE(std::filesystem::exists("/proc/" + std::to_string(first)));
  EXPECT_EQ(link.process(), 0);
}

TEST_F(SeatLinkTest, OneThatIsAheadOfTheFrameIsBelieved) {
  // "All ticks until 49 are followed."
  const std::string says =
      R"(printf 'seat\x03\x00\x00\x00\x31\x00\x00\x00\x00\x00\x00\x00)"
      R"(\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00' >&$words; exec sleep 1000)";
  feed_.take({}, test::imaginedTicks(0, 50));
  SeatLink link(feed_, {"O2.plan"}, program(says));
  link.start(recording());
  link.update(10, kLong);
  EXPECT_FALSE(link.isLost());
  EXPECT_EQ(link.followed(), 50u);
  EXPECT_TRUE(link.takeNews().empty());
}

TEST_F(SeatLinkTest, WhoWaitsForOneThatIsGoneIsLetGo) {
  SeatLink link(feed_, {"O2.plan"}, "/no/such/program");
  link.start(recording());
  link.update(10, kLong);
  EXPECT_TRUE(link.isLost());
  SeatLink other(feed_, {"O2.plan"}, "/bin/true");
  other.start(recording());
  other.update(10, kLong);
  EXPECT_TRUE(other.isLost());
}

TEST_F(SeatLinkTest, WithTheEndOfTheFeedItIsLost) {
  SeatLink link(feed_, {"O2.plan"}, program("exec sleep 1000"));
  link.start(recording());
  link.update(10, kNoWait);
  EXPECT_FALSE(link.isLost());
  feed_.end();
  link.update(10, kLong);
  EXPECT_TRUE(link.isLost());
}

}  // namespace
}  // namespace app
