#include "app/imaging_server/dicom_network.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <new>
#include <utility>

#include "app/imaging_server/dicom_child.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/scan/confined_child.h"

namespace app {
namespace {

/// Memory that the child writes.
class SharedTalk {
 public:
  SharedTalk() {
    at_ = ::mmap(nullptr, sizeof(DicomTalk), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (at_ == MAP_FAILED) throw UsageError("the server cannot be asked: there is no memory; close other programs");
    ::new (at_) DicomTalk();
  }
  ~SharedTalk() { ::munmap(at_, sizeof(DicomTalk)); }
  SharedTalk(const SharedTalk&) = delete;
  SharedTalk& operator=(const SharedTalk&) = delete;

  DicomTalk& talk() const { return *static_cast<DicomTalk*>(at_); }

 private:
  void* at_ = nullptr;
};

std::string sentenceOf(DicomOutcome outcome, const ServerAddress& address, const ServerSettings& settings) {
  const std::string known = "ask who runs it to enter the AE title " + settings.ae_title + " with this machine's " +
                            "address and port " + std::to_string(settings.receive_port);
  switch (outcome) {
    case DicomOutcome::unreachable:
      return "nothing answers as DICOM at port " + std::to_string(address.port) + "; check address and port";
    case DicomOutcome::unwelcome:
      return "it does not talk to " + settings.ae_title + "; " + known;
    case DicomOutcome::no_service:
      return "it cannot be asked for studies (C-FIND, C-MOVE) at this AE title; check the title";
    case DicomOutcome::port_taken:
      return "port " + std::to_string(settings.receive_port) +
             " of this machine cannot be opened to receive; see receive in " + serverSettingsFile();
    case DicomOutcome::not_sent:
      return "it could not send the scan here; " + known;
    case DicomOutcome::too_much:
      return "it sends more than 8 GB or 20,000 files; choose one study with --study, or take its scan on a disc";
    default:
      return "the connection broke; nothing was imported, try again";
  }
}

/// Runs `task` in a child until it ends. Throws UsageError unless it succeeds.
template <class Task>
void runInChild(const ServerAddress& address, const ServerSettings& settings, const DicomTalk& talk, int descriptor,
                const ReportReceived& report, const Task& task) {
  constexpr std::uint64_t kChild_bytes = std::uint64_t{1} << 30;
  const assets::DefaultChildSignal standard;
  const pid_t child = ::fork();
  if (child < 0) throw UsageError(address.shown() + ": no process can be started to ask it; close other programs");
  if (child == 0) {
    assets::confineChild(kChild_bytes, descriptor);
    ::signal(SIGPIPE, SIG_IGN);
    task();
    ::_exit(0);
  }
  int status = 0;
  for (pid_t ended = 0; ended != child;) {
    ended = ::waitpid(child, &status, WNOHANG);
    if (ended < 0 && errno != EINTR) break;
    if (report) report(talk.files.load(std::memory_order_acquire), talk.bytes.load(std::memory_order_acquire));
    const timespec pause{0, 20'000'000};
    ::nanosleep(&pause, nullptr);
  }
  const DicomOutcome outcome = talk.outcome.load(std::memory_order_acquire);
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    throw UsageError(address.shown() + ": it sends nothing any more; nothing was imported, try again");
  if (!WIFEXITED(status) || outcome != DicomOutcome::done)
    throw UsageError(address.shown() + ": " +
                     sentenceOf(WIFEXITED(status) ? outcome : DicomOutcome::broken, address, settings));
}

/// Lines of the child's text.
std::vector<std::string> linesOf(const DicomTalk& talk) {
  const std::size_t size = std::min<std::size_t>(talk.text_size.load(std::memory_order_acquire), talk.text.size());
  std::vector<std::string> lines;
  for (const std::string_view line : split(std::string_view(talk.text.data(), size), '\n'))
    if (!line.empty()) lines.emplace_back(line);
  return lines;
}

}  // namespace

DicomNetwork::DicomNetwork(ServerAddress address, ServerSettings settings, ReceiveLimits limits)
    : address_(std::move(address)), settings_(std::move(settings)), limits_(limits) {}

std::vector<FoundStudy> DicomNetwork::studies(const std::vector<QueryKey>& keys) const {
  const SharedTalk shared;
  DicomTalk& talk = shared.talk();
  const assets::ReceivedFiles unused;
  runInChild(address_, settings_, talk, unused.descriptor(), {},
             [&] { findStudiesInChild(address_, settings_, limits_, keys, talk); });
  std::vector<FoundStudy> studies;
  for (const std::string& line : linesOf(talk)) {
    const std::vector<std::string_view> fields = split(line, '\t');
    if (fields.size() != 5 || !isIdentifier(fields[0]))
      throw UsageError(address_.shown() + ": a study in its list has no identifier");
    FoundStudy study{std::string(fields[0]), shownDate(fields[1]), printable(fields[2]), printable(fields[3]), 0};
    study.images = std::clamp(std::atoi(std::string(fields[4]).c_str()), 0, 1'000'000);
    std::ranges::replace(study.modalities, '\\', ',');
    studies.push_back(std::move(study));
  }
  sortStudies(studies);
  return studies;
}

void DicomNetwork::receive(const std::string& study_uid, assets::ReceivedFiles& files,
                           const ReportReceived& report) const {
  const SharedTalk shared;
  DicomTalk& talk = shared.talk();
  runInChild(address_, settings_, talk, files.descriptor(), report,
             [&] { moveStudyInChild(address_, settings_, limits_, study_uid, talk); });
  const std::size_t count = std::min<std::size_t>(talk.files.load(std::memory_order_acquire), talk.file_bytes.size());
  for (std::size_t n = 0; n < count; ++n) files.takeWritten(talk.file_bytes[n]);
}

}  // namespace app
