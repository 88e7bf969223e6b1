#include "assets/import/dicom/received_files.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "assets/load_error.h"

namespace assets {
namespace {

int fileWithoutName() {
  constexpr mode_t kOwnerAlone = 0600;
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  const int on_disk = error ? -1 : ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC | O_EXCL, kOwnerAlone);
  return on_disk >= 0 ? on_disk : ::memfd_create("scan", MFD_CLOEXEC);
}

}  // namespace

ReceivedFiles::ReceivedFiles() : descriptor_(fileWithoutName()) {
  if (descriptor_ < 0) throw LoadError("scan: there is no place to receive it; check TMPDIR");
}

ReceivedFiles::ReceivedFiles(ReceivedFiles&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      written_(other.written_),
      begins_(std::move(other.begins_)),
      mapped_(std::exchange(other.mapped_, nullptr)),
      mapped_bytes_(other.mapped_bytes_) {}

ReceivedFiles::~ReceivedFiles() {
  if (mapped_ != nullptr) ::munmap(const_cast<char*>(mapped_), mapped_bytes_);
  if (descriptor_ >= 0) ::close(descriptor_);
}

void ReceivedFiles::append(std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(written_));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw LoadError("scan: the disk is full while it is received; free some space, or set TMPDIR");
    written_ += static_cast<std::uint64_t>(count);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

void ReceivedFiles::endFile() { begins_.push_back(written_); }

void ReceivedFiles::takeWritten(std::uint64_t bytes) {
  written_ += bytes;
  endFile();
}

void ReceivedFiles::close() {
  if (mapped_ != nullptr || bytes() == 0) return;
  // What another process says that it wrote must be there.
  struct stat facts {};
  if (::fstat(descriptor_, &facts) != 0 || static_cast<std::uint64_t>(facts.st_size) < bytes())
    throw LoadError("scan: it was not received whole; try again");
  void* const at = ::mmap(nullptr, bytes(), PROT_READ, MAP_PRIVATE, descriptor_, 0);
  if (at == MAP_FAILED) throw LoadError("scan: there is not enough memory for it; close other programs");
  mapped_ = static_cast<const char*>(at);
  mapped_bytes_ = bytes();
}

std::span<const char> ReceivedFiles::file(std::size_t n) const {
  if (mapped_ == nullptr) return {};
  return {mapped_ + begins_[n], static_cast<std::size_t>(begins_[n + 1] - begins_[n])};
}

}  // namespace assets
