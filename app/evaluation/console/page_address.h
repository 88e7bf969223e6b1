// Where the page is served: an address and a port, opened by the rehearsal's process itself, so that they stay while
// another process serves them. Start-up only.
#pragma once

#include <string>

namespace app {

/// A listening socket, closed with the object and in programs that are started.
class PageAddress {
 public:
  /// "127.0.0.1:8080", "[::1]:0": port 0 is any that is free. Throws UsageError: no such address, one that others can
  /// reach without `is_shared`, or in use.
  PageAddress(const std::string& text, bool is_shared);
  ~PageAddress();
  PageAddress(const PageAddress&) = delete;
  PageAddress& operator=(const PageAddress&) = delete;

  int descriptor() const { return socket_; }
  int port() const { return port_; }
  /// "127.0.0.1:8080", with the port that was found.
  std::string text() const;

 private:
  int socket_ = -1, port_ = 0;
  std::string host_;
};

}  // namespace app
