// Progress of long work, as a share 0..1 of it. Reported from worker threads, many times; the receiver must be quick
// and thread-safe, and may throw to cancel: the work stops and passes the exception on.
#pragma once

#include <functional>

namespace assets {

using ReportProgress = std::function<void(double share)>;

/// Progress of a part of the work, which is that section of the whole. `whole` is borrowed and may be empty.
inline ReportProgress sectionOf(const ReportProgress& whole, double from, double to) {
  return [&whole, from, to](double share) {
    if (whole) whole(from + share * (to - from));
  };
}

}  // namespace assets
