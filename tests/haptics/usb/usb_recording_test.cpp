#include "tests/haptics/usb/usb_recording.h"

#include <gtest/gtest.h>

#include "haptics/device/usb/falcon_protocol.h"
#include "tests/mutants.h"

namespace usb_recording {
namespace {

using Bytes = std::vector<std::uint8_t>;

void push(Bytes& bytes, std::uint64_t value, std::size_t count, bool big_endian = false) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t byte = big_endian ? count - 1 - i : i;
    bytes.push_back(byte < sizeof value ? static_cast<std::uint8_t>(value >> (8 * byte)) : std::uint8_t{0});
  }
}

/// Writes as usbmon and tcpdump do.
class Recorder {
 public:
  explicit Recorder(std::uint32_t link = 220, bool big_endian = false) : link_(link), big_endian_(big_endian) {
    push(file, 0xa1b2c3d4, 4, big_endian);
    push(file, 2, 2, big_endian);
    push(file, 4, 2, big_endian);
    push(file, 0, 8, big_endian);
    push(file, 65535, 4, big_endian);
    push(file, link, 4, big_endian);
  }
  void transfer(std::uint8_t endpoint, double t_s, const Bytes& bytes, int status = 0, std::uint8_t device = 5) {
    const bool in = (endpoint & 0x80) != 0;
    record('S', endpoint, t_s, in ? Bytes{} : bytes, -115, device);
    record('C', endpoint, t_s + 2e-4, in ? bytes : Bytes{}, status, device);
    ++id_;
  }
  Bytes file;

 private:
  void record(char kind, std::uint8_t endpoint, double t_s, const Bytes& data, int status, std::uint8_t device) {
    Bytes r;
    push(r, id_, 8);
    r.insert(r.end(), {static_cast<std::uint8_t>(kind), 3, endpoint, device, 1, 0, '-', '-'});
    push(r, static_cast<std::uint64_t>(t_s), 8);
    push(r, static_cast<std::uint64_t>((t_s - static_cast<double>(static_cast<std::uint64_t>(t_s))) * 1e6), 4);
    push(r, static_cast<std::uint32_t>(status), 4);
    push(r, data.size(), 4);
    push(r, data.size(), 4);
    push(r, 0, 8);
    if (link_ == 220) push(r, 0, 16);
    r.insert(r.end(), data.begin(), data.end());
    push(file, 0, 8, big_endian_);
    push(file, r.size(), 4, big_endian_);
    push(file, r.size(), 4, big_endian_);
    file.insert(file.end(), r.begin(), r.end());
  }
  std::uint32_t link_;
  bool big_endian_;
  std::uint64_t id_ = 1;
};

TEST(UsbRecording, ListsWhatWentOutAndWhatCameIn) {
  for (const std::uint32_t link : {189u, 220u})
    for (const bool big_endian : {false, true}) {
      Recorder recorder(link, big_endian);
      recorder.transfer(0x02, 100.0, {1, 2, 3});
      recorder.transfer(0x81, 100.001, {9, 8});
      recorder.transfer(0x81, 100.002, {}, -32);
      const auto read = readRecording(recorder.file);
      ASSERT_TRUE(read);
      ASSERT_EQ(read->size(), 3u);
      EXPECT_EQ((*read)[0].endpoint, 0x02);
      EXPECT_EQ((*read)[0].bytes, (Bytes{1, 2, 3}));
      EXPECT_EQ((*read)[0].bus, 1);
      EXPECT_EQ((*read)[1].bytes, (Bytes{9, 8}));
      EXPECT_NEAR((*read)[1].t_s, 1e-3, 2e-6);
      EXPECT_EQ((*read)[2].status, -32);
    }
}

TEST(UsbRecording, ShowsTheIntervalOfAnEndpointAndWhichOfItsBytesChange) {
  Recorder recorder;
  for (int i = 0; i < 101; ++i) {
    recorder.transfer(0x81, 10.0 + 1e-3 * i, {7, static_cast<std::uint8_t>(i), 7, static_cast<std::uint8_t>(i / 50)});
    recorder.transfer(0x81, 10.0 + 1e-3 * i, {static_cast<std::uint8_t>(i), 0}, 0, 6);  // another device
  }
  recorder.transfer(0x02, 10.2, {1});
  const auto traffic = trafficOf(*readRecording(recorder.file), 5);
  ASSERT_EQ(traffic.size(), 2u);
  EXPECT_EQ(traffic.at(0x81).transfers, 101u);
  EXPECT_EQ(traffic.at(0x81).shortest, 4u);
  EXPECT_EQ(traffic.at(0x81).longest, 4u);
  EXPECT_NEAR(traffic.at(0x81).per_second, 1000.0, 1.0);
  EXPECT_EQ(traffic.at(0x81).changing, (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(traffic.at(0x02).transfers, 1u);
}

TEST(UsbRecording, AFalconsTrafficIsReadByItsDriversOwnDecoder) {
  Recorder recorder;
  for (int i = 0; i < 50; ++i) {
    const auto packet = haptics::encoded({{i, -i, 2 * i}, true, haptics::FalconLights::none});
    recorder.transfer(0x02, 5.0 + 1e-3 * i, {packet.begin(), packet.end()});
    Bytes answer{0x01, 0x60};
    answer.insert(answer.end(), packet.begin(), packet.end());
    recorder.transfer(0x81, 5.0005 + 1e-3 * i, answer);
  }
  haptics::FalconStream line;
  int answers = 0;
  const auto read = readRecording(recorder.file);
  ASSERT_TRUE(read);
  for (const Transfer& transfer : *read) {
    if (transfer.endpoint != 0x81) continue;
    Bytes payload(transfer.bytes.size());
    payload.resize(haptics::ftdiPayload(transfer.bytes, payload));
    const auto packet = line.take(payload);
    ASSERT_TRUE(packet);
    EXPECT_EQ(haptics::decodeFalconReport(*packet)->encoders[0], answers++);
  }
  EXPECT_EQ(answers, 50);
}

TEST(UsbRecording, AnyFileIsReadOrRefused) {
  Recorder recorder;
  for (int i = 0; i < 20; ++i) recorder.transfer(i % 2 == 0 ? 0x02 : 0x81, 1.0 + 1e-3 * i, Bytes(16, 7));
  EXPECT_FALSE(readRecording({}));
  EXPECT_FALSE(readRecording(Bytes(1000, 0)));
  for (std::size_t size = 24; size < recorder.file.size(); ++size)
    EXPECT_LE(readRecording(std::span(recorder.file).first(size))->size(), 20u);
  const std::string good(recorder.file.begin(), recorder.file.end());
  mutants::forEachMutant({good}, 20'000, [&](const std::string& bad, std::size_t, std::uint64_t) {
    if (const auto read = readRecording(Bytes(bad.begin(), bad.end()))) trafficOf(*read, 5);
  });
}

}  // namespace
}  // namespace usb_recording
