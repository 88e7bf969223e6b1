// A certificate and its key, made by this station for one session: P-256, signed by itself, valid for two days. A
// browser asks once whether it is to be trusted; its fingerprint stands on the operator's terminal. Any thread; 1 ms.
#pragma once

#include <string>

namespace app {

/// Both as PEM, the key first. Throws SessionError: OpenSSL cannot.
std::string selfMadeIdentity();
/// SHA-256 of the certificate in it, as browsers show it: "AB:CD:…".
std::string fingerprintOf(const std::string& identity);

}  // namespace app
