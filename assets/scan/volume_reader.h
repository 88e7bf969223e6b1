// Reads a volume.vdb in a process of its own, so that a file made to break OpenVDB breaks that process and not this
// one. The process is a fork that keeps no file, handler or terminal of the program, may use memory, processor time and
// time by the clock in proportion to the file, and hands back plain arrays in a file of memory, which are checked here
// for length and geometry. Any thread, at start-up: what OpenVDB or the C library holds locked in another thread at the
// fork would stop the reader until its time by the clock is over; SIGCHLD has its default meaning meanwhile. Costs a
// fork and two copies, about 10 ms for a jaw.
#pragma once

#include <cstdint>
#include <string>

#include "assets/ct_volume.h"

namespace assets {

struct ReaderLimits {
  std::uint64_t memory_bytes;
  std::uint32_t processor_ms;
  std::uint32_t wait_ms;  ///< by the clock: the disk is slow, other programs run
};

/// What a file of that size may take: far above what files of ours do (40 times their size, 60 ms a megabyte); by the
/// clock 20 times the processor time.
ReaderLimits readerLimits(std::uint64_t file_bytes);

/// Throws LoadError: what the reader says of the file, or that it failed on it.
CtVolume readVolumeInChild(const std::string& path);

/// All that the reading process does: leaves the program behind, reads `path` within the limits, answers into the open
/// file, and never returns. Its exit status is 0 for a volume, 3 for a refusal in words, 5 for want of memory.
[[noreturn]] void runVolumeReader(const std::string& path, const ReaderLimits& limits, int answer_descriptor);

/// The answer of a reading process that has ended with that status (waitpid).
CtVolume volumeFromAnswer(int answer_descriptor, int wait_status, const std::string& path);

}  // namespace assets
