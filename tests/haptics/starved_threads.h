// A process whose memory runs out for all threads but the first: operator new throws there after `starve(true)`. For
// tests of services that must report it and not end the program.
#pragma once

namespace haptics {

/// By the first thread alone.
void starve(bool others) noexcept;

}  // namespace haptics
