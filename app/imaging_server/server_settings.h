// What a server must be told, or told about, and no command line may hold: user and password or a token, the authority
// of its certificate, our own AE title and the address that it sends to. From molar/server.toml in XDG_CONFIG_HOME or
// ~/.config, which its owner alone may read, and MOLAR_DICOMWEB_TOKEN. Never printed. Main thread, start-up.
//
//   [[server]]
//   url = "https://pacs.example/dicom-web"     # as on the command line
//   user = "reader"                            # with a password, or token = "…"
//   password = "…"
//   ca_file = "/etc/ssl/pacs.pem"              # an authority that the system does not know
//
//   [[server]]
//   url = "dicom://pacs.example:104/PACS"
//   ae_title = "MOLAR"                         # ours, as the server knows it
//   receive = "192.168.1.20:11112"             # where it sends to: one address of this machine
#pragma once

#include <string>

#include "app/imaging_server/server_address.h"

namespace app {

struct ServerSettings {
  std::string user, password, token, ca_file;
  std::string ae_title = "MOLAR";
  std::string receive_host;  ///< empty: the address from which the server is reached
  int receive_port = 11112;
};

std::string serverSettingsFile();

/// Throws UsageError or LoadError: others may read the file, or it says something that cannot be.
ServerSettings serverSettings(const ServerAddress& address);

}  // namespace app
