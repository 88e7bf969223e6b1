// Revision of the servo that made a session's ticks. Its own header, so that raising it rebuilds little.
#pragma once

namespace haptics {

/// Raised with every change that may alter a bit of a Tick for the same bone, hand and commands (recorded digests in
/// the tests show it): sessions of other revisions are read, but not verified by a replay.
inline constexpr int kServoRevision = 9;

}  // namespace haptics
