#include "app/session/input_feed.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <string>
#include <string_view>

#include "app/session/command_keys.h"
#include "app/session/session_error.h"
#include "app/text/parse_number.h"

namespace app {
namespace {

/// In the byte order of the machine: both sides run on it.
struct Head {
  std::uint32_t mark = 0, stored = 0;  ///< bytes that follow, compressed
  std::uint32_t plain = 0;             ///< bytes: text of the commands, packed ticks, their digests
  std::uint32_t text = 0, ticks = 0;
};
constexpr std::uint32_t kMark = 0x4446'4d4d, kMostPlain = 256U << 20, kMostStored = 256U << 20;

SessionError broken() {
  return SessionError("what the second servo is fed with is damaged: it is started again", SessionErrorKind::damaged);
}

void put(std::vector<std::uint8_t>& out, const void* from, std::size_t bytes) {
  const auto* const first = static_cast<const std::uint8_t*>(from);
  out.insert(out.end(), first, first + bytes);
}

/// False: the end of what is there.
bool readAt(int memory, std::uint64_t at, void* to, std::size_t bytes) {
  auto* out = static_cast<std::uint8_t*>(to);
  while (bytes > 0) {
    const ssize_t got = ::pread(memory, out, bytes, static_cast<off_t>(at));
    if (got <= 0) return false;
    out += got, at += static_cast<std::uint64_t>(got), bytes -= static_cast<std::size_t>(got);
  }
  return true;
}

/// Lines of a first tick, a space and the command.
std::vector<SessionCommand> commandsFrom(std::string_view text) {
  std::vector<SessionCommand> commands;
  while (!text.empty()) {
    const std::size_t end = text.find('\n'), space = text.find(' ');
    if (end == std::string_view::npos || space > end) throw broken();
    const auto first = parseNumber<std::uint64_t>(text.substr(0, space));
    if (!first) throw broken();
    commands.push_back({commandFromText(text.substr(space + 1, end - space - 1)), *first});
    text.remove_prefix(end + 1);
  }
  return commands;
}

}  // namespace

InputFeed::InputFeed() : memory_(::memfd_create("molar inputs", MFD_CLOEXEC)) {
  if (memory_ < 0) throw SessionError("shared memory: there is none for a second servo, close other programs");
}

InputFeed::~InputFeed() { ::close(memory_); }

void InputFeed::take(std::span<const SessionCommand> commands, std::span<const haptics::Tick> ticks) noexcept {
  if (has_ended_) return;
  try {
    std::string text;
    for (const SessionCommand& one : commands)
      text += std::to_string(one.first_tick) + ' ' + commandText(one.command) + '\n';
    std::vector<haptics::Tick> inputs;
    inputs.reserve(ticks.size());
    for (const haptics::Tick& tick : ticks) {
      haptics::Tick& input = inputs.emplace_back();
      input.index = tick.index, input.dt_s = tick.dt_s, input.command_serial = tick.command_serial;
      input.hand = tick.hand;
    }
    plain_.clear(), record_.clear();
    put(plain_, text.data(), text.size());
    const std::vector<std::uint8_t> packed = packTicks(inputs);
    put(plain_, packed.data(), packed.size());
    for (const haptics::Tick& tick : ticks) {
      const std::uint64_t digest = digestOf(tick);
      put(plain_, &digest, sizeof digest);
    }
    const std::vector<std::uint8_t> stored = compressor_.compress(plain_);
    const Head head{kMark, static_cast<std::uint32_t>(stored.size()), static_cast<std::uint32_t>(plain_.size()),
                    static_cast<std::uint32_t>(text.size()), static_cast<std::uint32_t>(ticks.size())};
    put(record_, &head, sizeof head);
    put(record_, stored.data(), stored.size());
    if (!ticks.empty()) ticks_.store(ticks.back().index + 1, std::memory_order_release);
    // Half a record is not read: it counts once it is whole.
    std::uint64_t at = bytes_;
    for (std::size_t done = 0; done < record_.size();) {
      const ssize_t wrote = ::pwrite(memory_, record_.data() + done, record_.size() - done, static_cast<off_t>(at));
      if (wrote <= 0) throw std::bad_alloc();
      done += static_cast<std::size_t>(wrote), at += static_cast<std::uint64_t>(wrote);
    }
    bytes_ = at;
  } catch (const std::exception&) {
    has_ended_ = true;
  }
}

std::optional<FedBatch> InputFeedReader::next() {
  Head head;
  if (!readAt(memory_, at_, &head, sizeof head)) return {};
  static const TickUnpacker kUnpacker(tickColumns());
  const std::uint64_t expected =
      head.text + static_cast<std::uint64_t>(head.ticks) * (kUnpacker.bytesPerTick() + sizeof(std::uint64_t));
  if (head.mark != kMark || head.stored > kMostStored || head.plain > kMostPlain || head.plain != expected)
    throw broken();
  std::vector<std::uint8_t> stored(head.stored);
  if (!readAt(memory_, at_ + sizeof head, stored.data(), stored.size())) return {};
  const std::vector<std::uint8_t> plain = decompress(stored, head.plain);
  at_ += sizeof head + stored.size();

  FedBatch batch;
  batch.commands = commandsFrom({reinterpret_cast<const char*>(plain.data()), head.text});
  const std::size_t packed = head.ticks * kUnpacker.bytesPerTick();
  const std::vector<haptics::Tick> inputs = kUnpacker.unpack(std::span(plain).subspan(head.text, packed));
  batch.ticks.reserve(inputs.size());
  for (std::size_t n = 0; n < inputs.size(); ++n) {
    FedTick& tick = batch.ticks.emplace_back();
    tick.input = inputs[n];
    std::memcpy(&tick.digest, plain.data() + head.text + packed + n * sizeof tick.digest, sizeof tick.digest);
  }
  return batch;
}

}  // namespace app
