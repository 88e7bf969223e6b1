// What a web request must be before anything is done for it: its Host names this station (no other name may be made to
// point here), its Origin is the page's own, its path is one that is served; and the headers of every answer. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace app {

class PageGate {
 public:
  PageGate(int port, bool is_shared) : port_(port), is_shared_(is_shared) {}

  /// The loopback by number or as localhost; where it is shared any address in numbers: names can be made to lead here.
  bool isOwnHost(std::string_view host) const;
  /// Of a WebSocket, or of what changes something.
  bool isOwnOrigin(std::string_view origin, std::string_view host) const;

  /// Of the cookie that says who was paired; empty: none.
  static std::string tokenIn(std::string_view cookies);
  static std::string cookieOf(std::string_view token);
  /// Value of a key in what follows the ? of a target, not decoded; empty: none.
  static std::string valueIn(std::string_view target, std::string_view key);
  static std::string_view pathOf(std::string_view target);

  static const std::vector<std::pair<std::string_view, std::string_view>>& headers();

 private:
  int port_;
  bool is_shared_;
};

}  // namespace app
