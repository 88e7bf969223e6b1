#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include <fmt/core.h>

#include "app/doctor/checks.h"

namespace app {
namespace {

constexpr double kMB = 1e6;
constexpr std::size_t kChunk_bytes = 1'000'000, kChunks = 16;
constexpr double kLeastFree_MB = 200.0, kEnoughFree_MB = 2000.0;
constexpr double kLeastSpeed_MB_per_s = 10.0;

/// True when all of it reached the disk.
bool write(int file) {
  const std::vector<char> chunk(kChunk_bytes, 'm');
  for (std::size_t i = 0; i < kChunks; ++i)
    if (::write(file, chunk.data(), chunk.size()) != static_cast<ssize_t>(chunk.size())) return false;
  return fsync(file) == 0;
}

}  // namespace

DiskFacts probeDisk(const std::filesystem::path& folder) {
  DiskFacts facts;
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  if (error) return facts;
  facts.free_MB = static_cast<double>(space.available) / kMB;
  std::string name = (folder / ".molar-doctor-").string() + std::string(6, 'X');
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) return facts;
  unlink(name.c_str());
  facts.is_writable = true;
  const auto begun = std::chrono::steady_clock::now();
  if (facts.free_MB > kLeastFree_MB && write(file)) {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
    facts.written_MB_per_s = static_cast<double>(kChunk_bytes * kChunks) / kMB / std::max(taken.count(), 1e-6);
  }
  close(file);
  return facts;
}

Finding checkDisk(const std::filesystem::path& folder, const DiskFacts& facts) {
  const std::string where = folder.string();
  if (!facts.is_writable)
    return {"disk", Health::missing, where + ": no recording can be written there.",
            "Name a folder of yours with --sessions, or change its owner."};
  const std::string free = facts.free_MB >= 1000.0 ? fmt::format("{:.1f} GB", facts.free_MB / 1000.0)
                                                   : fmt::format("{:.0f} MB", facts.free_MB);
  const std::string sentence =
      where + ": " + free + " free, written at " + fmt::format("{:.0f} MB/s.", facts.written_MB_per_s);
  if (facts.free_MB < kLeastFree_MB)
    return {"disk", Health::missing, where + ": only " + free + " free.", "Delete what you do not need."};
  if (facts.free_MB < kEnoughFree_MB)
    return {"disk", Health::warn, sentence, "Make room before a day of recordings: 2 GB or more."};
  if (facts.written_MB_per_s < kLeastSpeed_MB_per_s)
    return {"disk", Health::warn, sentence, "Record to a faster disk: 10 MB/s or more."};
  return {"disk", Health::ok, sentence};
}

}  // namespace app
