// The hands that need no hardware, one line each: the address, what it is, what it can serve, how it begins. Real
// devices have theirs in haptics/device/device_catalogue. A new hand is a file, its name in hands.h and a line here.
// Plain data; any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/device/hands.h"

namespace app {

struct HandKind {
  std::string_view scheme;                 ///< of its address, up to the colon
  std::string_view help;                   ///< how the address goes on, and what it is
  bool in_numbers;                         ///< it works by itself: no window, no clock of its own
  bool holds_any_tool;                     ///< as the other hand too
  bool works_by_plan;                      ///< it takes the cut that is planned
  bool (*takes)(const std::string& rest);  ///< whether an address may go on so; may throw UsageError to say more
  HandAtWork (*begin)(const std::string& rest, const HandCase& at);
};

std::span<const HandKind> handKinds();
/// Of this address; null for what is none, a real device too. Throws UsageError for one that goes on wrongly and says
/// how.
const HandKind* handKindOf(const std::string& address);
/// Behind the scheme and its colon.
std::string restOf(const std::string& address);

/// Throws UsageError for what is neither a hand nor the address of a device.
void refuseUnlessHand(const std::string& address);
/// The line of `--device`: every hand and every device.
std::string handHelp();

}  // namespace app
