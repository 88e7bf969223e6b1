#include "calibration/webcam/webcam_source.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include "calibration/opencv_module.h"
#include "calibration/webcam/live_image_source.h"

namespace calibration {
namespace {

constexpr unsigned kVideoDevices = 81;  // major number, Linux devices.txt

bool isIndex(const std::string& text) {
  return !text.empty() && text.size() <= 3 &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c); });
}
bool isWebcam(const std::string& text) { return isIndex(text) || text.starts_with("/dev/"); }

/// Asks the kernel, without blocking, whether this is a camera.
void checkDevice(const std::string& path) {
  const auto refuse = [&](const std::string& what) { throw CalibrationError("webcam " + path + ": " + what); };
  struct stat file {};
  if (stat(path.c_str(), &file) != 0) refuse("it is not there, plug it in (ls /dev/video*)");
  if (!S_ISCHR(file.st_mode) || major(file.st_rdev) != kVideoDevices)
    refuse("it is not a camera, give one of /dev/video*");
  const int handle = open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (handle < 0)
    refuse(errno == EACCES ? "no permission, add yourself to the group video and log in again"
                           : std::string("it cannot be opened (") + std::strerror(errno) + "), close other programs");
  v4l2_capability can{};
  const bool answered = ioctl(handle, VIDIOC_QUERYCAP, &can) == 0;
  close(handle);
  const unsigned what = (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0U ? can.device_caps : can.capabilities;
  if (!answered || (what & V4L2_CAP_VIDEO_CAPTURE) == 0U) refuse("it delivers no images, try the next of /dev/video*");
}

}  // namespace

OpenedImageSource openImageSource(const WebcamSettings& wanted) {
  if (!isWebcam(wanted.device)) return {imageFolder(wanted.device), ""};
  const std::string path = isIndex(wanted.device) ? "/dev/video" + wanted.device : wanted.device;
  checkDevice(path);
  auto live = std::make_unique<LiveImageSource>(
      "webcam " + path, [path, wanted] { return openCvModule().camera(path, wanted); }, LiveImageSource::Timeouts{});
  std::string remarks = live->remarks();
  return {std::move(live), std::move(remarks)};
}

}  // namespace calibration
