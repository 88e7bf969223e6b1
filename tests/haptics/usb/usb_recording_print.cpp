// Prints a summary of a recording: usb_recording_print FILE.pcap DEVICE, the device's number on its bus.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "tests/haptics/usb/usb_recording.h"

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usb_recording_print FILE.pcap DEVICE\n"), 2;
  std::ifstream stream(argv[1], std::ios::binary);
  const std::vector<std::uint8_t> file{std::istreambuf_iterator<char>(stream), {}};
  const auto transfers = usb_recording::readRecording(file);
  if (!transfers) return std::fprintf(stderr, "%s: not a recording of usbmon, record it again\n", argv[1]), 2;
  const auto device = static_cast<std::uint8_t>(std::atoi(argv[2]));
  for (const auto& [endpoint, traffic] : usb_recording::trafficOf(*transfers, device)) {
    std::printf("endpoint 0x%02x: %zu transfers of %zu to %zu bytes, %.0f /s; bytes that change:", endpoint,
                traffic.transfers, traffic.shortest, traffic.longest, traffic.per_second);
    for (std::size_t at : traffic.changing) std::printf(" %zu", at);
    std::printf("\n");
  }
}
