#include "haptics/device/usb/falcon_start.h"

#include <array>

#include "haptics/device/haptic_device.h"
#include "haptics/device/usb/falcon_loader.h"
#include "haptics/device/usb/falcon_protocol.h"
#include "haptics/device/usb/usb_transport.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

constexpr std::uint8_t kVendorRequestOut = 0x40;
constexpr auto kRequestTime = 1s, kSendTime = 1s;
/// Of the whole load; the published programs take up to fifty.
constexpr int kMostLoads = 3;
/// Questions to a unit that may not run its program, each heard out for so long.
constexpr int kMostQuestions = 10;
constexpr auto kAnswerTime = 50ms;

std::string called(const UsbTransport& usb) { return "Falcon on USB " + usb.path() + ", "; }

void refuseIfGone(const UsbTransport& usb, UsbOutcome outcome) {
  if (outcome == UsbOutcome::gone)
    throw DeviceError(called(usb) + "unplugged, plug it in and start again", DeviceTrouble::not_there);
}

bool ask(UsbTransport& usb, const FtdiRequest& request) {
  const UsbExchange taken = usb.control({kVendorRequestOut, request.request, request.value, 0}, {}, kRequestTime);
  refuseIfGone(usb, taken.outcome);
  return taken.done();
}

/// What came in within the time; empty when nothing did, or modem bytes alone.
std::span<const std::uint8_t> listen(UsbTransport& usb, std::array<std::uint8_t, 64>& payload,
                                     std::chrono::milliseconds within) {
  std::array<std::uint8_t, 64> transfer{};
  const UsbExchange heard = usb.read(transfer, within);
  refuseIfGone(usb, heard.outcome);
  if (!heard.done()) return {};
  return std::span(payload).first(ftdiPayload(std::span(transfer).first(heard.bytes), payload));
}

std::chrono::milliseconds leftUntil(std::int64_t deadline_ns, const UsbTransport& usb) {
  return std::chrono::milliseconds(std::max<std::int64_t>(0, (deadline_ns - usb.clock().now_ns()) / 1'000'000));
}

void listenFor(UsbTransport& usb, FalconLoader& loader) {
  const std::int64_t deadline_ns = usb.clock().now_ns() + loader.patience_ms() * 1'000'000LL;
  while (loader.ask() == FalconLoader::Ask::listen) {
    const auto left = leftUntil(deadline_ns, usb);
    if (left == 0ms) return loader.silence();
    std::array<std::uint8_t, 64> payload;
    loader.heard(listen(usb, payload, left));
  }
}

/// Empty when the program is there, else what went wrong.
std::string converse(UsbTransport& usb, FalconLoader& loader, const FalconProgress& tell) {
  for (;;) {
    switch (loader.ask()) {
      case FalconLoader::Ask::request:
        if (!ask(usb, loader.request())) return "its USB bridge refuses a request";
        loader.done();
        break;
      case FalconLoader::Ask::send: {
        const UsbExchange sent = usb.write(loader.send(), kSendTime);
        refuseIfGone(usb, sent.outcome);
        if (!sent.done()) return "it takes no bytes";
        loader.done();
        if (tell && !tell("loading the Falcon's program", loader.share()))
          throw DeviceError(called(usb) + "its program was not loaded, given up, start again",
                            DeviceTrouble::not_ready);
        break;
      }
      case FalconLoader::Ask::listen:
        listenFor(usb, loader);
        break;
      case FalconLoader::Ask::done:
        return {};
      case FalconLoader::Ask::failed:
        return loader.trouble();
    }
  }
}

}  // namespace

bool falconRuns(UsbTransport& usb) {
  for (const FtdiRequest& request : falconRunRequests())
    if (!ask(usb, request)) return false;
  FalconStream stream;
  const FalconPacket no_force = encoded({});
  for (int question = 0; question < kMostQuestions; ++question) {
    const UsbExchange sent = usb.write(no_force, kSendTime);
    refuseIfGone(usb, sent.outcome);
    if (!sent.done()) return false;
    const std::int64_t deadline_ns = usb.clock().now_ns() + std::chrono::nanoseconds(kAnswerTime).count();
    while (leftUntil(deadline_ns, usb) > 0ms) {
      std::array<std::uint8_t, 64> payload;
      if (stream.take(listen(usb, payload, leftUntil(deadline_ns, usb)))) return true;
    }
  }
  return false;
}

void loadFalcon(UsbTransport& usb, std::span<const std::uint8_t> program, const FalconProgress& tell, int greetings) {
  std::string trouble;
  for (int attempt = 0; attempt < kMostLoads; ++attempt) {
    FalconLoader loader(program, greetings);
    trouble = converse(usb, loader, tell);
    if (trouble.empty() && falconRuns(usb)) return;
    if (trouble.empty()) trouble = "it took the program but does not run it";
  }
  throw DeviceError(called(usb) + "its program did not load: " + trouble +
                        "; check its power supply, pull its plugs, put them back and start again",
                    DeviceTrouble::faulty);
}

}  // namespace haptics
