#include "haptics/device/usb/wooden_protocol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "haptics/device/usb/wooden_kinematics.h"

namespace haptics {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(WoodenProtocol, ReadsSixEncodersAndTheSwitch) {
  const Bytes bytes{1, 0, 0xff, 0xff, 0x70, 0x17, 0x88, 0x13, 0, 0x80, 0xff, 0x7f, 1, 0};
  const auto reading = decodeWoodenReading(bytes);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->encoders, (std::array<std::int16_t, 6>{1, -1, 6000, 5000, -32768, 32767}));
  EXPECT_FALSE(reading->button);
  EXPECT_TRUE(reading->switch_pressed);
}

TEST(WoodenProtocol, TakesTheButtonOffEncoderD) {
  Bytes bytes(14, 0);
  bytes[6] = 0x10 - 7;  // 10000 - 7
  bytes[7] = 0x27;
  const auto reading = decodeWoodenReading(bytes);
  ASSERT_TRUE(reading);
  EXPECT_TRUE(reading->button);
  EXPECT_EQ(reading->encoders[3], -7);
}

TEST(WoodenProtocol, ReadsNothingOfTheWrongLength) {
  for (std::size_t size = 0; size <= 64; ++size)
    EXPECT_EQ(decodeWoodenReading(Bytes(size, 0x55)).has_value(), size == 14) << size;
}

TEST(WoodenProtocol, WritesCurrentsAndNothingElse) {
  const UsbReport report = encodeWoodenCurrents({1.4, -2000.0, 300.6});
  const Bytes expected{1, 0, 0x30, 0xf8, 0x2d, 0x01, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(Bytes(report.content().begin(), report.content().end()), expected);
  const UsbReport rest = woodenRest();
  EXPECT_EQ(Bytes(rest.content().begin(), rest.content().end()), Bytes(14, 0));
}

TEST(WoodenProtocol, WritesNoCurrentThatIsNotANumber) {
  const double inf = std::numeric_limits<double>::infinity();
  const UsbReport report = encodeWoodenCurrents({std::nan(""), inf, 1e9});
  const Bytes expected{0, 0, 0, 0, 0xff, 0x7f, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(Bytes(report.content().begin(), report.content().end()), expected);
}

TEST(WoodenProtocol, PresetsThreeByAttributesAndThreeInPlaceOfTheCurrents) {
  const UsbReport report = encodeWoodenPreset({1, 2, 6000, 4, 5, -6});
  const Bytes expected{4, 0, 5, 0, 0xfa, 0xff, 1, 0, 1, 0, 2, 0, 0x70, 0x17};
  EXPECT_EQ(Bytes(report.content().begin(), report.content().end()), expected);
}

/// Whatever comes over the wire: 14 bytes make a finite pose and currents within the clamp, anything else nothing.
TEST(WoodenProtocol, AnyBytesAreHarmless) {
  const WoodenKinematics wooden(woodenHaptics2015());
  std::mt19937_64 generator(11);
  Bytes live{0x10, 0, 0x20, 1, 0x70, 0x17, 0, 0, 0, 0, 0, 0, 0, 0};
  std::size_t readings = 0;
  for (int i = 0; i < 1'200'000; ++i) {
    Bytes bytes = live;
    const std::uint64_t dice = generator();
    if (i % 2 == 0) {
      for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(generator());
    } else {
      bytes[dice % 14] ^= static_cast<std::uint8_t>(dice >> 8);
      if (dice >> 61 == 0) bytes.resize(dice >> 16 & 31);
    }
    const auto reading = decodeWoodenReading(bytes);
    ASSERT_EQ(reading.has_value(), bytes.size() == 14);
    if (!reading) continue;
    ++readings;
    if (i % 16 != 0) continue;
    const WoodenJoints joints = wooden.joints(reading->encoders);
    ASSERT_TRUE(std::isfinite(glm::length(wooden.handle(joints).translation_mm)));
    for (double mA : wooden.currents_mA(joints.arm_rad, {{5.0, -5.0, 5.0}})) ASSERT_LE(std::abs(mA), 2000.1);
  }
  EXPECT_GT(readings, 1'000'000u);
}

}  // namespace
}  // namespace haptics
