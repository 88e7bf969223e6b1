#include "app/evaluation/console/page_address.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

#include "app/text/parse_number.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

struct Named {
  sockaddr_storage address{};
  socklen_t size = 0;
  bool is_loopback = false;
};

std::optional<Named> namedBy(std::string host, int port) {
  Named named;
  if (host == "localhost") host = "127.0.0.1";
  in_addr four{};
  in6_addr six{};
  if (::inet_pton(AF_INET, host.c_str(), &four) == 1) {
    sockaddr_in of{};
    of.sin_family = AF_INET, of.sin_addr = four, of.sin_port = htons(static_cast<std::uint16_t>(port));
    std::memcpy(&named.address, &of, sizeof of);
    named.size = sizeof of;
    constexpr std::uint32_t kLoopbackNet = 127;
    named.is_loopback = ntohl(four.s_addr) >> 24U == kLoopbackNet;
  } else if (::inet_pton(AF_INET6, host.c_str(), &six) == 1) {
    sockaddr_in6 of{};
    of.sin6_family = AF_INET6, of.sin6_addr = six, of.sin6_port = htons(static_cast<std::uint16_t>(port));
    std::memcpy(&named.address, &of, sizeof of);
    named.size = sizeof of;
    named.is_loopback = IN6_IS_ADDR_LOOPBACK(&six);
  } else {
    return {};
  }
  return named;
}

}  // namespace

PageAddress::PageAddress(const std::string& text, bool is_shared) {
  const auto refuse = [&](const std::string& why) { throw UsageError("--page " + text + ": " + why); };
  const std::size_t colon = text.rfind(':');
  constexpr int kMostPort = 65535;
  const auto port = colon == std::string::npos ? std::nullopt : parseNumber<int>(text.substr(colon + 1));
  if (!port || *port < 0 || *port > kMostPort) refuse("give an address and a port, like 127.0.0.1:8080");
  host_ = text.substr(0, colon);
  if (host_.starts_with('[') && host_.ends_with(']')) host_ = host_.substr(1, host_.size() - 2);
  const auto named = namedBy(host_, *port);
  if (!named) refuse("is no address, give one in numbers, like 127.0.0.1:8080");
  if (!named->is_loopback && !is_shared)
    refuse("others can reach that address, add --share (encrypted, with a code), or give 127.0.0.1:PORT");
  socket_ = ::socket(named->address.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  constexpr int kYes = 1, kWaiting = 32;
  ::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &kYes, sizeof kYes);
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  if (socket_ < 0 || ::bind(socket_, reinterpret_cast<const sockaddr*>(&named->address), named->size) != 0 ||
      ::listen(socket_, kWaiting) != 0 || ::getsockname(socket_, reinterpret_cast<sockaddr*>(&bound), &size) != 0) {
    const std::string why = std::strerror(errno);
    if (socket_ >= 0) ::close(socket_);
    refuse("cannot be opened (" + why + "), give another port, or 0 for any");
  }
  sockaddr_in four{};
  sockaddr_in6 six{};
  std::memcpy(&four, &bound, sizeof four);
  std::memcpy(&six, &bound, sizeof six);
  port_ = ntohs(bound.ss_family == AF_INET ? four.sin_port : six.sin6_port);
}

PageAddress::~PageAddress() { ::close(socket_); }

std::string PageAddress::text() const {
  const bool is_six = host_.find(':') != std::string::npos;
  return (is_six ? "[" + host_ + "]" : host_) + ":" + std::to_string(port_);
}

}  // namespace app
