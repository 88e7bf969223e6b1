// Counts every operator new of the process, so that a test can show that a stretch of code makes none.
#pragma once

#include <cstddef>

namespace haptics::allocation_count {

std::size_t now();

/// Of the calling thread alone, where others may allocate as they like.
std::size_t onThisThread();

}  // namespace haptics::allocation_count
