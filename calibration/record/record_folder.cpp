#include "calibration/record/record_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "calibration/output_file.h"

namespace calibration {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuseWriting(const fs::path& path, const std::string& what, const std::string& mend) {
  throw CalibrationError("cannot write " + path.string() + ": " + what + ", " + mend);
}

[[noreturn]] void refuseWritingForSystem(const fs::path& path, int error) {
  refuseWriting(path, std::strerror(error), "free some space or choose another folder");
}

void sync(const fs::path& path) {
  if (const int error = syncToDisk(path.string()); error != 0) refuseWritingForSystem(path, error);
}

/// Length up to the end of the last complete line.
std::uintmax_t completeBytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.view().rfind('\n') + 1;
}

}  // namespace

void makeFolder(const fs::path& folder) {
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return;
  makeFolder(folder.parent_path());
  if (!fs::create_directory(folder, error) && error) refuseWritingForSystem(folder, error.value());
  sync(folder.parent_path());
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
  if (!is_new) fs::resize_file(path, completeBytes(path), error);
  if (error) refuseWritingForSystem(path, error.value());
  std::ofstream out(path, std::ios::binary | std::ios::app);
  out << line << '\n';
  out.close();
  if (!out) refuseWritingForSystem(path, errno);
  sync(path);
  if (is_new) sync(path.parent_path());
}

}  // namespace calibration
