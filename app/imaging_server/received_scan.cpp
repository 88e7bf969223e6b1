#include "app/imaging_server/received_scan.h"

#include <unistd.h>

#include <cstdio>
#include <vector>

#include "app/imaging_server/dicom_network.h"
#include "app/imaging_server/web_server.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

bool isOnTerminal() { return ::isatty(STDERR_FILENO) == 1; }

std::string counted(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// Date and description are for the eyes at the terminal.
void listStudies(const std::vector<FoundStudy>& studies) {
  for (std::size_t n = 0; n < studies.size(); ++n) {
    const FoundStudy& study = studies[n];
    std::string line = "  " + std::to_string(n + 1) + ")";
    if (isOnTerminal())
      line += " " + (study.date.empty() ? "no date" : study.date) + "  " + study.modalities + "  " + study.description;
    if (study.images > 0) line += "  (" + counted(study.images, "image") + ")";
    std::fprintf(stderr, "%s\n", line.c_str());
  }
}

const FoundStudy& chosenStudy(const std::vector<FoundStudy>& studies, const ServerQuestion& question,
                              const std::string& where) {
  if (studies.empty()) throw UsageError(where + ": it has no study for this --find; check the value");
  const int count = static_cast<int>(studies.size());
  if (question.study) {
    if (*question.study > count)
      throw UsageError(where + ": it has " + (count == 1 ? "1 study" : std::to_string(count) + " studies") +
                       " for this --find, so there is no --study " + std::to_string(*question.study));
    return studies[static_cast<std::size_t>(*question.study - 1)];
  }
  if (count > 1 || isOnTerminal()) listStudies(studies);
  if (count > 1)
    throw UsageError(where + ": it has " + std::to_string(count) + " studies for this --find; choose one with --study");
  return studies.front();
}

/// A line that is written over, on a terminal.
class Progress {
 public:
  ~Progress() {
    if (is_shown_) std::fputs("\r\033[K", stderr);
  }
  void show(std::size_t files, std::uint64_t bytes) {
    if (!isOnTerminal() || files == shown_files_) return;
    is_shown_ = true;
    shown_files_ = files;
    std::fprintf(stderr, "\r\033[K  receiving: %zu images, %llu MB", files,
                 static_cast<unsigned long long>(bytes / 1'000'000));
  }

 private:
  bool is_shown_ = false;
  std::size_t shown_files_ = 0;
};

template <class Server>
assets::ReceivedFiles receiveFrom(Server&& server, const std::vector<QueryKey>& keys, const ServerQuestion& question,
                                  const std::string& where) {
  const std::vector<FoundStudy> studies = server.studies(keys);
  const FoundStudy& study = chosenStudy(studies, question, where);
  assets::ReceivedFiles files;
  {
    Progress progress;
    server.receive(study.uid, files, [&](std::size_t count, std::uint64_t bytes) { progress.show(count, bytes); });
  }
  if (files.count() == 0) throw UsageError(where + ": this study has no CT; choose another with --find or --study");
  files.close();
  return files;
}

}  // namespace

assets::ReceivedFiles receiveScan(const std::string& source, const ServerQuestion& question) {
  const ServerAddress address = serverAddress(source);
  if (question.find.empty()) throw UsageError(address.shown() + ": say whose scan it is, as in --find \"PatientID=…\"");
  const std::vector<QueryKey> keys = studyQuery(question.find);
  ServerSettings settings = serverSettings(address);
  if (address.is_web) return receiveFrom(WebServer(address, settings), keys, question, address.shown());
  return receiveFrom(DicomNetwork(address, settings), keys, question, address.shown());
}

}  // namespace app
