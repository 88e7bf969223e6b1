// A page that other machines may reach: TLS 1.3 alone, and nothing but the question for the code without a token.

#include <openssl/ssl.h>
#include <signal.h>

#include <atomic>
#include <optional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "app/evaluation/console/page_address.h"
#include "app/evaluation/console/page_link.h"
#include "app/evaluation/console/page_pictures.h"
#include "app/evaluation/console/pairing.h"
#include "tests/app/evaluation/console/raw_page.h"

namespace app {
namespace {

/// One request over TLS; empty: no connection.
std::string askedOverTls(int port, const std::string& request, int most_version = 0) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET, to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string answer;
  SSL_CTX* const context = SSL_CTX_new(TLS_client_method());
  SSL_CTX_set_max_proto_version(context, most_version);
  SSL* const tls = SSL_new(context);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0 && SSL_set_fd(tls, socket) == 1 &&
      SSL_connect(tls) == 1 && SSL_write(tls, request.data(), static_cast<int>(request.size())) > 0) {
    char bytes[16384];
    std::size_t whole = std::string::npos;
    for (int got = 0; answer.size() < whole && (got = SSL_read(tls, bytes, sizeof bytes)) > 0;) {
      answer.append(bytes, static_cast<std::size_t>(got));
      const std::size_t head = answer.find("\r\n\r\n"), length = answer.find("Content-Length: ");
      if (head != std::string::npos && length < head)
        whole = head + 4 + static_cast<std::size_t>(std::strtoul(answer.c_str() + length + 16, nullptr, 10));
    }
  }
  SSL_free(tls);
  SSL_CTX_free(context);
  ::close(socket);
  return answer;
}

class PageShareTest : public testing::Test {
 protected:
  void SetUp() override {
    PageLink::Parts parts;
    parts.listener = address_.descriptor(), parts.pictures = pictures_.memory(), parts.bell = pictures_.bell();
    parts.options = pairing_.options(), parts.handed = pairing_.descriptors(), parts.greeting = pairing_.greeting();
    parts.program = MOLAR_PROGRAM;
    link_.emplace(std::move(parts));
    session_ = std::thread([this] {
      while (!is_over_) {
        for (const PageLink::Heard& one : link_->take())
          if (const auto* asked = std::get_if<PagePairs>(&one.word)) {
            link_->answer(pairing_.answerTo(*asked));
            link_->greet(pairing_.greeting());
          }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    });
  }
  void TearDown() override {
    is_over_ = true;
    session_.join();
  }
  std::string own() const { return "127.0.0.1:" + std::to_string(address_.port()); }
  std::string get(const std::string& path, const std::string& token = "", int most_version = 0) const {
    return askedOverTls(address_.port(),
                        "GET " + path + " HTTP/1.1\r\nHost: " + own() + "\r\n" +
                            (token.empty() ? "" : "Cookie: __Host-molar=" + token + "\r\n") + "\r\n",
                        most_version);
  }
  std::string pair(const std::string& digits, const std::string& more) const {
    return askedOverTls(address_.port(), "POST /pair HTTP/1.1\r\nHost: " + own() + "\r\n" + more +
                                             "Content-Length: " + std::to_string(digits.size()) + "\r\n\r\n" + digits);
  }
  static bool is(const std::string& answer, int status) {
    return answer.starts_with("HTTP/1.1 " + std::to_string(status));
  }

  PageAddress address_{"127.0.0.1:0", true};
  PicturesOut pictures_;
  Pairing pairing_{true};
  std::optional<PageLink> link_;
  std::thread session_;
  std::atomic<bool> is_over_{false};
};

TEST_F(PageShareTest, WithoutTheCodeThereIsOnlyTheQuestionForIt) {
  const std::string page = get("/");
  EXPECT_TRUE(is(page, 200)) << page.substr(0, 200);
  EXPECT_NE(page.find("pair.js"), std::string::npos);
  EXPECT_TRUE(is(get("/main.js"), 403));
  EXPECT_TRUE(is(get("/index.html"), 403));
  EXPECT_TRUE(is(get("/main.js", std::string(64, '0')), 403));
  EXPECT_TRUE(is(askedOverTls(address_.port(), "GET /ws HTTP/1.1\r\nHost: " + own() + "\r\nOrigin: https://" + own() +
                                                   "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                                                   "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
                                                   "dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"),
                 403));
  // Neither an older TLS nor none.
  EXPECT_EQ(get("/", "", TLS1_2_VERSION), "");
  test::RawPage plain(address_.port());
  EXPECT_EQ(plain.get("/").find("HTTP/1.1 200"), std::string::npos);
}

TEST_F(PageShareTest, TheCodeOpensItAndFiveWrongOnesCloseIt) {
  const std::string origin = "Origin: https://" + own() + "\r\n", header = "X-Molar: 1\r\n";
  // Another site cannot ask in a browser's name.
  EXPECT_TRUE(is(pair(pairing_.digits(), header), 403));
  EXPECT_TRUE(is(pair(pairing_.digits(), header + "Origin: https://evil.example\r\n"), 403));
  EXPECT_TRUE(is(pair(pairing_.digits(), origin), 403));
  const std::string paired = pair(pairing_.digits(), origin + header);
  ASSERT_TRUE(is(paired, 200)) << paired;
  const std::size_t at = paired.find("__Host-molar=");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NE(paired.find("Secure; HttpOnly; SameSite=Strict"), std::string::npos);
  const std::string token = paired.substr(at + 13, 64);
  EXPECT_TRUE(is(get("/main.js", token), 200));
  // Another process knows it as well.
  ::kill(link_->figures().process, SIGKILL);
  EXPECT_TRUE(is(get("/main.js", token), 200));
  const std::string wrong = pairing_.digits() == "000000" ? "000001" : "000000";
  for (int n = 0; n < Pairing::kTries; ++n) EXPECT_TRUE(is(pair(wrong, origin + header), 403));
  EXPECT_TRUE(is(pair(pairing_.digits(), origin + header), 403));
  EXPECT_TRUE(is(get("/main.js", token), 200));
}

}  // namespace
}  // namespace app
