#include "haptics/device/usb/falcon_start.h"

#include <array>
#include <fstream>
#include <iterator>

#include "haptics/device/haptic_device.h"
#include "haptics/device/usb/falcon_loader.h"
#include "haptics/device/usb/falcon_protocol.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

constexpr std::uintmax_t kMinProgram_bytes = 1024, kMaxProgram_bytes = 64 * 1024;
constexpr std::uint8_t kVendorRequestOut = 0x40;
constexpr auto kRequestTime = 1s, kSendTime = 1s;
/// Of the whole load; the published programs take up to fifty.
constexpr int kMaxLoads = 3;
/// Questions to a unit that may not run its program, each waited for as long.
constexpr int kMaxQuestions = 10;
constexpr auto kAnswerTime = 50ms;

std::string called(const UsbTransport& usb) { return "Falcon on USB " + usb.path() + ", "; }

void refuseIfGone(const UsbTransport& usb, UsbOutcome outcome) {
  if (outcome == UsbOutcome::gone)
    throw DeviceError(called(usb) + "unplugged, plug it in and start again", DeviceTrouble::not_there);
}

bool request(UsbTransport& usb, const FtdiRequest& one) {
  const UsbExchange taken = usb.control({kVendorRequestOut, one.request, one.value, 0}, {}, kRequestTime);
  refuseIfGone(usb, taken.outcome);
  return taken.done();
}

/// What came in within the time; empty when nothing did, or modem bytes alone.
std::span<const std::uint8_t> listen(UsbTransport& usb, std::array<std::uint8_t, 64>& payload,
                                     std::chrono::milliseconds within) {
  std::array<std::uint8_t, 64> transfer{};
  const UsbExchange received = usb.read(transfer, within);
  refuseIfGone(usb, received.outcome);
  if (!received.done()) return {};
  return std::span(payload).first(ftdiPayload(std::span(transfer).first(received.bytes), payload));
}

std::chrono::milliseconds leftUntil(std::int64_t deadline_ns, const UsbTransport& usb) {
  return std::chrono::milliseconds(std::max<std::int64_t>(0, (deadline_ns - usb.clock().now_ns()) / 1'000'000));
}

void listenFor(UsbTransport& usb, FalconLoader& loader) {
  const std::int64_t deadline_ns = usb.clock().now_ns() + loader.timeout_ms() * 1'000'000LL;
  while (loader.next() == FalconLoader::Action::listen) {
    const auto left = leftUntil(deadline_ns, usb);
    if (left == 0ms) return loader.timedOut();
    std::array<std::uint8_t, 64> payload;
    loader.received(listen(usb, payload, left));
  }
}

/// Empty when the program is there, else what went wrong.
std::string load(UsbTransport& usb, FalconLoader& loader, const DevicePrompt& prompt) {
  for (;;) {
    switch (loader.next()) {
      case FalconLoader::Action::request:
        if (!request(usb, loader.request())) return "its USB bridge refuses a request";
        loader.done();
        break;
      case FalconLoader::Action::send: {
        const UsbExchange sent = usb.write(loader.send(), kSendTime);
        refuseIfGone(usb, sent.outcome);
        if (!sent.done()) return "it takes no bytes";
        loader.done();
        if (prompt && !prompt("loading the Falcon's program"))
          throw DeviceError(called(usb) + "its program was not loaded, given up, start again",
                            DeviceTrouble::not_ready);
        break;
      }
      case FalconLoader::Action::listen:
        listenFor(usb, loader);
        break;
      case FalconLoader::Action::done:
        return {};
      case FalconLoader::Action::failed:
        return loader.trouble();
    }
  }
}

}  // namespace

std::vector<std::uint8_t> readFalconProgram(const std::filesystem::path& file) {
  const std::string where = "Falcon's program, " + file.string() + ", ";
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw DeviceError(where + "no such file, give the right path", DeviceTrouble::no_driver);
  if (!std::filesystem::is_regular_file(file, error))
    throw DeviceError(where + "not a file, give the firmware itself", DeviceTrouble::no_driver);
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw DeviceError(where + "its size cannot be read, check the disk", DeviceTrouble::no_driver);
  if (size == 0) throw DeviceError(where + "empty, copy it again", DeviceTrouble::no_driver);
  if (size < kMinProgram_bytes || size > kMaxProgram_bytes || size % 2 != 0)
    throw DeviceError(where + std::to_string(size) +
                      " bytes, a firmware has an even number from 1 to 64 KiB, give the right file");
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> program{std::istreambuf_iterator<char>(stream), {}};
  if (!stream || program.size() != size)
    throw DeviceError(where + "not readable, check its permissions", DeviceTrouble::no_driver);
  return program;
}

bool falconRuns(UsbTransport& usb) {
  for (const FtdiRequest& one : falconRunRequests())
    if (!request(usb, one)) return false;
  FalconStream stream;
  const FalconPacket no_force = encoded({});
  for (int question = 0; question < kMaxQuestions; ++question) {
    const UsbExchange sent = usb.write(no_force, kSendTime);
    refuseIfGone(usb, sent.outcome);
    if (!sent.done()) return false;
    const std::int64_t deadline_ns = usb.clock().now_ns() + toNs(kAnswerTime);
    while (leftUntil(deadline_ns, usb) > 0ms) {
      std::array<std::uint8_t, 64> payload;
      if (stream.take(listen(usb, payload, leftUntil(deadline_ns, usb)))) return true;
    }
  }
  return false;
}

void loadFalcon(UsbTransport& usb, std::span<const std::uint8_t> program, const DevicePrompt& prompt, int greetings) {
  std::string trouble;
  for (int attempt = 0; attempt < kMaxLoads; ++attempt) {
    FalconLoader loader(program, greetings);
    trouble = load(usb, loader, prompt);
    if (trouble.empty() && falconRuns(usb)) return;
    if (trouble.empty()) trouble = "it took the program but does not run it";
  }
  throw DeviceError(called(usb) + "its program did not load: " + trouble +
                        "; check its power supply, pull its plugs, put them back and start again",
                    DeviceTrouble::faulty);
}

}  // namespace haptics
