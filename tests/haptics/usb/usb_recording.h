// A recording of USB traffic, as usbmon gives it to tcpdump or Wireshark: pcap files of link type 220 (64-byte header)
// or 189 (48-byte header), in either byte order of the file, with little-endian headers. Lists the transfers of a
// device whose protocol is not known. Source: Linux, Documentation/usb/usbmon.rst; tcpdump.org, link types.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace usb_recording {

struct Transfer {
  double t_s = 0.0;  ///< of its completion, from the first one
  std::uint16_t bus = 0;
  std::uint8_t device = 0;
  std::uint8_t endpoint = 0;        ///< bit 7: in
  std::uint8_t type = 0;            ///< 0 isochronous, 1 interrupt, 2 control, 3 bulk
  int status = 0;                   ///< 0, or a negative errno
  std::vector<std::uint8_t> bytes;  ///< as far as they were captured
};

/// Every completed transfer, with outgoing data from its submission. None for another file; a truncated one gives its
/// complete records.
std::optional<std::vector<Transfer>> readRecording(std::span<const std::uint8_t> file);

/// Summary of an endpoint: count, length, interval.
struct Traffic {
  std::size_t transfers = 0, shortest = 0, longest = 0;
  double per_second = 0.0;
  std::vector<std::size_t> changing;  ///< bytes that differ between transfers
};
std::map<std::uint8_t, Traffic> trafficOf(const std::vector<Transfer>& transfers, std::uint8_t device);

}  // namespace usb_recording
