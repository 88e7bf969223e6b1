#include "app/imaging_server/server_address.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "app/text/parse_number.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr std::string_view kWeb = "https://", kPlainWeb = "http://", kDicom = "dicom://";

bool isHostLetter(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '.' || c == '_';
}

bool isAddressLetter(char c) { return isHostLetter(c) || c == ':'; }

bool isPathLetter(char c) { return isAddressLetter(c) || c == '/' || c == '~' || c == '%' || c == '+'; }

[[noreturn]] void refuse(const std::string& why) { throw UsageError("the server's address: " + why); }

/// Host and port off the front of `rest`.
void takeHost(std::string_view& rest, ServerAddress& address) {
  std::string_view host = rest.substr(0, std::min(rest.find('/'), rest.size()));
  rest.remove_prefix(host.size());
  if (host.find('@') != std::string_view::npos)
    refuse("a name or password does not belong in it; write them into server.toml (molar help import)");
  std::string_view port;
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    if (end == std::string_view::npos) refuse("a bracket is not closed");
    address.host = host.substr(1, end - 1);
    port = host.substr(end + 1);
    if (!std::ranges::all_of(address.host, isAddressLetter)) refuse("its host has letters that no host has");
  } else {
    address.host = host.substr(0, std::min(host.find(':'), host.size()));
    port = host.substr(address.host.size());
    if (!std::ranges::all_of(address.host, isHostLetter)) refuse("its host has letters that no host has");
  }
  if (address.host.empty()) refuse("it names no host, as in https://pacs.example/dicom-web");
  if (port.empty()) return;
  const auto number = parseNumber<int>(port.substr(1));
  if (!port.starts_with(':') || !number || *number < 1 || *number > 65535) refuse("its port is no number up to 65535");
  address.port = *number;
}

}  // namespace

bool ServerAddress::isThisMachine() const { return host == "localhost" || host == "127.0.0.1" || host == "::1"; }

std::string ServerAddress::url() const {
  const std::string name = host.find(':') == std::string::npos ? host : "[" + host + "]";
  const std::string_view scheme = !is_web ? kDicom : is_encrypted ? kWeb : kPlainWeb;
  return std::string(scheme) + name + ":" + std::to_string(port) + (is_web ? path : "/" + ae_title);
}

bool isServerAddress(const std::string& source) {
  return std::ranges::any_of(std::array{kWeb, kPlainWeb, kDicom},
                             [&](std::string_view scheme) { return source.starts_with(scheme); });
}

ServerAddress serverAddress(const std::string& source) {
  ServerAddress address;
  std::string_view rest = source;
  address.is_web = !rest.starts_with(kDicom);
  address.is_encrypted = rest.starts_with(kWeb);
  address.port = !address.is_web ? 104 : address.is_encrypted ? 443 : 80;
  rest.remove_prefix(rest.find("//") + 2);
  takeHost(rest, address);
  while (rest.ends_with('/')) rest.remove_suffix(1);
  if (address.is_web) {
    if (!address.is_encrypted && !address.isThisMachine()) refuse("http sends patients' data in the clear; give https");
    if (!std::ranges::all_of(rest, isPathLetter)) refuse("its path has letters that it cannot have, such as ? or #");
    address.path = rest;
    return address;
  }
  constexpr std::size_t kLongestTitle = 16;  // PS3.5, AE
  if (!rest.empty()) rest.remove_prefix(1);
  if (rest.empty() || rest.size() > kLongestTitle || !std::ranges::all_of(rest, isHostLetter))
    refuse("give dicom://HOST:PORT/AETITLE, the server's own AE title of at most 16 letters");
  address.ae_title = rest;
  return address;
}

}  // namespace app
