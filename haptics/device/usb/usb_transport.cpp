#include "haptics/device/usb/usb_transport.h"

#include <libusb-1.0/libusb.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>

#include "haptics/device/haptic_device.h"
#include "haptics/device/usb/usb_link.h"
#include "haptics/device/usb/usb_pump.h"
#include "haptics/device/usb/usb_transfer.h"

namespace haptics {
namespace {

/// Before the stream: a cancelled transfer not completed for so long means a dead handle.
constexpr std::int64_t kDead_ns = 1'000'000'000;

}  // namespace

UsbExchange UsbTransport::exchange(UsbTransfer& transfer, std::size_t size, std::chrono::milliseconds within) {
  assert(!pump_);
  if (is_dead_) return {UsbOutcome::gone, 0};
  const std::int64_t deadline_ns = link_->clock().now_ns() + toNs(within);
  transfer.submit(size, deadline_ns);
  while (transfer.inFlight()) {
    transfer.expire(link_->clock().now_ns());
    const std::int64_t next_ns = std::min(transfer.deadline_ns(), link_->clock().now_ns() + 10'000'000);
    is_dead_ |= !link_->pump(next_ns, -1) || transfer.isDead(link_->clock().now_ns(), kDead_ns);
    if (is_dead_) return {UsbOutcome::gone, 0};
  }
  is_dead_ |= transfer.outcome() == UsbOutcome::gone;
  return {transfer.outcome(), transfer.moved().size()};
}

UsbTransport::UsbTransport(const UsbAddress& address, UsbClock clock)
    : link_(std::make_unique<UsbLink>(address, clock)) {}
UsbTransport::~UsbTransport() { stop(); }

std::size_t UsbTransport::inPacketBytes() const { return link_->in().packet_bytes; }
std::size_t UsbTransport::outPacketBytes() const { return link_->out().packet_bytes; }
const std::string& UsbTransport::path() const { return link_->path(); }
UsbClock UsbTransport::clock() const { return link_->clock(); }
const std::string& UsbTransport::serialNumber() const { return link_->serialNumber(); }

UsbExchange UsbTransport::control(const UsbSetup& setup, std::span<std::uint8_t> data,
                                  std::chrono::milliseconds within) {
  const UsbPipe pipe{0, LIBUSB_TRANSFER_TYPE_CONTROL, LIBUSB_CONTROL_SETUP_SIZE};
  UsbTransfer transfer(*link_, pipe, LIBUSB_CONTROL_SETUP_SIZE + data.size());
  const auto low = [](std::size_t word) { return static_cast<std::uint8_t>(word & 0xff); };
  const auto high = [](std::size_t word) { return static_cast<std::uint8_t>(word >> 8 & 0xff); };
  const std::array<std::uint8_t, LIBUSB_CONTROL_SETUP_SIZE> head{setup.type,        setup.request,    low(setup.value),
                                                                 high(setup.value), low(setup.index), high(setup.index),
                                                                 low(data.size()),  high(data.size())};
  std::copy(head.begin(), head.end(), transfer.buffer().begin());
  const bool comes_in = (setup.type & LIBUSB_ENDPOINT_IN) != 0;
  if (!comes_in) std::copy(data.begin(), data.end(), transfer.buffer().begin() + head.size());
  UsbExchange result = exchange(transfer, transfer.buffer().size(), within);
  result.bytes -= std::min(result.bytes, head.size());
  if (comes_in) std::copy_n(transfer.buffer().begin() + head.size(), std::min(result.bytes, data.size()), data.begin());
  return result;
}

UsbExchange UsbTransport::write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds within) {
  UsbTransfer transfer(*link_, link_->out(), std::max<std::size_t>(1, bytes.size()));
  std::copy(bytes.begin(), bytes.end(), transfer.buffer().begin());
  return exchange(transfer, bytes.size(), within);
}

UsbExchange UsbTransport::read(std::span<std::uint8_t> bytes, std::chrono::milliseconds within) {
  UsbTransfer transfer(*link_, link_->in(), inPacketBytes());
  UsbExchange result = exchange(transfer, inPacketBytes(), within);
  result.bytes = std::min(result.bytes, bytes.size());
  std::copy_n(transfer.buffer().begin(), result.bytes, bytes.begin());
  return result;
}

void UsbTransport::run(const UsbStream& stream) {
  assert(!pump_);
  pump_ = std::make_unique<UsbPump>(*link_, stream);
  running_.store(pump_.get());
}

const UsbReport& UsbTransport::newestReport() noexcept { return pump_->newestReport(); }
bool UsbTransport::awaitReport(std::int64_t deadline_ns) noexcept { return pump_->awaitReport(deadline_ns); }
void UsbTransport::send(const UsbReport& report, std::uint32_t rests) noexcept { pump_->send(report, rests); }

std::uint32_t UsbTransport::rests() const noexcept {
  const UsbPump* pump = running_.load();
  return pump ? pump->rests() : 0;
}

void UsbTransport::rest() noexcept {
  if (UsbPump* pump = running_.load()) pump->rest();
}

bool UsbTransport::sendLast(const UsbReport& report, std::chrono::milliseconds within) noexcept {
  UsbPump* pump = running_.load();
  return pump && pump->sendLast(report, within);
}

UsbState UsbTransport::state() const noexcept {
  const UsbPump* pump = running_.load();
  return pump ? pump->state() : UsbState::late;
}

UsbCounters UsbTransport::counters() const noexcept {
  const UsbPump* pump = running_.load();
  return pump ? pump->counters() : UsbCounters{};
}

void UsbTransport::stop() noexcept {
  if (UsbPump* pump = running_.load()) pump->stop();
}

}  // namespace haptics
