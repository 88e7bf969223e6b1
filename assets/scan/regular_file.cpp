#include "assets/scan/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "assets/load_error.h"

namespace assets {

RegularFile::RegularFile(const std::string& path) : path_(path) {
  struct stat facts {};
  if (path.find('\0') != std::string::npos || ::stat(path.c_str(), &facts) != 0)
    throw LoadError(path + ": there is no such file; check the name");
  if (!S_ISREG(facts.st_mode)) throw LoadError(path + ": it is not a file; give one volume file");
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor_ < 0) throw LoadError(path + ": it may not be read; check its permissions");

  // The path may have been replaced since the first check.
  if (::fstat(descriptor_, &facts) != 0 || !S_ISREG(facts.st_mode)) {
    ::close(descriptor_);
    throw LoadError(path + ": it is not a file; give one volume file");
  }
  size_ = static_cast<std::uint64_t>(facts.st_size);
}

RegularFile::~RegularFile() { ::close(descriptor_); }

std::size_t RegularFile::readAt(std::uint64_t from_byte, std::span<char> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size() && from_byte + done < size_) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(from_byte + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw LoadError(path_ + ": it cannot be read; check the disk");
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

}  // namespace assets
