#include "assets/scan/volume_reader.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>
#include <span>
#include <utility>

#include "assets/load_error.h"
#include "assets/scan/confined_child.h"
#include "assets/scan/resampling.h"
#include "assets/scan/vdb_parse.h"

namespace assets {

namespace {

constexpr int kRefused = 3;
constexpr int kFailed = 4;
constexpr int kOutOfMemory = 5;

/// Header of the answer, followed by Hounsfield, labels, solid and, if present, teeth.
struct Head {
  std::array<std::int32_t, 3> size;
  double spacing_mm;
  std::array<double, 3> origin_P_mm;
};

bool writeAll(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

bool readAll(int descriptor, std::span<std::byte> bytes, std::uint64_t from_byte) {
  while (!bytes.empty()) {
    const ssize_t got = ::pread(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(from_byte));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(got));
    from_byte += static_cast<std::uint64_t>(got);
  }
  return true;
}

[[noreturn]] void refuseFailure(const std::string& path) {
  throw LoadError(path + ": it is damaged (its reader failed on it); import the scan again");
}

}  // namespace

ReaderLimits readerLimits(std::uint64_t file_bytes) {
  constexpr std::uint64_t kMegabyte = 1'000'000;
  const std::uint64_t sane_bytes = std::min<std::uint64_t>(file_bytes, 100'000 * kMegabyte);
  const auto processor_ms = static_cast<std::uint32_t>(4000 + 600 * (sane_bytes / kMegabyte));
  constexpr std::uint32_t kWaitFactor = 20;
  return {600 * kMegabyte + 100 * sane_bytes, processor_ms, kWaitFactor * processor_ms};
}

void runVolumeReader(const std::string& path, const ReaderLimits& limits, int answer_descriptor) {
  confineChild(limits.memory_bytes, answer_descriptor);
  answer_descriptor = kKeptDescriptor;
  limitChildTime(limits.processor_ms, limits.wait_ms);
  try {
    const CtVolume volume = parseVdb(path);
    const VolumeGrid& grid = volume.grid;
    const Head head{{grid.size.x, grid.size.y, grid.size.z},
                    grid.spacing_mm,
                    {grid.origin_P_mm.x, grid.origin_P_mm.y, grid.origin_P_mm.z}};
    const auto write = [&](const auto&... values) {
      return (writeAll(answer_descriptor, std::as_bytes(std::span(values))) && ...);
    };
    const bool is_written = writeAll(answer_descriptor, std::as_bytes(std::span(&head, 1))) &&
                            write(volume.hounsfield, volume.label, volume.solid, volume.tooth);
    ::_exit(is_written ? 0 : kFailed);
  } catch (const LoadError& refusal) {
    const std::string_view text = refusal.what();
    ::_exit(writeAll(answer_descriptor, std::as_bytes(std::span(text))) ? kRefused : kFailed);
  } catch (const std::bad_alloc&) {
    ::_exit(kOutOfMemory);
  } catch (...) {
    ::_exit(kFailed);
  }
}

CtVolume volumeFromAnswer(int answer_descriptor, int wait_status, const std::string& path) {
  struct stat facts {};
  if (!WIFEXITED(wait_status) || ::fstat(answer_descriptor, &facts) != 0) refuseFailure(path);
  const auto bytes = static_cast<std::uint64_t>(facts.st_size);
  if (WEXITSTATUS(wait_status) == kOutOfMemory)
    throw LoadError(path + ": there is not enough memory to read it; close other programs, or import the scan again");
  if (WEXITSTATUS(wait_status) == kRefused) {
    std::string text(std::min<std::uint64_t>(bytes, 1 << 13), ' ');
    if (text.empty() || !readAll(answer_descriptor, std::as_writable_bytes(std::span(text)), 0)) refuseFailure(path);
    throw LoadError(printable(text, text.size()));
  }

  Head head;
  if (WEXITSTATUS(wait_status) != 0 || bytes < sizeof head) refuseFailure(path);
  if (!readAll(answer_descriptor, std::as_writable_bytes(std::span(&head, 1)), 0)) refuseFailure(path);
  CtVolume volume;
  volume.grid = {{head.size[0], head.size[1], head.size[2]},
                 head.spacing_mm,
                 {head.origin_P_mm[0], head.origin_P_mm[1], head.origin_P_mm[2]}};
  requireValidGeometry({volume.grid.size, glm::dmat3(volume.grid.spacing_mm), volume.grid.origin_P_mm}, path);
  const std::size_t voxels = volume.grid.voxelCount();
  constexpr std::uint64_t kVoxelBytes = 4;
  const bool has_teeth = bytes == sizeof head + (kVoxelBytes + 1) * voxels;
  if (!has_teeth && bytes != sizeof head + kVoxelBytes * voxels) refuseFailure(path);
  std::uint64_t from_byte = sizeof head;
  const auto read = [&](auto& values, std::size_t count) {
    values.resize(count);
    const auto array = std::as_writable_bytes(std::span(values));
    return readAll(answer_descriptor, array, std::exchange(from_byte, from_byte + array.size()));
  };
  const bool is_read = read(volume.hounsfield, voxels) && read(volume.label, voxels) && read(volume.solid, voxels) &&
                       read(volume.tooth, has_teeth ? voxels : 0);
  if (!is_read) refuseFailure(path);
  return volume;
}

struct VolumeInChild::Process {
  class Descriptor {
   public:
    explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
    ~Descriptor() { ::close(descriptor_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    operator int() const { return descriptor_; }

   private:
    int descriptor_;
  };

  DefaultChildSignal children_wait;
  Descriptor answer{::memfd_create("volume", MFD_CLOEXEC)};
  pid_t reader = -1;
};

VolumeInChild::VolumeInChild(const std::string& path) : path_(path), process_(std::make_unique<Process>()) {
  std::error_code error;
  const std::uint64_t bytes = std::filesystem::file_size(path, error);
  process_->reader = process_->answer < 0 ? -1 : ::fork();
  if (process_->reader == 0) runVolumeReader(path, readerLimits(error ? 0 : bytes), process_->answer);
  if (process_->reader < 0) throw LoadError(path + ": no process can be started to read it; close other programs");
}

VolumeInChild::~VolumeInChild() {
  if (!process_ || process_->reader < 0) return;
  ::kill(process_->reader, SIGKILL);
  waited();
}

/// Its status; -1: none.
int VolumeInChild::waited() {
  int status = 0;
  while (::waitpid(process_->reader, &status, 0) < 0)
    if (errno != EINTR) {
      status = -1;
      break;
    }
  process_->reader = -1;
  return status;
}

CtVolume VolumeInChild::take() {
  const int status = waited();
  if (status == -1) refuseFailure(path_);
  return volumeFromAnswer(process_->answer, status, path_);
}

CtVolume readVolumeInChild(const std::string& path) { return VolumeInChild(path).take(); }

}  // namespace assets
