// An imaging server by the DICOM protocol (PS3.4 annexes B and C, PS3.7): C-FIND for its studies, C-MOVE of a study's
// CT series to a storage service of our own, which is open as long as the move takes, on one address, and takes files
// of that move alone, in every packing that is read here. Not encrypted. DCMTK, its only user, runs in a child process
// without the program's files, limited in memory, and ended after so long without anything new. Main thread; blocks.
#pragma once

#include <vector>

#include "app/imaging_server/multipart_reader.h"
#include "app/imaging_server/server_address.h"
#include "app/imaging_server/server_settings.h"
#include "app/imaging_server/study_list.h"
#include "app/imaging_server/study_query.h"
#include "app/imaging_server/web_server.h"

namespace app {

class DicomNetwork {
 public:
  DicomNetwork(ServerAddress address, ServerSettings settings, ReceiveLimits limits = {});

  /// All throw UsageError of one line where the server cannot be had or refuses.
  std::vector<FoundStudy> studies(const std::vector<QueryKey>& keys) const;
  /// All CT series of a study.
  void receive(const std::string& study_uid, assets::ReceivedFiles& files, const ReportReceived& report = {}) const;

 private:
  ServerAddress address_;
  ServerSettings settings_;
  ReceiveLimits limits_;
};

}  // namespace app
