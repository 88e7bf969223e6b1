// A recording of what went over a USB, as usbmon gives it to tcpdump or Wireshark: pcap files of link type 220 (64-byte
// head) or 189 (48-byte head), of either byte order of the file, little-endian heads. For those who record a device
// nobody has described: lists its transfers; knows no device's protocol and guesses none. Source: Linux,
// Documentation/usb/usbmon.rst; tcpdump.org, link types.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace usb_recording {

struct Transfer {
  double t_s = 0.0;  ///< when it was over, from the first one on
  std::uint16_t bus = 0;
  std::uint8_t device = 0;
  std::uint8_t endpoint = 0;        ///< bit 7: in
  std::uint8_t type = 0;            ///< 0 isochronous, 1 interrupt, 2 control, 3 bulk
  int status = 0;                   ///< 0, or a negative errno
  std::vector<std::uint8_t> bytes;  ///< as far as they were captured
};

/// Every finished transfer, what went out taken from its beginning. None when it is no such file; a truncated one gives
/// what is whole.
std::optional<std::vector<Transfer>> readRecording(std::span<const std::uint8_t> file);

/// For a first look at one device: of an endpoint, how many, how long, how often.
struct Traffic {
  std::size_t transfers = 0, shortest = 0, longest = 0;
  double per_second = 0.0;
  std::vector<std::size_t> changing;  ///< the bytes that were not the same in all
};
std::map<std::uint8_t, Traffic> trafficOf(const std::vector<Transfer>& transfers, std::uint8_t device);

}  // namespace usb_recording
