#include "app/evaluation/console/page_gate.h"

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(PageGate, OnlyTheLoopbacksOwnNamesAreTheHost) {
  const PageGate gate(8080, false);
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "[::1]:8080"}) EXPECT_TRUE(gate.isOwnHost(host)) << host;
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:80", "evil.example:8080", "localhost.evil.example:8080",
                           "127.0.0.1.evil:8080", "10.0.0.7:8080", "127.0.0.1:18080", ":8080"})
    EXPECT_FALSE(gate.isOwnHost(host)) << host;
}

TEST(PageGate, SharedItIsAnyAddressInNumbersButNoName) {
  const PageGate gate(8443, true);
  for (const char* host : {"10.0.0.7:8443", "[fe80::1]:8443", "localhost:8443"})
    EXPECT_TRUE(gate.isOwnHost(host)) << host;
  for (const char* host : {"station.example:8443", "1.2.3.4.5:8443", "10.0.0.7", "[evil]:8443", "a.b.c.d:8443"})
    EXPECT_FALSE(gate.isOwnHost(host)) << host;
  EXPECT_TRUE(PageGate(443, true).isOwnHost("10.0.0.7"));
}

TEST(PageGate, TheOriginIsThePagesOwn) {
  const PageGate gate(8080, false);
  EXPECT_TRUE(gate.isOwnOrigin("http://127.0.0.1:8080", "127.0.0.1:8080"));
  EXPECT_TRUE(gate.isOwnOrigin("http://localhost:8080", "localhost:8080"));
  for (const char* origin : {"", "null", "https://127.0.0.1:8080", "http://localhost:8080", "http://evil.example",
                             "http://127.0.0.1:8080.evil.example"})
    EXPECT_FALSE(gate.isOwnOrigin(origin, "127.0.0.1:8080")) << origin;
  EXPECT_FALSE(gate.isOwnOrigin("http://evil.example:8080", "evil.example:8080"));
  EXPECT_TRUE(PageGate(8443, true).isOwnOrigin("https://10.0.0.7:8443", "10.0.0.7:8443"));
}

TEST(PageGate, CookieAndTargetAreTakenApart) {
  EXPECT_EQ(PageGate::tokenIn("a=b; __Host-molar=12ab; c=d"), "12ab");
  EXPECT_EQ(PageGate::tokenIn("__Host-molar=12ab"), "12ab");
  EXPECT_EQ(PageGate::tokenIn("x__Host-molar=12ab"), "");
  EXPECT_EQ(PageGate::tokenIn(""), "");
  EXPECT_NE(PageGate::cookieOf("t").find("Secure; HttpOnly; SameSite=Strict"), std::string::npos);
  EXPECT_EQ(PageGate::pathOf("/ws?role=participant&page=a-1"), "/ws");
  EXPECT_EQ(PageGate::valueIn("/ws?role=participant&page=a-1", "page"), "a-1");
  EXPECT_EQ(PageGate::valueIn("/ws?role=participant&page=a-1", "role"), "participant");
  EXPECT_EQ(PageGate::valueIn("/ws?roles=x", "role"), "");
  EXPECT_EQ(PageGate::valueIn("/ws", "role"), "");
}

}  // namespace
}  // namespace app
