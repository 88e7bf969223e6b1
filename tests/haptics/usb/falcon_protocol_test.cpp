#include "haptics/device/usb/falcon_protocol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace haptics {
namespace {

std::vector<std::uint8_t> bytesOf(const std::string& text) { return {text.begin(), text.end()}; }
std::string textOf(const FalconPacket& packet) { return {packet.begin(), packet.end()}; }

/// As a unit would write it.
std::vector<std::uint8_t> written(const std::array<std::int16_t, 3>& encoders, unsigned buttons, unsigned homed) {
  std::string text = "<";
  for (std::int16_t encoder : encoders)
    for (int shift = 0; shift < 16; shift += 4)
      text += static_cast<char>('A' + ((static_cast<unsigned>(encoder) & 0xFFFFu) >> shift & 15u));
  const unsigned flags = buttons | homed << 4;
  return bytesOf(text + static_cast<char>('A' + flags) + "A>");
}

TEST(FalconProtocol, NoForceIsThePacketThatPublicCodeSends) {
  EXPECT_EQ(textOf(encoded({{0, 0, 0}, false, FalconLights::none})), "<AAAAAAAAAAAAAA>");
  EXPECT_EQ(textOf(encoded({{0, 0, 0}, true, FalconLights::red})), "<AAAAAAAAAAAAJA>");
}

TEST(FalconProtocol, WritesWordsLeastNibbleFirst) {
  // 0x0123, -1 = 0xFFFF, -4096 = 0xF000.
  EXPECT_EQ(textOf(encoded({{0x0123, -1, -4096}, false, FalconLights::green})), "<DCBAPPPPAAAPCA>");
}

TEST(FalconProtocol, ClampsMotorWordsToTheirRange) {
  EXPECT_EQ(encoded({{5000, -70000, 4096}, true, FalconLights::blue}),
            encoded({{4096, -4096, 4096}, true, FalconLights::blue}));
}

TEST(FalconProtocol, ReadsEveryReportAUnitCanWrite) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> any(-32768, 32767);
  for (int i = 0; i < 20'000; ++i) {
    std::array<std::int16_t, 3> encoders;
    for (auto& encoder : encoders) encoder = static_cast<std::int16_t>(any(random));
    const unsigned buttons = random() % 16, homed = random() % 8;
    const auto report = decodeFalconReport(written(encoders, buttons, homed));
    ASSERT_TRUE(report);
    ASSERT_EQ(report->encoders, encoders);
    ASSERT_EQ(report->buttons, buttons);
    ASSERT_EQ(report->homed, homed);
    ASSERT_EQ(report->isHomed(), homed == 7);
  }
}

TEST(FalconProtocol, RejectsEverythingThatIsNotExactlyAPacket) {
  const auto good = written({1, -2, 3}, 5, 7);
  ASSERT_TRUE(decodeFalconReport(good));
  for (std::size_t size = 0; size < 16; ++size) EXPECT_FALSE(decodeFalconReport(std::span(good).first(size))) << size;
  auto longer = good;
  longer.push_back('>');
  EXPECT_FALSE(decodeFalconReport(longer));
  for (std::size_t at = 0; at < 16; ++at)
    for (int value : {0x00, 0x3C, 0x3E, 0x40, 0x51, 0xC1, 0xFF}) {
      auto bad = good;
      bad[at] = static_cast<std::uint8_t>(value);
      const bool may = bad == good || at == 14 || (at == 13 && value == 0x51);
      EXPECT_EQ(decodeFalconReport(bad).has_value(), may) << at << " " << value;
    }
}

TEST(FalconProtocol, ATransferLosesTheModemBytesOfEachOfItsPackets) {
  std::vector<std::uint8_t> transfer, expected;
  for (int packet = 0; packet < 3; ++packet) {
    transfer.insert(transfer.end(), {0x01, 0x60});
    for (int i = 0; i < (packet < 2 ? 62 : 7); ++i) {
      expected.push_back(static_cast<std::uint8_t>(packet * 70 + i));
      transfer.push_back(expected.back());
    }
  }
  std::vector<std::uint8_t> payload(transfer.size());
  payload.resize(ftdiPayload(transfer, payload));
  EXPECT_EQ(payload, expected);
  for (std::size_t size = 0; size <= 2; ++size) {
    std::vector<std::uint8_t> few(size, 0x60), room(2);
    EXPECT_EQ(ftdiPayload(few, room), 0u);
  }
}

TEST(FalconStream, PutsPacketsTogetherHoweverTheyAreSplit) {
  std::mt19937 random(2);
  FalconStream stream;
  std::vector<std::uint8_t> line;
  for (std::int16_t i = 0; i < 500; ++i) {
    const auto packet = written({i, static_cast<std::int16_t>(-i), 7}, 0, 7);
    line.insert(line.end(), packet.begin(), packet.end());
  }
  std::int16_t next = 0;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t size = std::min<std::size_t>(random() % 16, line.size() - at);
    if (const auto packet = stream.take(std::span(line).subspan(at, size))) {
      ASSERT_EQ(decodeFalconReport(*packet)->encoders[0], next);
      ++next;
    }
    at += size;
  }
  EXPECT_EQ(next, 500);
  EXPECT_EQ(stream.rejected(), 0u);
}

TEST(FalconStream, FindsTheVeryNextPacketAfterGarbageOrATruncatedOne) {
  const auto good = written({11, 12, 13}, 1, 7);
  for (const std::string& before : {std::string("xyz>>"), std::string("<"), std::string("<<<<"), std::string("<AAAA"),
                                    std::string("<AAAAAAAAAAAAAA"), std::string(40, 'A'), std::string("<BBBB<CC")}) {
    FalconStream stream;
    stream.take(bytesOf(before));
    const auto packet = stream.take(good);
    ASSERT_TRUE(packet) << before;
    EXPECT_EQ(decodeFalconReport(*packet)->encoders[0], 11) << before;
    EXPECT_EQ(stream.rejected(), before.size());
  }
}

TEST(FalconProtocol, AMillionMutatedReportsAreReadCorrectlyOrRejected) {
  std::mt19937 random(4);
  FalconStream stream;
  std::uint64_t taken = 0, refused = 0;
  for (int i = 0; i < 1'200'000; ++i) {
    const std::array<std::int16_t, 3> encoders{static_cast<std::int16_t>(random()), static_cast<std::int16_t>(random()),
                                               static_cast<std::int16_t>(random())};
    std::vector<std::uint8_t> transfer{0x01, 0x60};
    const auto packet = written(encoders, random() % 16, random() % 8);
    transfer.insert(transfer.end(), packet.begin(), packet.end());
    const auto clean = packet;
    for (unsigned change = random() % 4; change > 0; --change)
      transfer[2 + random() % 16] = static_cast<std::uint8_t>(random());
    if (random() % 8 == 0) transfer.resize(random() % (transfer.size() + 1));
    if (random() % 8 == 0) transfer.insert(transfer.end(), random() % 150, static_cast<std::uint8_t>(random()));

    std::vector<std::uint8_t> payload(transfer.size());
    payload.resize(ftdiPayload(transfer, payload));
    stream.take(payload);
    if (const auto report = decodeFalconReport(payload)) {
      ++taken;
      // What it took says exactly what it read.
      auto again = written(report->encoders, report->buttons, report->homed);
      again[14] = payload[14];
      ASSERT_EQ(again, payload);
    } else {
      ++refused;
      ASSERT_NE(payload, clean);
    }
  }
  EXPECT_GT(taken, 100'000u);
  EXPECT_GT(refused, 100'000u);
}

}  // namespace
}  // namespace haptics
