#include "calibration/record/record_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace calibration {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuseWriting(const fs::path& path, const std::string& what, const std::string& mend) {
  throw CalibrationError("can not write " + path.string() + ": " + what + ", " + mend);
}

[[noreturn]] void refuseWritingForSystem(const fs::path& path, int error) {
  refuseWriting(path, std::strerror(error), "make room there or choose another place");
}

/// Closed whatever happens.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : path_(path), number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (number_ < 0) refuseWritingForSystem(path, errno);
  }
  ~Descriptor() { ::close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  void write(const std::string& text) const {
    std::size_t done = 0;
    while (done < text.size()) {
      const ssize_t written = ::write(number_, text.data() + done, text.size() - done);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) refuseWritingForSystem(path_, errno);
      done += static_cast<std::size_t>(written);
    }
  }
  void force() const {
    if (::fsync(number_) != 0) refuseWritingForSystem(path_, errno);
  }

 private:
  fs::path path_;
  int number_;
};

void forceFolder(const fs::path& folder) { Descriptor(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY).force(); }

}  // namespace

void makeFolder(const fs::path& folder) {
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return;
  makeFolder(folder.parent_path());
  if (!fs::create_directory(folder, error) && error) refuseWritingForSystem(folder, error.value());
  forceFolder(folder.parent_path());
}

FolderLock::FolderLock(const fs::path& folder)
    : descriptor_(::open((folder / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) refuseWritingForSystem(folder, errno);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  ::close(descriptor_);
  refuseWriting(folder, "another program is writing there", "wait until it has finished");
}

FolderLock::~FolderLock() { ::close(descriptor_); }

void removeLeftovers(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().filename().string().starts_with(".part-")) fs::remove(entry.path(), ignored);
}

void appendLine(const fs::path& path, const std::string& line) {
  std::error_code error;
  const bool is_new = !fs::exists(path, error);
  const Descriptor file(path, O_RDWR | O_CREAT | O_APPEND);
  // Back to the end of the last whole line.
  off_t end = ::lseek(file.number(), 0, SEEK_END);
  char last = '\n';
  off_t whole = end;
  while (whole > 0 && ::pread(file.number(), &last, 1, whole - 1) == 1 && last != '\n') --whole;
  if (whole != end && ::ftruncate(file.number(), whole) != 0) refuseWritingForSystem(path, errno);
  file.write(line + "\n");
  file.force();
  if (is_new) forceFolder(path.parent_path());
}

}  // namespace calibration
