#include "app/imaging_server/server_settings.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>

#include "app/text/parse_number.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

/// None: there is no such file.
std::optional<assets::TomlReader> ownFile(const std::string& path) {
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) return std::nullopt;
  constexpr mode_t kOthers = 0077;
  if ((facts.st_mode & kOthers) != 0 || facts.st_uid != ::geteuid())
    throw UsageError(path + ": it holds passwords and others may read it; chmod 600 it");
  return assets::TomlReader::fromFile(path);
}

/// HOST:PORT.
void takeReceive(const std::string& text, const assets::TomlReader& file, const std::string& table,
                 ServerSettings& settings) {
  if (text.empty()) return;
  const std::size_t colon = text.rfind(':');
  const auto port =
      colon == std::string::npos ? std::nullopt : parseNumber<int>(std::string_view(text).substr(colon + 1));
  if (!port || *port < 1 || *port > 65535 || colon == 0)
    file.refuse(table, "receive", "give an address of this machine and a port, as in 192.168.1.20:11112");
  settings.receive_host = text.substr(0, colon);
  settings.receive_port = *port;
}

}  // namespace

std::string serverSettingsFile() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config != '\0') return std::string(config) + "/molar/server.toml";
  const char* home = std::getenv("HOME");
  return std::string(home != nullptr ? home : ".") + "/.config/molar/server.toml";
}

ServerSettings serverSettings(const ServerAddress& address) {
  constexpr std::size_t kMostServers = 32;
  ServerSettings settings;
  if (auto file = ownFile(serverSettingsFile())) {
    const std::size_t count = file->tables("server", 0, kMostServers);
    for (std::size_t n = 1; n <= count; ++n) {
      const std::string table = "server." + std::to_string(n);
      ServerSettings one;
      const std::string url = file->text(table, "url");
      if (!isServerAddress(url)) file->refuse(table, "url", "it begins with https:// or dicom://");
      one.user = file->text(table, "user", "");
      one.password = file->text(table, "password", "");
      one.token = file->text(table, "token", "");
      one.ca_file = file->text(table, "ca_file", "");
      one.ae_title = file->text(table, "ae_title", one.ae_title);
      if (one.ae_title.empty() || one.ae_title.size() > 16) file->refuse(table, "ae_title", "1 to 16 letters");
      takeReceive(file->text(table, "receive", ""), *file, table, one);
      if (serverAddress(url).url() == address.url()) settings = one;
    }
    file->refuseUnknownKeys();
  }
  if (const char* token = std::getenv("MOLAR_DICOMWEB_TOKEN"); token != nullptr && address.is_web && *token != '\0')
    settings.token = token;
  // No program that is started later finds it.
  ::unsetenv("MOLAR_DICOMWEB_TOKEN");
  if (settings.token.find_first_of("\r\n") != std::string::npos)
    throw UsageError("the token of " + address.shown() + " has more than one line; give it alone");
  return settings;
}

}  // namespace app
