#include "tests/haptics/fake_input_device.h"

#include <fcntl.h>
#include <linux/input.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstring>
#include <fstream>
#include <mutex>

#include <gtest/gtest.h>

namespace haptics {
namespace {

struct Answering {
  FakeTraits traits;
  bool grabbed = false, opened = false;
};

std::mutex mutex;

std::map<std::uint64_t, Answering>& answering() {
  static std::map<std::uint64_t, Answering> by_inode;
  return by_inode;
}

std::string bitMapText(const std::vector<std::uint16_t>& bits) {
  std::array<unsigned long long, 12> words{};
  for (const std::uint16_t bit : bits) words[bit / 64u] |= 1ull << (bit % 64u);
  std::string text;
  for (std::size_t i = words.size(); i-- > 0;)
    if (words[i] != 0 || !text.empty() || i == 0) {
      std::array<char, 20> word{};
      std::snprintf(word.data(), word.size(), "%llx ", words[i]);
      text += word.data();
    }
  return text;
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text << "\n";
}

int giveBits(void* to, std::size_t size, const std::vector<std::uint16_t>& bits) {
  auto* bytes = static_cast<unsigned char*>(to);
  std::memset(bytes, 0, size);
  for (const std::uint16_t bit : bits)
    if (bit / 8u < size) bytes[bit / 8u] = static_cast<unsigned char>(bytes[bit / 8u] | 1u << (bit % 8u));
  return static_cast<int>(size);
}

/// As the kernel's drivers/input/evdev.c does.
int answer(Answering& device, unsigned long request, void* to) {
  const std::size_t size = _IOC_SIZE(request);
  const unsigned number = _IOC_NR(request);
  device.opened = true;
  if (request == EVIOCGRAB) {
    device.grabbed = to != nullptr;
    return 0;
  }
  if (request == EVIOCGVERSION) return *static_cast<int*>(to) = EV_VERSION, 0;
  if (request == EVIOCGID)
    return *static_cast<input_id*>(to) = {BUS_USB, device.traits.vendor, device.traits.product, 1}, 0;
  if (number == _IOC_NR(EVIOCGNAME(0))) {
    std::strncpy(static_cast<char*>(to), device.traits.name.c_str(), size);
    return static_cast<int>(device.traits.name.size()) + 1;
  }
  if (number == _IOC_NR(EVIOCGPHYS(0)) || number == _IOC_NR(EVIOCGUNIQ(0))) return errno = ENOENT, -1;
  if (number == _IOC_NR(EVIOCGKEY(0))) return giveBits(to, size, device.traits.down);
  if (number == _IOC_NR(EVIOCGBIT(0, 0))) {
    std::vector<std::uint16_t> kinds = {EV_SYN, EV_KEY};
    if (!device.traits.axes.empty()) kinds.push_back(EV_ABS);
    return giveBits(to, size, kinds);
  }
  if (number == _IOC_NR(EVIOCGBIT(EV_KEY, 0))) return giveBits(to, size, device.traits.keys);
  if (number == _IOC_NR(EVIOCGBIT(EV_ABS, 0))) return giveBits(to, size, device.traits.axes);
  if (number > _IOC_NR(EVIOCGBIT(0, 0)) && number < _IOC_NR(EVIOCGABS(0))) return giveBits(to, size, {});
  if (number >= _IOC_NR(EVIOCGABS(0)) && number < _IOC_NR(EVIOCGABS(ABS_CNT))) {
    *static_cast<input_absinfo*>(to) = {0, device.traits.least, device.traits.most, 0, 0, 0};
    return 0;
  }
  return giveBits(to, size, {});
}

}  // namespace

FakeInputFolder::FakeInputFolder(const std::string& name)
    : root_(std::filesystem::path(testing::TempDir()) / ("molar_input_" + name + "_" + std::to_string(getpid()))) {
  std::filesystem::remove_all(root_);
  folders_ = {root_ / "class", root_ / "dev"};
  std::filesystem::create_directories(folders_.classes);
  std::filesystem::create_directories(folders_.nodes);
}

FakeInputFolder::~FakeInputFolder() { std::filesystem::remove_all(root_); }

FakeInputDevice::FakeInputDevice(const FakeInputFolder& folder, int number, const FakeTraits& traits) {
  const std::string name = "event" + std::to_string(number);
  class_ = folder.folders().classes / name;
  node_ = folder.folders().nodes / name;
  EXPECT_EQ(mkfifo(node_.c_str(), 0600), 0);
  fd_ = open(node_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  struct stat is {};
  fstat(fd_, &is);
  inode_ = is.st_ino;
  {
    const std::lock_guard lock(mutex);
    answering()[inode_] = {traits};
  }
  char product[8], vendor[8];
  std::snprintf(vendor, sizeof vendor, "%04x", traits.vendor);
  std::snprintf(product, sizeof product, "%04x", traits.product);
  write(class_ / "device/id/vendor", vendor);
  write(class_ / "device/id/product", product);
  write(class_ / "device/capabilities/key", bitMapText(traits.keys));
  write(class_ / "device/capabilities/abs", bitMapText(traits.axes));
  write(class_ / "device/capabilities/rel", bitMapText(traits.relative));
  write(class_ / "device/name", traits.name);
}

FakeInputDevice::~FakeInputDevice() { unplug(); }

void FakeInputDevice::sendBytes(const std::string& bytes) {
  EXPECT_EQ(::write(fd_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
}

void FakeInputDevice::send(std::uint16_t type, std::uint16_t code, std::int32_t value) {
  std::array<input_event, 2> events{};
  events[0].type = type;
  events[0].code = code;
  events[0].value = value;
  events[1].type = EV_SYN;
  events[1].code = SYN_REPORT;
  sendBytes({reinterpret_cast<const char*>(events.data()), sizeof events});
}

void FakeInputDevice::unplug() {
  if (fd_ < 0) return;
  std::filesystem::remove_all(class_);
  std::filesystem::remove(node_);
  close(fd_);
  fd_ = -1;
  const std::lock_guard lock(mutex);
  answering().erase(inode_);
}

bool FakeInputDevice::isGrabbed() const {
  const std::lock_guard lock(mutex);
  return answering().at(inode_).grabbed;
}

bool FakeInputDevice::wasOpened() const {
  const std::lock_guard lock(mutex);
  return answering().at(inode_).opened;
}

}  // namespace haptics

/// In place of the C library's: answers for our pipes, asks the kernel for everything else.
extern "C" int ioctl(int fd, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* to = va_arg(arguments, void*);
  va_end(arguments);
  struct stat is {};
  if (_IOC_TYPE(request) == 'E' && fstat(fd, &is) == 0 && S_ISFIFO(is.st_mode)) {
    const std::lock_guard lock(haptics::mutex);
    const auto found = haptics::answering().find(is.st_ino);
    if (found == haptics::answering().end()) return errno = ENODEV, -1;
    return haptics::answer(found->second, request, to);
  }
  return static_cast<int>(syscall(SYS_ioctl, fd, request, to));
}
