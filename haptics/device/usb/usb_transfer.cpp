#include "haptics/device/usb/usb_transfer.h"

#include <libusb-1.0/libusb.h>

#include <algorithm>
#include <utility>

#include "haptics/device/haptic_device.h"
#include "haptics/device/usb/usb_link.h"

namespace haptics {
namespace {

void LIBUSB_CALL callBack(libusb_transfer* transfer) { static_cast<UsbTransfer*>(transfer->user_data)->onDone(); }
void LIBUSB_CALL ignore(libusb_transfer*) {}

UsbOutcome outcomeOf(int status) {
  switch (status) {
    case LIBUSB_TRANSFER_COMPLETED:
      return UsbOutcome::done;
    case LIBUSB_TRANSFER_CANCELLED:
    case LIBUSB_TRANSFER_TIMED_OUT:
      return UsbOutcome::late;
    case LIBUSB_TRANSFER_STALL:
      return UsbOutcome::stalled;
    case LIBUSB_TRANSFER_NO_DEVICE:
      return UsbOutcome::gone;
    default:
      return UsbOutcome::failed;
  }
}

}  // namespace

UsbTransfer::UsbTransfer(UsbLink& link, const UsbPipe& pipe, std::size_t capacity)
    : link_(link), transfer_(libusb_alloc_transfer(0)), buffer_(capacity) {
  if (!transfer_)
    throw DeviceError("USB " + link.path() + ": no memory for a transfer, close other programs",
                      DeviceTrouble::no_resources);
  transfer_->dev_handle = link.handle();
  transfer_->endpoint = pipe.endpoint;
  transfer_->type = pipe.transfer_type;
  transfer_->buffer = buffer_.data();
  transfer_->callback = callBack;
  transfer_->user_data = this;
}

UsbTransfer::~UsbTransfer() {
  if (!in_flight_) {
    libusb_free_transfer(transfer_);
    return;
  }
  transfer_->callback = ignore;
  link_.abandon(transfer_, std::move(buffer_));
}

bool UsbTransfer::submit(std::size_t size, std::int64_t deadline_ns) noexcept {
  transfer_->length = static_cast<int>(std::min(size, buffer_.size()));
  deadline_ns_ = deadline_ns;
  cancelled_at_ns_ = kNever;
  moved_ = 0;
  overflowed_ = finished_ = false;
  const int error = libusb_submit_transfer(transfer_);
  in_flight_ = error == 0;
  if (in_flight_) return true;
  finished_ = true;
  order_ = link_.numberDone();
  outcome_ = error == LIBUSB_ERROR_NO_DEVICE ? UsbOutcome::gone
             : error == LIBUSB_ERROR_PIPE    ? UsbOutcome::stalled
                                             : UsbOutcome::failed;
  return false;
}

void UsbTransfer::cancel() noexcept {
  if (!in_flight_ || cancelled_at_ns_ != kNever) return;
  cancelled_at_ns_ = link_.clock().now_ns();
  libusb_cancel_transfer(transfer_);
}

void UsbTransfer::expire(std::int64_t now_ns) noexcept {
  if (in_flight_ && now_ns >= deadline_ns_) cancel();
}

void UsbTransfer::onDone() noexcept {
  in_flight_ = false;
  finished_ = true;
  order_ = link_.numberDone();
  overflowed_ = transfer_->status == LIBUSB_TRANSFER_OVERFLOW;
  outcome_ = outcomeOf(transfer_->status);
  const std::size_t skipped = transfer_->type == LIBUSB_TRANSFER_TYPE_CONTROL ? LIBUSB_CONTROL_SETUP_SIZE : 0;
  moved_ = std::min(static_cast<std::size_t>(std::max(0, transfer_->actual_length)) + skipped, buffer_.size());
}

}  // namespace haptics
