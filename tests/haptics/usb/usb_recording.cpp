#include "tests/haptics/usb/usb_recording.h"

#include <algorithm>
#include <cstring>

namespace usb_recording {
namespace {

constexpr std::uint32_t kMicroseconds = 0xa1b2c3d4, kNanoseconds = 0xa1b23c4d;
constexpr std::uint32_t kShortHead = 189, kLongHead = 220;
constexpr std::size_t kFileHead = 24, kRecordHead = 16;

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  bool has(std::size_t count) const { return bytes_.size() - at_ >= count; }
  std::span<const std::uint8_t> take(std::size_t count) {
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

std::uint32_t u32(std::span<const std::uint8_t> bytes, std::size_t at, bool big_endian = false) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= static_cast<std::uint32_t>(bytes[at + i]) << (8 * (big_endian ? 3 - i : i));
  return value;
}
std::uint64_t u64(std::span<const std::uint8_t> bytes, std::size_t at) {
  return u32(bytes, at) | static_cast<std::uint64_t>(u32(bytes, at + 4)) << 32;
}

/// One record of usbmon: a transfer submitted (S) or over (C, E).
struct Event {
  std::uint64_t id;
  char kind;
  double t_s;
  Transfer transfer;
};

std::optional<Event> eventIn(std::span<const std::uint8_t> record, std::size_t head) {
  if (record.size() < head) return {};
  Event event{u64(record, 0), static_cast<char>(record[8]), 0.0, {}};
  event.t_s = static_cast<double>(static_cast<std::int64_t>(u64(record, 16))) + 1e-6 * u32(record, 24);
  Transfer& transfer = event.transfer;
  transfer.type = record[9];
  transfer.endpoint = record[10];
  transfer.device = record[11];
  transfer.bus = static_cast<std::uint16_t>(record[12] | record[13] << 8);
  transfer.status = static_cast<int>(u32(record, 28));
  const std::size_t captured = std::min<std::size_t>(u32(record, 36), record.size() - head);
  const auto data = record.subspan(head, captured);
  transfer.bytes.assign(data.begin(), data.end());
  return event;
}

}  // namespace

std::optional<std::vector<Transfer>> readRecording(std::span<const std::uint8_t> file) {
  if (file.size() < kFileHead) return {};
  const auto magic_is = [&](bool big) {
    return u32(file, 0, big) == kMicroseconds || u32(file, 0, big) == kNanoseconds;
  };
  const bool big_endian = magic_is(true);
  if (!big_endian && !magic_is(false)) return {};
  const std::uint32_t link = u32(file, 20, big_endian);
  if (link != kShortHead && link != kLongHead) return {};

  std::vector<Transfer> transfers;
  std::map<std::uint64_t, std::vector<std::uint8_t>> on_their_way;
  std::optional<double> began_s;
  Reader reader(file.subspan(kFileHead));
  while (reader.has(kRecordHead)) {
    const std::size_t size = u32(reader.take(kRecordHead), 8, big_endian);
    if (!reader.has(size)) break;
    auto event = eventIn(reader.take(size), link == kLongHead ? 64 : 48);
    if (!event) continue;
    if (event->kind == 'S') {
      on_their_way[event->id] = std::move(event->transfer.bytes);
      continue;
    }
    Transfer& transfer = event->transfer;
    const auto sent = on_their_way.extract(event->id);
    if ((transfer.endpoint & 0x80) == 0 && sent) transfer.bytes = sent.mapped();
    if (!began_s) began_s = event->t_s;
    transfer.t_s = event->t_s - *began_s;
    transfers.push_back(std::move(transfer));
  }
  return transfers;
}

std::map<std::uint8_t, Traffic> trafficOf(const std::vector<Transfer>& transfers, std::uint8_t device) {
  std::map<std::uint8_t, std::vector<const Transfer*>> by_endpoint;
  for (const Transfer& transfer : transfers)
    if (transfer.device == device && transfer.status == 0 && !transfer.bytes.empty())
      by_endpoint[transfer.endpoint].push_back(&transfer);
  std::map<std::uint8_t, Traffic> all;
  for (const auto& [endpoint, seen] : by_endpoint) {
    Traffic& traffic = all[endpoint];
    traffic.transfers = seen.size();
    traffic.shortest = SIZE_MAX;
    for (const Transfer* transfer : seen) {
      traffic.shortest = std::min(traffic.shortest, transfer->bytes.size());
      traffic.longest = std::max(traffic.longest, transfer->bytes.size());
    }
    for (std::size_t at = 0; at < traffic.shortest; ++at)
      if (std::ranges::any_of(seen, [&](const Transfer* t) { return t->bytes[at] != seen.front()->bytes[at]; }))
        traffic.changing.push_back(at);
    const double lasted_s = seen.back()->t_s - seen.front()->t_s;
    if (lasted_s > 0.0) traffic.per_second = static_cast<double>(seen.size() - 1) / lasted_s;
  }
  return all;
}

}  // namespace usb_recording
