// Reads a volume.vdb in a child process, so that a file made to break OpenVDB breaks only that process. The child is a
// fork without the program's open files, signal handlers and terminal, with limits on memory, processor time and wall
// time in proportion to the file; it returns plain arrays through a memory file, whose length and geometry are checked
// here. Any thread, at start-up: a lock held by another thread at the fork would stall the child until its wall time is
// over; SIGCHLD has its default action meanwhile. Costs a fork and two copies, about 10 ms for a jaw.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "assets/ct_volume.h"

namespace assets {

struct ReaderLimits {
  std::uint64_t memory_bytes;
  std::uint32_t processor_ms;
  std::uint32_t wait_ms;  ///< wall time
};

/// Limits for a file of that size, far above the usual needs (40 times its size, 60 ms a megabyte).
ReaderLimits readerLimits(std::uint64_t file_bytes);

/// A reading process that runs beside its maker until its volume is taken. One at a time in a thread.
class VolumeInChild {
 public:
  /// Starts it. Throws LoadError.
  explicit VolumeInChild(const std::string& path);
  /// A volume that nobody takes is given up.
  ~VolumeInChild();
  VolumeInChild(const VolumeInChild&) = delete;
  VolumeInChild& operator=(const VolumeInChild&) = delete;

  /// Waits for it; once. Throws LoadError with the reader's message, or that it failed on the file.
  CtVolume take();

 private:
  int waited();

  std::string path_;
  struct Process;
  std::unique_ptr<Process> process_;
};

/// Throws LoadError as take().
CtVolume readVolumeInChild(const std::string& path);

/// The reading process: detaches from the program, reads `path` within the limits, writes the answer to the open file
/// and exits: 0 for a volume, 3 for an error message, 5 for lack of memory.
[[noreturn]] void runVolumeReader(const std::string& path, const ReaderLimits& limits, int answer_descriptor);

/// The volume from the answer of a reading process that ended with that status (waitpid).
CtVolume volumeFromAnswer(int answer_descriptor, int wait_status, const std::string& path);

}  // namespace assets
