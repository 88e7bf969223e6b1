// Which servo made the ticks of a session. Its own header, so that raising it builds little anew.
#pragma once

namespace haptics {

/// Raised with every change after which the same bone, hand and commands may give other bits in a Tick, as a digest or
/// figure recorded in a test shows: sessions of other revisions are read, not run again and compared.
inline constexpr int kServoRevision = 1;

}  // namespace haptics
