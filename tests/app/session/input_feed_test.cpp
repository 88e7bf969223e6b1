#include "app/session/input_feed.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "app/session/rerun.h"
#include "app/session/session_error.h"
#include "tests/app/session/real_session.h"
#include "tests/mutants.h"

namespace app {
namespace {

std::string bytesIn(const InputFeed& feed) {
  std::string bytes(feed.bytes(), '\0');
  EXPECT_EQ(::pread(feed.descriptor(), bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  return bytes;
}

/// A feed with these bytes.
class Memory {
 public:
  explicit Memory(const std::string& bytes) : descriptor_(::memfd_create("test", MFD_CLOEXEC)) { add(bytes); }
  ~Memory() { ::close(descriptor_); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  void add(std::string_view bytes) {
    EXPECT_EQ(::write(descriptor_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

struct Fed {
  InputFeed feed;
  test::BoneBlock block;
  std::vector<haptics::Tick> ticks;

  Fed() {
    haptics::Bodies bone(block.grid, block.solid, block.label);
    const haptics::Command first = block.start().command;
    constexpr std::size_t kTicks = 400, kChange = 150, kTogether = 20;
    ticks = test::rehearse(bone, first, kTicks, kChange);
    const SessionCommand start{first, 0}, later{test::largerBur(first), kChange};
    feed.take({&start, 1}, {});
    for (std::size_t n = 0; n < kTicks; n += kTogether) {
      const bool changes = n <= kChange && kChange < n + kTogether;
      feed.take({&later, changes ? std::size_t{1} : std::size_t{0}}, std::span(ticks).subspan(n, kTogether));
    }
  }
};

TEST(InputFeed, WhoRunsTheServoByItGetsTheSameBitsInEveryTick) {
  const Fed fed;
  haptics::Bodies again(fed.block.grid, fed.block.solid, fed.block.label);
  const assets::SoftTissueField nothing;
  Rerun rerun(again, nothing, {});
  rerun.expectMore();
  InputFeedReader reader(fed.feed.descriptor());
  std::size_t followed = 0;
  while (const auto batch = reader.next()) {
    rerun.add(batch->commands);
    for (const FedTick& tick : batch->ticks) {
      EXPECT_FALSE(rerun.prepare(tick.input));
      const haptics::Tick made = rerun.step(tick.input);
      ASSERT_FALSE(differenceOf(fed.ticks[followed], made)) << followed;
      ASSERT_EQ(digestOf(made), tick.digest) << followed;
      ++followed;
    }
  }
  EXPECT_EQ(followed, fed.ticks.size());
  EXPECT_FALSE(fed.feed.hasEnded());
}

TEST(InputFeed, AnyNumberOfATickIsInItsDigestButForTheTimeItTook) {
  const haptics::Tick tick = test::imaginedTick(17);
  haptics::Tick other = tick;
  other.work_us = 99.0f;
  EXPECT_EQ(digestOf(other), digestOf(tick));
  other.law_force_P_N.xyz.y = std::nextafter(other.law_force_P_N.xyz.y, 9.0);
  EXPECT_NE(digestOf(other), digestOf(tick));
  other = tick;
  other.bone_digest ^= 1;
  EXPECT_NE(digestOf(other), digestOf(tick));
}

TEST(InputFeed, HalfARecordIsWaitedFor) {
  const Fed fed;
  const std::string bytes = bytesIn(fed.feed);
  for (const std::size_t part : {std::size_t{0}, std::size_t{7}, std::size_t{300}, bytes.size() - 1}) {
    Memory memory(bytes.substr(0, part));
    InputFeedReader reader(memory.descriptor());
    std::size_t ticks = 0;
    while (const auto batch = reader.next()) ticks += batch->ticks.size();
    EXPECT_LT(ticks, fed.ticks.size());
    memory.add(std::string_view(bytes).substr(part));
    while (const auto batch = reader.next()) ticks += batch->ticks.size();
    EXPECT_EQ(ticks, fed.ticks.size()) << part;
  }
}

TEST(InputFeed, WhatIsNoFeedIsRefused) {
  const Fed fed;
  std::uint64_t refused = 0;
  mutants::forEachMutant({bytesIn(fed.feed)}, 500, [&](const std::string& mutant, std::size_t, std::uint64_t) {
    const Memory memory(mutant);
    try {
      InputFeedReader reader(memory.descriptor());
      while (reader.next()) {
      }
    } catch (const SessionError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      ++refused;
    }
  });
  EXPECT_GT(refused, 0u);
}

}  // namespace
}  // namespace app
