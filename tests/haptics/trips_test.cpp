#include "haptics/safety/trips.h"

#include <gtest/gtest.h>

#include <set>

namespace haptics {
namespace {

TEST(Trips, EveryFaultHasWordsOfItsOwn) {
  std::set<std::string_view> keys, sentences;
  for (std::size_t bit = 0; bit < kTripKinds; ++bit) {
    EXPECT_EQ(static_cast<std::uint32_t>(kTrips[bit].fault), 1u << bit) << kTrips[bit].key;
    keys.insert(kTrips[bit].key);
    sentences.insert(kTrips[bit].what);
    for (std::string_view text : {kTrips[bit].what, kTrips[bit].next}) {
      ASSERT_FALSE(text.empty()) << bit;
      EXPECT_EQ(text.back(), '.') << text;
      EXPECT_LT(text.size(), 100u) << text;
    }
  }
  EXPECT_EQ(keys.size(), kTripKinds);
  EXPECT_EQ(sentences.size(), kTripKinds);
  EXPECT_EQ(static_cast<std::uint32_t>(Fault::stopped), 1u << (kTripKinds - 1)) << "the last one";
}

TEST(Trips, EveryStateHasWords) {
  std::set<std::string_view> keys;
  for (auto state : {SafetyState::off, SafetyState::calibrate, SafetyState::ready, SafetyState::armed,
                     SafetyState::active, SafetyState::fault})
    keys.insert(textOf(state).key);
  EXPECT_EQ(keys.size(), 6u);
  EXPECT_EQ(textOf(SafetyState::fault).key, "fault");
  EXPECT_EQ(textOf(static_cast<SafetyState>(77)).key, "fault") << "whatever a damaged file says";
}

TEST(TripCounter, CountsBeginningsAndKnowsFirstAndLastTick) {
  TripCounter ledger;
  ledger.add(10, Fault::none);
  ledger.add(11, Fault::clamped);
  ledger.add(12, Fault::clamped | Fault::hot);
  ledger.add(13, Fault::hot);
  ledger.add(20, Fault::clamped);
  ledger.add(21, Fault::none);
  EXPECT_EQ(ledger.of(Fault::clamped).times, 2u);
  EXPECT_EQ(ledger.of(Fault::clamped).first_tick, 11u);
  EXPECT_EQ(ledger.of(Fault::clamped).last_tick, 20u);
  EXPECT_EQ(ledger.of(Fault::hot).times, 1u);
  EXPECT_EQ(ledger.of(Fault::hot).last_tick, 13u);
  EXPECT_EQ(ledger.of(Fault::stopped).times, 0u);
}

}  // namespace
}  // namespace haptics
