// Encryption in front of a server of this machine that speaks in the clear: what comes in over TLS goes on to its port,
// and back. (Orthanc's own ends with a segmentation fault in Debian 12.) One connection at a time.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <string>
#include <thread>

namespace tests {

class TlsDoor {
 public:
  TlsDoor(int inner_port, const std::string& certificate, const std::string& key) : inner_port_(inner_port) {
    context_ = SSL_CTX_new(TLS_server_method());
    SSL_CTX_use_certificate_file(context_, certificate.c_str(), SSL_FILETYPE_PEM);
    SSL_CTX_use_PrivateKey_file(context_, key.c_str(), SSL_FILETYPE_PEM);
    listening_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in own = here(0);
    socklen_t size = sizeof own;
    ::bind(listening_, reinterpret_cast<sockaddr*>(&own), sizeof own);
    ::listen(listening_, 8);
    ::getsockname(listening_, reinterpret_cast<sockaddr*>(&own), &size);
    port_ = ntohs(own.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~TlsDoor() {
    is_over_ = true;
    thread_.join();
    ::close(listening_);
    SSL_CTX_free(context_);
  }
  TlsDoor(const TlsDoor&) = delete;
  TlsDoor& operator=(const TlsDoor&) = delete;

  int port() const { return port_; }

 private:
  static sockaddr_in here(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    return address;
  }

  void run() {
    while (!is_over_) {
      pollfd waiting{listening_, POLLIN, 0};
      if (::poll(&waiting, 1, 20) <= 0) continue;
      const int outer = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC);
      if (outer < 0) continue;
      SSL* const tls = SSL_new(context_);
      SSL_set_fd(tls, outer);
      const int inner = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
      sockaddr_in there = here(inner_port_);
      if (SSL_accept(tls) == 1 && ::connect(inner, reinterpret_cast<sockaddr*>(&there), sizeof there) == 0)
        relay(tls, outer, inner);
      SSL_free(tls);
      ::close(inner);
      ::close(outer);
    }
  }

  void relay(SSL* tls, int outer, int inner) const {
    std::array<char, 16'384> piece;
    while (!is_over_) {
      std::array<pollfd, 2> sides{{{outer, POLLIN, 0}, {inner, POLLIN, 0}}};
      if (SSL_pending(tls) == 0 && ::poll(sides.data(), sides.size(), 20) <= 0) continue;
      if (SSL_pending(tls) > 0 || sides[0].revents != 0) {
        const int count = SSL_read(tls, piece.data(), static_cast<int>(piece.size()));
        if (count <= 0 || ::send(inner, piece.data(), static_cast<std::size_t>(count), MSG_NOSIGNAL) != count) return;
      }
      if (sides[1].revents != 0) {
        const ssize_t count = ::recv(inner, piece.data(), piece.size(), 0);
        if (count <= 0) {
          SSL_shutdown(tls);
          return;
        }
        if (SSL_write(tls, piece.data(), static_cast<int>(count)) != count) return;
      }
    }
  }

  int inner_port_;
  std::atomic<bool> is_over_{false};
  SSL_CTX* context_ = nullptr;
  int listening_ = -1, port_ = 0;
  std::thread thread_;
};

}  // namespace tests
