#include "haptics/device/usb/falcon_program.h"

#include <fstream>
#include <iterator>
#include <string>

#include "haptics/device/haptic_device.h"

namespace haptics {
namespace {

constexpr std::uintmax_t kLeastBytes = 1024, kMaxBytes = 64 * 1024;

}  // namespace

std::vector<std::uint8_t> readFalconProgram(const std::filesystem::path& file) {
  const std::string where = "Falcon's program, " + file.string() + ", ";
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw DeviceError(where + "no such file, give the right path", DeviceTrouble::no_driver);
  if (!std::filesystem::is_regular_file(file, error))
    throw DeviceError(where + "not a file, give the firmware itself", DeviceTrouble::no_driver);
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw DeviceError(where + "its size can not be read, check the disk", DeviceTrouble::no_driver);
  if (size == 0) throw DeviceError(where + "empty, copy it again", DeviceTrouble::no_driver);
  if (size < kLeastBytes || size > kMaxBytes || size % 2 != 0)
    throw DeviceError(where + std::to_string(size) +
                      " bytes, a firmware has an even number from 1 to 64 KiB, give the right file");
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> program{std::istreambuf_iterator<char>(stream), {}};
  if (!stream || program.size() != size)
    throw DeviceError(where + "not readable, check its permissions", DeviceTrouble::no_driver);
  return program;
}

}  // namespace haptics
