// An imaging server by DICOMweb (PS3.18): QIDO-RS for its studies, WADO-RS for a study's CT series, in whatever packing
// it has them. https with its certificate checked, http for this machine alone; no redirection is followed, nothing but
// those requests is sent. The only user of libcurl. One thread; blocks while the server answers.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/imaging_server/multipart_reader.h"
#include "app/imaging_server/server_address.h"
#include "app/imaging_server/server_settings.h"
#include "app/imaging_server/study_list.h"
#include "app/imaging_server/study_query.h"

namespace app {

/// Files and bytes so far.
using ReportReceived = std::function<void(std::size_t files, std::uint64_t bytes)>;

class WebServer {
 public:
  WebServer(ServerAddress address, ServerSettings settings, ReceiveLimits limits = {});
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// All throw UsageError of one line where the server cannot be had, or answers what it should not.
  std::vector<FoundStudy> studies(const std::vector<QueryKey>& keys);
  /// All CT series of a study.
  void receive(const std::string& study_uid, assets::ReceivedFiles& files, const ReportReceived& report = {});

 private:
  struct Connection;
  struct Answer;

  std::string list(const std::string& path);
  void get(const std::string& path, Answer& answer);

  ServerAddress address_;
  ServerSettings settings_;
  ReceiveLimits limits_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace app
