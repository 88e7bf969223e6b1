// The page's own process, `molar page`: HTTP/1.1 and WebSocket on one thread (Boost.Beast), started by a session
// (page_link), from which it has the listening socket, the pictures and all that it knows. Low priority, never on the
// servo's core. Ends when the session does. Trusts no client: Host, Origin, sizes, rates and numbers are bounded, and
// whoever takes nothing for a while is dropped. Linux.
#pragma once

namespace app {

struct PageOptions {
  int listener = -1, pictures = -1, bell = -1, words = -1;  ///< descriptors
  int identity = -1;                                        ///< certificate and key; -1: not shared, without TLS
};

/// The exit status. Throws SessionError: what it was given cannot be used.
int runPage(const PageOptions& options);

}  // namespace app
