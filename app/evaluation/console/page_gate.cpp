#include "app/evaluation/console/page_gate.h"

#include <algorithm>

namespace app {
namespace {

constexpr std::string_view kCookieName = "__Host-molar=";

bool isInNumbers(std::string_view host) {
  if (host.starts_with('[') && host.ends_with(']')) {
    host = host.substr(1, host.size() - 2);
    return host.find(':') != std::string_view::npos &&
           host.find_first_not_of("0123456789abcdefABCDEF:.") == std::string_view::npos;
  }
  return std::ranges::count(host, '.') == 3 && host.find_first_not_of("0123456789.") == std::string_view::npos;
}

}  // namespace

bool PageGate::isOwnHost(std::string_view host) const {
  const std::string port = ":" + std::to_string(port_);
  if (host.ends_with(port))
    host.remove_suffix(port.size());
  else if (constexpr int kHttp = 80, kHttps = 443; port_ != (is_shared_ ? kHttps : kHttp))
    return false;
  if (host == "localhost" || host == "127.0.0.1" || host == "[::1]") return true;
  return is_shared_ && isInNumbers(host);
}

bool PageGate::isOwnOrigin(std::string_view origin, std::string_view host) const {
  return isOwnHost(host) && origin == std::string(is_shared_ ? "https://" : "http://") + std::string(host);
}

std::string PageGate::tokenIn(std::string_view cookies) {
  while (!cookies.empty()) {
    const std::size_t end = std::min(cookies.find(';'), cookies.size());
    std::string_view one = cookies.substr(0, end);
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
    while (one.starts_with(' ')) one.remove_prefix(1);
    if (one.starts_with(kCookieName)) return std::string(one.substr(kCookieName.size()));
  }
  return "";
}

std::string PageGate::cookieOf(std::string_view token) {
  return std::string(kCookieName) + std::string(token) + "; Path=/; Secure; HttpOnly; SameSite=Strict; Max-Age=43200";
}

std::string_view PageGate::pathOf(std::string_view target) { return target.substr(0, target.find('?')); }

std::string PageGate::valueIn(std::string_view target, std::string_view key) {
  const std::size_t begin = target.find('?');
  if (begin == std::string_view::npos) return "";
  std::string_view rest = target.substr(begin + 1);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('&'), rest.size());
    const std::string_view one = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (one.size() > key.size() && one.starts_with(key) && one[key.size()] == '=')
      return std::string(one.substr(key.size() + 1));
  }
  return "";
}

const std::vector<std::pair<std::string_view, std::string_view>>& PageGate::headers() {
  static const std::vector<std::pair<std::string_view, std::string_view>> kHeaders{
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; media-src blob:; "
       "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'self'; "
       "require-trusted-types-for 'script'"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Permissions-Policy", "camera=(), microphone=(), geolocation=()"},
      {"Cache-Control", "no-store"}};
  return kHeaders;
}

}  // namespace app
