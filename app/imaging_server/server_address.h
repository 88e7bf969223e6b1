// Where an imaging server is: https://HOST[:PORT]/PATH of DICOMweb, or dicom://HOST:PORT/AETITLE. Plain http is for
// this machine alone; a name or password in an address is refused. Any thread.
#pragma once

#include <string>

namespace app {

struct ServerAddress {
  bool is_web = true;
  bool is_encrypted = true;
  std::string host;  ///< of IPv6 without its brackets
  int port = 443;
  std::string path;      ///< of DICOMweb: "/dicom-web", without a slash at its end
  std::string ae_title;  ///< of the DICOM route

  bool isThisMachine() const;
  /// "https://host:443/dicom-web".
  std::string url() const;
  /// "server host", for messages.
  std::string shown() const { return "server " + host; }
};

/// Whether a source is meant as a server: https:, http: or dicom: before two slashes.
bool isServerAddress(const std::string& source);

/// Throws UsageError.
ServerAddress serverAddress(const std::string& source);

}  // namespace app
