// Debian's Orthanc on this machine: DICOMweb over https (tls_door.h) with a certificate of its own, one user, and the
// DICOM port; everything it stores lies in the folder it is given, and goes with it.
#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>

#include "tests/app/imaging_server/tls_door.h"

namespace tests {

/// That nobody listens on now.
inline int freePort() {
  const int probe = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof own;
  ::bind(probe, reinterpret_cast<sockaddr*>(&own), sizeof own);
  ::getsockname(probe, reinterpret_cast<sockaddr*>(&own), &size);
  ::close(probe);
  return ntohs(own.sin_port);
}

class Orthanc {
 public:
  static constexpr const char* kProgram = "/usr/sbin/Orthanc";
  static constexpr const char* kPlugin = "/usr/share/orthanc/plugins/libOrthancDicomWeb.so";

  /// What is missing to run it; empty: nothing.
  static std::string missing() {
    for (const char* file : {kProgram, kPlugin, "/usr/bin/openssl"})
      if (!std::filesystem::exists(file)) return file;
    return {};
  }

  explicit Orthanc(const std::filesystem::path& folder) : folder_(folder) {
    std::filesystem::create_directories(folder_ / "store");
    run("openssl req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=localhost "
        "-addext subjectAltName=DNS:localhost,IP:127.0.0.1 -keyout '" +
        at("key.pem") + "' -out '" + at("certificate.pem") + "'");
    std::ofstream(at("conf.json"))
        << "{\"Name\":\"test\",\"StorageDirectory\":\"" << at("store") << "\",\"IndexDirectory\":\"" << at("store")
        << "\",\"HttpPort\":" << inner_port_ << ",\"DicomPort\":" << dicom_port
        << ",\"DicomAet\":\"PACS\",\"DicomCheckCalledAet\":true,\"RemoteAccessAllowed\":false,"
           "\"AuthenticationEnabled\":true,\"RegisteredUsers\":{\"reader\":\"open sesame\"},\"Plugins\":[\""
        << kPlugin << "\"],\"DicomWeb\":{\"Enable\":true,\"Root\":\"/dicom-web/\"},"
        << "\"DicomModalities\":{\"molar\":[\"MOLAR\",\"127.0.0.1\"," << receive_port
        << "]},\"DicomAlwaysAllowEcho\":true,\"DicomAlwaysAllowStore\":true,\"DicomAlwaysAllowFind\":false,"
           "\"DicomAlwaysAllowMove\":false}\n";
    start();
    door_ = std::make_unique<TlsDoor>(inner_port_, at("certificate.pem"), at("key.pem"));
  }
  ~Orthanc() {
    door_.reset();
    if (process_ <= 0) return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }
  Orthanc(const Orthanc&) = delete;
  Orthanc& operator=(const Orthanc&) = delete;

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::string url() const { return "https://localhost:" + std::to_string(webPort()) + "/dicom-web"; }
  std::string dicomUrl() const { return "dicom://127.0.0.1:" + std::to_string(dicom_port) + "/PACS"; }
  /// Gives it every file of a folder, by its own REST interface. False: it did not take one.
  bool take(const std::filesystem::path& folder) const {
    const std::string head =
        "POST /instances HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n"
        "Authorization: Basic cmVhZGVyOm9wZW4gc2VzYW1l\r\nContent-Length: ";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      std::ostringstream file;
      file << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      const std::string bytes = file.str();
      if (!answers(head + std::to_string(bytes.size()) + "\r\n\r\n" + bytes).starts_with("HTTP/1.1 200")) return false;
    }
    return true;
  }

  int webPort() const { return door_->port(); }
  const int dicom_port = freePort(), receive_port = freePort();

 private:
  std::string answers(const std::string& request) const {
    const int line = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in there{};
    there.sin_family = AF_INET;
    there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    there.sin_port = htons(static_cast<std::uint16_t>(inner_port_));
    std::string answer;
    if (::connect(line, reinterpret_cast<sockaddr*>(&there), sizeof there) == 0 &&
        ::send(line, request.data(), request.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(request.size())) {
      char piece[4096];
      for (ssize_t count; (count = ::recv(line, piece, sizeof piece, 0)) > 0;)
        answer.append(piece, static_cast<std::size_t>(count));
    }
    ::close(line);
    return answer;
  }

  bool run(const std::string& line) const { return std::system((line + " >>'" + at("log") + "' 2>&1").c_str()) == 0; }

  void start() {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", 0, 0);
    posix_spawn_file_actions_addopen(&files, 1, at("orthanc.log").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&files, 1, 2);
    std::string program = kProgram, settings = at("conf.json");
    char* const words[] = {program.data(), settings.data(), nullptr};
    if (::posix_spawn(&process_, kProgram, &files, nullptr, words, environ) != 0) process_ = 0;
    posix_spawn_file_actions_destroy(&files);
    // Until its DICOM port answers.
    for (int tries = 0; tries < 600; ++tries) {
      const int probe = ::socket(AF_INET, SOCK_STREAM, 0);
      sockaddr_in there{};
      there.sin_family = AF_INET;
      there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      there.sin_port = htons(static_cast<std::uint16_t>(dicom_port));
      const bool is_there = ::connect(probe, reinterpret_cast<sockaddr*>(&there), sizeof there) == 0;
      ::close(probe);
      if (is_there) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  std::filesystem::path folder_;
  const int inner_port_ = freePort();
  std::unique_ptr<TlsDoor> door_;
  pid_t process_ = 0;
};

}  // namespace tests
