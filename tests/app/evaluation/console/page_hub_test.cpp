#include "app/evaluation/console/page_hub.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/evaluation/console/page_words.h"
#include "tests/mutants.h"

namespace app {
namespace {

using nlohmann::json;

constexpr std::int64_t kHubNow_ns = 50'000'000'000;

class PageHubTest : public testing::Test {
 protected:
  json next(int client, std::int64_t now_ns = kHubNow_ns) {
    const auto out = hub_.next(client, now_ns);
    return out && !out->is_picture ? json::parse(*out->bytes) : json();
  }
  bool hear(int client, const json& said, std::int64_t now_ns = kHubNow_ns) {
    return hub_.hear(client, said.dump(), now_ns);
  }
  void tellState(std::vector<double> course = {}) {
    json points = json::array();
    for (const double t_s : course) points.push_back({{"t_s", t_s}, {"force_N", 1.0}});
    hub_.tell(json{
        {"kind", "state"},
        {"phase", "tasks"},
        {"notes", {{{"text", "canary"}}}},
        {"prompts", {1}},
        {"checks", {1}},
        {"task", {{"id", "one"}, {"success", {1}}, {"fail", {1}}}},
        {"course",
         points}}.dump());
  }
  static json note(const std::string& page, int number, std::int64_t t_ns = kHubNow_ns) {
    return {{"kind", "event"},
            {"page", page},
            {"seq", number},
            {"type", "note"},
            {"t_ns", t_ns},
            {"rtt_ms", 1.0},
            {"data", {{"kind", "behaviour"}, {"text", "x"}}}};
  }
  int evaluator(const std::string& page = "") { return hub_.join(PageHub::Role::evaluator, page, kHubNow_ns); }

  PageHub hub_;
};

TEST_F(PageHubTest, APingComesBackWithBothTimes) {
  const int page = evaluator();
  EXPECT_TRUE(hear(page, {{"kind", "ping"}, {"t0", 123.25}}, 1000));
  const json pong = next(page, 2000);
  EXPECT_EQ(pong["kind"], "pong");
  EXPECT_EQ(pong["t0"], 123.25);
  EXPECT_EQ(pong["t1"], 1000);
  EXPECT_EQ(pong["t2"], 2000);
}

TEST_F(PageHubTest, OneWritesAnotherSeesAndTakesOver) {
  const int first = evaluator(), second = evaluator();
  tellState();
  EXPECT_EQ(next(first)["writer"], true);
  EXPECT_EQ(next(second)["writer"], false);
  EXPECT_TRUE(hear(second, note("b", 1)));
  EXPECT_TRUE(hub_.takeUp().empty());
  const json refused = next(second);
  EXPECT_EQ(refused["kind"], "refused");
  EXPECT_EQ(refused["seq"], 1);
  EXPECT_TRUE(hear(second, {{"kind", "take-over"}}, kHubNow_ns + 100));
  EXPECT_EQ(next(first)["writer"], false);
  EXPECT_EQ(next(second)["writer"], true);
  // What was typed before that still counts, later words do not.
  EXPECT_TRUE(hear(first, note("a", 1, kHubNow_ns + 99)));
  EXPECT_EQ(hub_.takeUp().size(), 1u);
  EXPECT_TRUE(hear(first, note("a", 2, kHubNow_ns + 101)));
  EXPECT_TRUE(hub_.takeUp().empty());
  hub_.leave(second);
  next(first);
  EXPECT_EQ(next(first)["writer"], true);
}

TEST_F(PageHubTest, AReloadedPageTakesItsOwnPlace) {
  const int first = evaluator("p1");
  evaluator("p2");
  const int again = evaluator("p1");
  EXPECT_EQ(hub_.takeUnwelcome(), std::vector<int>{first});
  hub_.leave(first);
  tellState();
  EXPECT_EQ(next(again)["writer"], true);
}

TEST_F(PageHubTest, TheParticipantSeesNothingThatIsWrittenAboutHim) {
  const int page = hub_.join(PageHub::Role::participant, "", kHubNow_ns);
  tellState({1.0});
  const json state = next(page);
  EXPECT_EQ(state["role"], "participant");
  EXPECT_EQ(state.dump().find("canary"), std::string::npos);
  for (const char* key : {"notes", "prompts", "checks", "course"}) EXPECT_TRUE(state[key].empty()) << key;
  EXPECT_TRUE(state["task"]["success"].empty());
  hub_.show(1, 2, "jpeg");
  EXPECT_FALSE(hub_.next(page, kHubNow_ns));
}

TEST_F(PageHubTest, EachPageGetsTheNewestStateAndThePointsItLacks) {
  const int early = evaluator();
  tellState({1.0, 2.0});
  EXPECT_EQ(next(early)["course"].size(), 2u);
  EXPECT_TRUE(next(early).is_null());
  tellState({3.0});
  tellState({4.0});
  EXPECT_EQ(next(early)["course"].size(), 2u);
  EXPECT_TRUE(next(early).is_null());
  const int late = evaluator();
  EXPECT_EQ(next(late)["course"].size(), 4u);
  tellState({70.0});
  // A minute is kept.
  const int latest = evaluator();
  EXPECT_EQ(next(latest)["course"].size(), 1u);
}

TEST_F(PageHubTest, NoPictureIsQueuedAndTwoAtMostAreUndrawn) {
  const int page = evaluator();
  EXPECT_TRUE(hub_.wantsPicture());
  const auto serialOf = [&] {
    const auto out = hub_.next(page, kHubNow_ns);
    return out && out->is_picture ? static_cast<int>(static_cast<unsigned char>((*out->bytes)[4])) : 0;
  };
  for (std::uint32_t serial = 1; serial <= 3; ++serial) hub_.show(serial, 0, "jpeg");
  EXPECT_EQ(serialOf(), 3);
  EXPECT_EQ(serialOf(), 0);
  hub_.show(4, 0, "jpeg");
  EXPECT_EQ(serialOf(), 4);
  hub_.show(5, 0, "jpeg");
  EXPECT_EQ(serialOf(), 0);
  EXPECT_FALSE(hub_.wantsPicture());
  // Nobody is believed who has drawn what was not sent, or twice.
  hear(page, {{"kind", "drawn"}, {"picture", 9}});
  EXPECT_FALSE(hub_.wantsPicture());
  hear(page, {{"kind", "drawn"}, {"picture", 3}});
  EXPECT_TRUE(hub_.wantsPicture());
  EXPECT_EQ(serialOf(), 5);
  hear(page, {{"kind", "drawn"}, {"picture", 3}});
  EXPECT_FALSE(hub_.wantsPicture());
  hear(page, {{"kind", "drawn"}, {"picture", 5}});
  hub_.show(6, 0, "jpeg");
  hub_.show(7, 0, "jpeg");
  EXPECT_EQ(serialOf(), 7);
}

TEST_F(PageHubTest, AnAnswerGoesToItsPageAlone) {
  const int one = evaluator("p1"), other = evaluator("p2");
  hub_.tell(acknowledged("p1", 4));
  EXPECT_EQ(next(one)["seq"], 4);
  EXPECT_TRUE(next(other).is_null());
}

TEST_F(PageHubTest, WhoSaysTooMuchOrNonsenseIsDroppedAndNothingGrows) {
  const int loud = evaluator();
  int taken = 0;
  while (hear(loud, {{"kind", "ping"}, {"t0", 1}}) && taken < 10'000) ++taken;
  EXPECT_EQ(taken, PageHub::kMostPerSecond);
  EXPECT_TRUE(hear(loud, {{"kind", "ping"}, {"t0", 1}}, kHubNow_ns + 2'000'000'000));
  const int mad = evaluator();
  taken = 0;
  while (hub_.hear(mad, "{]", kHubNow_ns) && taken < 10'000) ++taken;
  EXPECT_EQ(taken, PageHub::kMostNonsense);
  // One that takes no answers gets no more than so many.
  const int deaf = evaluator();
  for (std::int64_t n = 0; n < 3000; ++n) hear(deaf, {{"kind", "ping"}, {"t0", n}}, kHubNow_ns + n * 10'000'000'000);
  std::size_t answers = 0;
  while (!next(deaf).is_null()) ++answers;
  EXPECT_EQ(answers, PageHub::kMostReplies);
}

TEST_F(PageHubTest, WhoWritesSteersTheDebriefAndNonsenseIsCounted) {
  const int writer = hub_.join(PageHub::Role::evaluator, "a", 1), other = hub_.join(PageHub::Role::evaluator, "b", 2);
  const int participant = hub_.join(PageHub::Role::participant, "c", 3);
  const std::string seek = R"({"kind":"steer","what":"seek","value":12.5})";
  hub_.hear(other, seek, 4), hub_.hear(participant, seek, 4);
  EXPECT_TRUE(hub_.takeUp().empty());
  hub_.hear(writer, seek, 5);
  ASSERT_EQ(hub_.takeUp().size(), 1u);
  for (int n = 0; n < PageHub::kMostNonsense; ++n)
    ASSERT_TRUE(hub_.hear(writer, R"({"kind":"steer","what":"seek","value":-1})", 6));
  EXPECT_FALSE(hub_.hear(writer, R"({"kind":"steer","what":"seek","value":-1})", 6));
  EXPECT_TRUE(hub_.takeUp().empty());
}

TEST_F(PageHubTest, PairingIsTheSessionsToDecide) {
  const std::int64_t asked = hub_.pair("123456");
  const auto up = hub_.takeUp();
  ASSERT_EQ(up.size(), 1u);
  EXPECT_EQ(json::parse(up[0])["digits"], "123456");
  hub_.tell(json{{"kind", "paired"}, {"request", asked}, {"token", "abc"}}.dump());
  const auto told = hub_.takePaired();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].token, "abc");
  EXPECT_FALSE(hub_.isValid("abc", 5));
  hub_.tell(json{{"kind", "tokens"}, {"tokens", {{{"token", "abc"}, {"until_ns", 10}}}}}.dump());
  EXPECT_TRUE(hub_.isValid("abc", 5));
  EXPECT_FALSE(hub_.isValid("abc", 11));
  EXPECT_FALSE(hub_.isValid("", 5));
}

/// What a browser says, however damaged, and whatever the page's process makes of it: the session understands each
/// word.
TEST(PageHubMutants, WhateverPagesSayTheSessionUnderstandsWhatIsHandedOn) {
  const std::vector<std::string> good{
      R"({"kind":"event","page":"a-1","session":"7","seq":3,"type":"note","t_ns":123456789012345,"rtt_ms":4.5,"data":{"kind":"comment","text":"\u00e4","severity":2}})",
      R"({"kind":"event","page":"b","seq":9,"type":"answer","t_ns":5,"data":{"questionnaire":"sus","item":"1","value":4}})",
      R"({"kind":"ping","t0":1764361234567.25})",
      R"({"kind":"drawn","picture":4})",
      R"({"kind":"take-over"})",
      R"({"kind":"steer","what":"seek","value":12.5})"};
  std::size_t handed = 0;
  std::int64_t now_ns = 0;
  PageHub hub;
  int page = hub.join(PageHub::Role::evaluator, "", 1);
  mutants::forEachMutant(good, 6000, [&](const std::string& text, std::size_t, std::uint64_t) {
    now_ns += 2'000'000'000;
    if (!hub.hear(page, text, now_ns)) {
      hub.leave(page);
      page = hub.join(PageHub::Role::evaluator, "", now_ns);
    }
    for (const std::string& up : hub.takeUp()) {
      ++handed;
      EXPECT_TRUE(pageWordFrom(up)) << up;
      EXPECT_LE(up.size(), kMostUp);
    }
    while (hub.next(page, now_ns)) continue;
  });
  EXPECT_GT(handed, 0u);
}

}  // namespace
}  // namespace app
