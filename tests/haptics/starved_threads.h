// A process whose memory has run out for all threads but the first: operator new throws there while `starve(true)`. For
// tests of services that must end with a word and not end the program.
#pragma once

namespace haptics {

/// By the first thread alone.
void starve(bool others) noexcept;

}  // namespace haptics
