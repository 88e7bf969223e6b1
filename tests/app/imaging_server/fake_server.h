// An HTTP server on this machine that answers as a test says, badly for the most part: one connection at a time, on a
// free port, until it is destroyed.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace tests {

class FakeServer {
 public:
  /// A connection: false when the other side has gone.
  class Line {
   public:
    Line(int connection, const std::atomic<bool>& is_over) : connection_(connection), is_over_(is_over) {}
    bool say(const std::string& text) {
      for (std::size_t at = 0; at < text.size();) {
        if (is_over_) return false;
        pollfd ready{connection_, POLLOUT, 0};
        if (::poll(&ready, 1, 100) <= 0) continue;
        const ssize_t count = ::send(connection_, text.data() + at, text.size() - at, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count <= 0) return false;
        at += static_cast<std::size_t>(count);
      }
      return true;
    }
    /// Nothing is said for a while.
    bool rest(std::chrono::milliseconds time) {
      const auto end = std::chrono::steady_clock::now() + time;
      while (std::chrono::steady_clock::now() < end) {
        if (is_over_) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
      return true;
    }

   private:
    int connection_;
    const std::atomic<bool>& is_over_;
  };
  /// The request's first line and head, and where to answer.
  using Answer = std::function<void(const std::string& request, Line& line)>;

  explicit FakeServer(Answer answer) : answer_(std::move(answer)) {
    listening_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof own;
    ::bind(listening_, reinterpret_cast<sockaddr*>(&own), sizeof own);
    ::listen(listening_, 8);
    ::getsockname(listening_, reinterpret_cast<sockaddr*>(&own), &size);
    port_ = ntohs(own.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~FakeServer() {
    is_over_ = true;
    thread_.join();
    ::close(listening_);
  }
  FakeServer(const FakeServer&) = delete;
  FakeServer& operator=(const FakeServer&) = delete;

  int port() const { return port_; }
  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/dicom-web"; }
  std::vector<std::string> requests() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return requests_;
  }

  static std::string head(const std::string& status, const std::string& type) {
    return "HTTP/1.1 " + status + "\r\nContent-Type: " + type + "\r\nConnection: close\r\n\r\n";
  }

 private:
  void run() {
    while (!is_over_) {
      pollfd waiting{listening_, POLLIN, 0};
      if (::poll(&waiting, 1, 20) <= 0) continue;
      const int connection = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC);
      if (connection < 0) continue;
      std::string request;
      char piece[4096];
      while (request.find("\r\n\r\n") == std::string::npos) {
        const ssize_t count = ::recv(connection, piece, sizeof piece, 0);
        if (count <= 0) break;
        request.append(piece, static_cast<std::size_t>(count));
        if (request.front() == '\x16') break;  // somebody wants to encrypt
      }
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        requests_.push_back(request);
      }
      Line line(connection, is_over_);
      answer_(request, line);
      ::shutdown(connection, SHUT_WR);
      ::close(connection);
    }
  }

  Answer answer_;
  std::atomic<bool> is_over_{false};
  int listening_ = -1, port_ = 0;
  mutable std::mutex mutex_;
  std::vector<std::string> requests_;
  std::thread thread_;
};

}  // namespace tests
