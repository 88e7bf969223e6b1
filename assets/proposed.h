// What the program found in a scan and no person has confirmed; numbers that rest on it are told as not confirmed.
// Plain values; any thread.
#pragma once

#include <string>
#include <string_view>

namespace assets {

/// At the end of a title.
inline constexpr std::string_view kNotConfirmedTitle = ", not confirmed";

/// What the program found and no person has confirmed.
struct Proposed {
  bool tooth = false, canal = false;

  bool any() const { return tooth || canal; }
  /// "tooth and canal"; empty: none.
  std::string words() const {
    return std::string(tooth ? "tooth" : "") + (tooth && canal ? " and " : "") + (canal ? "canal" : "");
  }
};

}  // namespace assets
