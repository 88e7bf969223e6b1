// Processes that a rehearsal starts beside itself: seat, page, voice. They have low priority, never the servo's core,
// and hold no file of the rehearsal but those that they were given. Linux.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace app {

/// Starts `PROGRAM words…` with these descriptors at the same numbers, in a process group of its own: an interrupt at
/// the terminal is the rehearsal's to answer. Its process; 0: it could not be started.
int startBeside(const std::string& program, std::vector<std::string> words, std::span<const int> descriptors);
/// Ends it with its whole group, which no other process can have while it has not been waited for, and waits: asked to
/// (SIGTERM), it is gone within milliseconds, a stopped one too; killed after half a second.
void endBeside(int process);

/// In the process itself: low priority, off the servo's core, all descriptors from 3 on closed but these.
void stepAside(std::vector<int> kept);

}  // namespace app
