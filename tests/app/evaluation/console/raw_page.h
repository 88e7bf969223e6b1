// A browser's end of the page without a browser: HTTP and WebSocket by hand over a plain socket, so that it can also
// lie, stop reading and hang up. Waits for events with generous limits.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace test {

class RawPage {
 public:
  using Time = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kPatience{60};

  explicit RawPage(int port, int receive_bytes = 0) : port_(port) {
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (receive_bytes > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_bytes, sizeof receive_bytes);
    sockaddr_in to{};
    to.sin_family = AF_INET, to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_open_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  ~RawPage() { hangUp(); }
  RawPage(const RawPage&) = delete;
  RawPage& operator=(const RawPage&) = delete;

  bool isOpen() const { return is_open_; }
  void hangUp() {
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
    is_open_ = false;
  }
  void sendBytes(std::string_view bytes) {
    while (!bytes.empty() && is_open_) {
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) {
        is_open_ = false;
        return;
      }
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
  }
  /// Head and body of one answer; empty: it hung up.
  std::string ask(const std::string& request) {
    sendBytes(request);
    std::size_t head = 0;
    while ((head = in_.find("\r\n\r\n")) == std::string::npos)
      if (!receiveMore(kPatience)) return std::exchange(in_, "");
    std::size_t body = 0;
    if (const std::size_t length = in_.find("Content-Length: "); length < head)
      body = static_cast<std::size_t>(std::strtoul(in_.c_str() + length + 16, nullptr, 10));
    while (in_.size() < head + 4 + body)
      if (!receiveMore(kPatience)) break;
    std::string answer = in_.substr(0, head + 4 + body);
    in_.erase(0, answer.size());
    return answer;
  }
  std::string get(const std::string& path, const std::string& more = "") {
    return ask("GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) + "\r\n" + more + "\r\n");
  }
  std::string upgrade(const std::string& path, const std::string& origin, const std::string& host) {
    return ask("GET " + path + " HTTP/1.1\r\nHost: " + host +
               "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
               (origin.empty() ? "" : "Origin: " + origin + "\r\n") + "\r\n");
  }
  /// As the page does it. False: refused.
  bool open(const std::string& path = "/ws?role=evaluator") {
    const std::string host = "127.0.0.1:" + std::to_string(port_);
    return upgrade(path, "http://" + host, host).starts_with("HTTP/1.1 101");
  }

  void sayText(std::string_view text, int opcode = 1) {
    std::string frame(1, static_cast<char>(0x80 | opcode));
    if (text.size() < 126) {
      frame += static_cast<char>(0x80 | static_cast<int>(text.size()));
    } else if (text.size() < 65536) {
      frame += static_cast<char>(0x80 | 126);
      frame += static_cast<char>(text.size() >> 8U), frame += static_cast<char>(text.size() & 0xFFU);
    } else {
      frame += static_cast<char>(0x80 | 127);
      for (int shift = 56; shift >= 0; shift -= 8) frame += static_cast<char>(text.size() >> shift & 0xFFU);
    }
    // The mask is 0: the text is as it is.
    frame += std::string(4, '\0');
    frame += text;
    sendBytes(frame);
  }
  void say(const nlohmann::json& message) { sayText(message.dump()); }

  struct Message {
    int opcode = 0;
    std::string bytes;
    nlohmann::json json() const { return nlohmann::json::parse(bytes, nullptr, false); }
  };
  /// None: nothing came, or it hung up (isOpen()).
  std::optional<Message> hear(std::chrono::milliseconds patience) {
    const auto until = Time::now() + patience;
    for (;;) {
      if (auto message = taken()) {
        if (message->opcode == 9) {
          sayText(message->bytes, 10);
          continue;
        }
        if (message->opcode == 8) is_open_ = false;
        if (message->opcode == 1 || message->opcode == 2) return message;
        continue;
      }
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Time::now());
      if (!is_open_ || left.count() <= 0 || !receiveMore(left)) return {};
    }
  }
  /// The first that is so, others are passed over; none: it did not come.
  std::optional<nlohmann::json> await(const std::function<bool(const nlohmann::json&)>& is_so,
                                      std::chrono::milliseconds patience = kPatience) {
    const auto until = Time::now() + patience;
    while (Time::now() < until) {
      const auto message = hear(std::chrono::duration_cast<std::chrono::milliseconds>(until - Time::now()));
      if (!message) return {};
      if (message->opcode != 1) continue;
      auto told = message->json();
      if (told.is_object() && is_so(told)) return told;
    }
    return {};
  }
  std::optional<nlohmann::json> awaitState(const std::function<bool(const nlohmann::json&)>& is_so,
                                           std::chrono::milliseconds patience = kPatience) {
    return await([&](const auto& told) { return told["kind"] == "state" && is_so(told); }, patience);
  }

 private:
  bool receiveMore(std::chrono::milliseconds patience) {
    pollfd input{socket_, POLLIN, 0};
    if (::poll(&input, 1, static_cast<int>(patience.count())) != 1) return false;
    char bytes[65536];
    const ssize_t got = ::recv(socket_, bytes, sizeof bytes, 0);
    if (got <= 0) {
      is_open_ = false;
      return false;
    }
    in_.append(bytes, static_cast<std::size_t>(got));
    return true;
  }
  std::optional<Message> taken() {
    if (in_.size() < 2) return {};
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(in_[at]); };
    std::size_t size = byte(1) & 0x7FU, head = 2;
    if (size == 126) head = 4;
    if (size == 127) head = 10;
    if (in_.size() < head) return {};
    if (head > 2) {
      size = 0;
      for (std::size_t n = 2; n < head; ++n) size = size << 8U | byte(n);
    }
    if (in_.size() < head + size) return {};
    Message message{byte(0) & 0x0F, in_.substr(head, size)};
    in_.erase(0, head + size);
    return message;
  }

  int port_, socket_ = -1;
  bool is_open_ = false;
  std::string in_;
};

}  // namespace test
