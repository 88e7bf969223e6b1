#include "haptics/device/usb/falcon_loader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace haptics {
namespace {

using Action = FalconLoader::Action;
using Bytes = std::vector<std::uint8_t>;

Bytes program(std::size_t size) {
  std::mt19937 random(1);
  Bytes bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

/// The loader's requests, and a boot loader with scripted answers.
struct Conversation {
  std::vector<FtdiRequest> requests;
  std::vector<Bytes> sent;
  int greetings = 0, deaf_greetings = 0;
  Bytes answer{0x0A, 0x44, 0x2C, 0x0D}, knock_answer{0x41};
  std::size_t wrong_echo_at = SIZE_MAX, silent_from = SIZE_MAX, echoed = 0;

  void hold(FalconLoader& loader, int most_steps = 100'000) {
    for (; most_steps > 0; --most_steps) switch (loader.next()) {
        case Action::request:
          requests.push_back(loader.request());
          loader.done();
          break;
        case Action::send:
          sent.emplace_back(loader.send().begin(), loader.send().end());
          loader.done();
          break;
        case Action::listen:
          listen(loader);
          break;
        default:
          return;
      }
    FAIL() << "it never came to an end";
  }

  void listen(FalconLoader& loader) {
    const Bytes& last = sent.back();
    if (last == Bytes{0x0A, 0x43, 0x0D}) {
      if (++greetings > deaf_greetings) loader.received(answer);
      if (loader.next() == Action::listen) loader.timedOut();
    } else if (last == Bytes{0x41}) {
      loader.received(knock_answer);
      if (loader.next() == Action::listen) loader.timedOut();
    } else {
      for (std::uint8_t byte : last) {
        if (echoed >= silent_from) return loader.timedOut();
        loader.received(Bytes{static_cast<std::uint8_t>(echoed == wrong_echo_at ? byte ^ 1 : byte)});
        ++echoed;
      }
    }
  }
};

TEST(FalconLoader, SendsTheWholeProgramInPiecesThatFitAPacket) {
  for (std::size_t size : {1u, 61u, 62u, 63u, 124u, 8492u}) {
    const Bytes wanted = program(size);
    FalconLoader loader(wanted);
    Conversation talk;
    talk.hold(loader);
    ASSERT_EQ(loader.next(), Action::done) << loader.trouble();
    Bytes arrived;
    for (std::size_t i = 2; i < talk.sent.size(); ++i) {
      EXPECT_LE(talk.sent[i].size(), 62u);
      arrived.insert(arrived.end(), talk.sent[i].begin(), talk.sent[i].end());
    }
    EXPECT_EQ(arrived, wanted);
  }
}

TEST(FalconLoader, SetsTheBridgeAsThePublicProgramsDo) {
  const Bytes wanted = program(10);
  FalconLoader loader(wanted);
  Conversation talk;
  talk.hold(loader);
  const std::vector<std::pair<int, int>> expected{
      {0, 1},      {0, 2},      {9, 16},     {3, 0x4138}, {4, 8},
      {2, 0},      {1, 0x0200}, {1, 0x0100}, {1, 0x0101},  // 9600 8N1, DTR up
      {1, 0x0100}, {3, 0x15},                              // 140 kbaud
      {9, 1},      {3, 2},      {0, 1},      {0, 2}};      // 1.5 Mbaud
  ASSERT_EQ(talk.requests.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(talk.requests[i].request, expected[i].first) << i;
    EXPECT_EQ(talk.requests[i].value, expected[i].second) << i;
  }
}

TEST(FalconLoader, RepeatsTheGreetingUntilAnsweredAndAcceptsAZeroBeforeTheAnswer) {
  const Bytes wanted = program(10);
  FalconLoader loader(wanted);
  Conversation talk;
  talk.deaf_greetings = 99;
  talk.answer = {0x00, 0x0A, 0x44, 0x2C, 0x0D};
  talk.hold(loader);
  EXPECT_EQ(loader.next(), Action::done) << loader.trouble();
  EXPECT_EQ(talk.greetings, 100);
}

TEST(FalconLoader, GivesUpWithoutAnAnswerToTheGreetingAndSendsNothingMore) {
  for (const Bytes& answer :
       {Bytes{}, Bytes{0x0A, 0x44, 0x2C}, Bytes{0x0A, 0x43, 0x0D}, Bytes{0xFF, 0x0A, 0x44, 0x2C, 0x0D}}) {
    const Bytes wanted = program(10);
    FalconLoader loader(wanted);
    Conversation talk;
    talk.answer = answer;
    talk.hold(loader);
    EXPECT_EQ(loader.next(), Action::failed);
    EXPECT_EQ(loader.trouble(), "it does not answer the greeting");
    EXPECT_EQ(talk.greetings, 100);
    for (const Bytes& bytes : talk.sent) EXPECT_EQ(bytes, (Bytes{0x0A, 0x43, 0x0D}));
  }
}

TEST(FalconLoader, AWrongEchoStopsIt) {
  const Bytes wanted = program(500);
  FalconLoader loader(wanted);
  Conversation talk;
  talk.wrong_echo_at = 200;
  talk.hold(loader);
  ASSERT_EQ(loader.next(), Action::failed);
  EXPECT_THAT(loader.trouble(), testing::StartsWith("byte 200 of 500 came back as 0x"));
  // The piece with byte 200 was the last.
  std::size_t sent = 0;
  for (std::size_t i = 2; i < talk.sent.size(); ++i) sent += talk.sent[i].size();
  EXPECT_EQ(sent, 248u);
}

TEST(FalconLoader, ATimeoutDuringLoadingStopsIt) {
  const Bytes wanted = program(500);
  FalconLoader loader(wanted);
  Conversation talk;
  talk.silent_from = 100;
  talk.hold(loader);
  EXPECT_EQ(loader.next(), Action::failed);
  EXPECT_EQ(loader.trouble(), "it fell silent after 100 of 500 bytes");
}

TEST(FalconLoader, AWrongAnswerToTheProbeStopsItBeforeTheProgram) {
  for (const Bytes& answer : {Bytes{0x42}, Bytes{}}) {
    const Bytes wanted = program(500);
    FalconLoader loader(wanted);
    Conversation talk;
    talk.knock_answer = answer;
    talk.hold(loader);
    EXPECT_EQ(loader.next(), Action::failed);
    EXPECT_EQ(talk.sent.back(), Bytes{0x41});
  }
}

TEST(FalconLoader, TerminatesForAnyAnswersOfTheDevice) {
  // Two million random bytes and silences: it never hangs, never reads beyond its program, never claims success unless
  // every byte came back.
  std::mt19937 random(6);
  std::uint64_t bytes = 0;
  int ended = 0;
  for (int run = 0; bytes < 2'000'000; ++run) {
    const Bytes wanted = program(random() % 300);
    FalconLoader loader(wanted, 5);
    Bytes sent;
    const bool friendly = run % 2 == 0;
    for (int step = 0; step < 5000 && loader.next() != Action::done && loader.next() != Action::failed; ++step) {
      if (loader.next() == Action::send) sent.assign(loader.send().begin(), loader.send().end());
      if (loader.next() != Action::listen) {
        loader.done();
        continue;
      }
      Bytes heard(random() % 80);
      for (auto& byte : heard) byte = static_cast<std::uint8_t>(random());
      if (friendly && random() % 50 != 0)
        heard = sent == Bytes{0x0A, 0x43, 0x0D} ? Bytes{0, 0x0A, 0x44, 0x2C, 0x0D} : sent;
      bytes += heard.size() + 1;
      loader.received(heard);
      if (random() % 3 == 0) loader.timedOut();
    }
    ASSERT_TRUE(loader.next() == Action::done || loader.next() == Action::failed);
    ASSERT_EQ(loader.next() == Action::failed, !loader.trouble().empty());
    if (loader.next() == Action::done) {
    }
    ended += loader.next() == Action::done;
  }
  EXPECT_GT(ended, 100);
}

}  // namespace
}  // namespace haptics
