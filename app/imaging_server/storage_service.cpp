#include "app/imaging_server/storage_service.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

// DCMTK's own headers include this first.
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcostrmf.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmnet/assoc.h>
#include <dcmtk/dcmnet/dimse.h>

#include "assets/import/dicom/transfer_syntax.h"
#include "assets/scan/confined_child.h"

namespace app {
namespace {

constexpr long kLargestUnit_bytes = 65'536;  // of the protocol
constexpr int kLook_ms = 200;

/// What a CT series may be made of (PS3.4 annex B.5).
constexpr std::array<std::string_view, 6> kStorages = {
    "1.2.840.10008.5.1.4.1.1.2",       // CT
    "1.2.840.10008.5.1.4.1.1.2.1",     // enhanced CT
    "1.2.840.10008.5.1.4.1.1.2.2",     // legacy converted enhanced CT
    "1.2.840.10008.5.1.4.1.1.13.1.1",  // X-ray 3D angiographic
    "1.2.840.10008.5.1.4.1.1.13.1.2",  // X-ray 3D craniofacial
    "1.2.840.10008.5.1.4.1.1.7.3"};    // multi-frame greyscale word secondary capture

/// The address of ours from which the server is reached; empty: none.
std::string ownAddress(const ServerAddress& server) {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_socktype = SOCK_DGRAM;
  if (::getaddrinfo(server.host.c_str(), std::to_string(server.port).c_str(), &wanted, &found) != 0) return {};
  std::array<char, NI_MAXHOST> text{};
  const int probe = ::socket(found->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  // Nothing is sent: the system only chooses.
  const bool is_known =
      probe >= 0 && ::connect(probe, found->ai_addr, found->ai_addrlen) == 0 &&
      ::getsockname(probe, reinterpret_cast<sockaddr*>(&own), &size) == 0 &&
      ::getnameinfo(reinterpret_cast<sockaddr*>(&own), size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) == 0;
  if (probe >= 0) ::close(probe);
  ::freeaddrinfo(found);
  return is_known ? text.data() : std::string();
}

int listenOn(const std::string& host, int port) {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_NUMERICHOST;
  if (host.empty() || ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) return -1;
  const int listening = ::socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  constexpr int kWaiting = 4;
  const bool is_open = listening >= 0 && ::setsockopt(listening, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0 &&
                       ::bind(listening, found->ai_addr, found->ai_addrlen) == 0 && ::listen(listening, kWaiting) == 0;
  ::freeaddrinfo(found);
  if (!is_open && listening >= 0) ::close(listening);
  return is_open ? listening : -1;
}

/// Of a title between spaces.
std::string_view trimmed(std::string_view title) {
  title.remove_prefix(std::min(title.find_first_not_of(' '), title.size()));
  return title.substr(0, title.find_last_not_of(' ') + 1);
}

/// Accepts what is proposed as it is, the proposer's first choice.
bool acceptContexts(T_ASC_Association& association) {
  bool is_any = false;
  for (int n = 0; n < ASC_countPresentationContexts(association.params); ++n) {
    T_ASC_PresentationContext one;
    if (ASC_getPresentationContext(association.params, n, &one).bad()) return false;
    const bool is_echo = std::string_view(one.abstractSyntax) == UID_VerificationSOPClass;
    if (!is_echo && std::ranges::find(kStorages, one.abstractSyntax) == kStorages.end()) continue;
    for (int s = 0; s < one.transferSyntaxCount; ++s) {
      if (assets::transferSyntax(one.proposedTransferSyntaxes[s]) == nullptr) continue;
      is_any |=
          ASC_acceptPresentationContext(association.params, one.presentationContextID, one.proposedTransferSyntaxes[s])
              .good();
      break;
    }
  }
  return is_any;
}

bool copyAll(int from, int to, std::uint64_t bytes) {
  std::array<char, 1 << 16> piece;
  for (std::uint64_t at = 0; at < bytes;) {
    const ssize_t count =
        ::pread(from, piece.data(), std::min<std::uint64_t>(piece.size(), bytes - at), static_cast<off_t>(at));
    if (count <= 0) return false;
    for (ssize_t out = 0; out < count;) {
      const ssize_t written = ::write(to, piece.data() + out, static_cast<std::size_t>(count - out));
      if (written <= 0) return false;
      out += written;
    }
    at += static_cast<std::uint64_t>(count);
  }
  return true;
}

}  // namespace

StorageService::StorageService(const ServerAddress& address, const ServerSettings& settings,
                               const ReceiveLimits& limits, DicomTalk& talk, std::function<void()> alive)
    : address_(address), settings_(settings), limits_(limits), talk_(talk), alive_(std::move(alive)) {
  listening_ =
      listenOn(settings.receive_host.empty() ? ownAddress(address) : settings.receive_host, settings.receive_port);
  file_ = ::memfd_create("file", MFD_CLOEXEC);
}

StorageService::~StorageService() {
  if (network_ != nullptr) ASC_dropNetwork(&network_);
  if (file_ >= 0) ::close(file_);
  if (listening_ >= 0) ::close(listening_);
}

void StorageService::run() {
  while (true) {
    pollfd waiting{listening_, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, kLook_ms);
    if (ready > 0) {
      const int connection = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC);
      if (connection >= 0) serve(connection);
    } else if (is_finished_.load(std::memory_order_acquire)) {
      return;
    }
  }
}

void StorageService::serve(int connection) {
  // DCMTK listens on all addresses; given a connection it does not listen.
  dcmExternalSocketHandle.set(connection);
  connection_ = connection;
  const int patience_s = static_cast<int>(limits_.idle_s);
  if (network_ == nullptr && ASC_initializeNetwork(NET_ACCEPTOR, 0, patience_s, &network_).bad()) return;
  T_ASC_Association* association = nullptr;
  OFCondition met = ASC_receiveAssociation(network_, &association, kLargestUnit_bytes, nullptr, nullptr, OFFalse,
                                           DUL_NOBLOCK, patience_s);
  if (met.good() && association != nullptr) {
    if (isWelcome(*association) && acceptContexts(*association)) {
      if (ASC_acknowledgeAssociation(association).good()) answerAll(*association);
    } else {
      const T_ASC_RejectParameters stranger{ASC_RESULT_REJECTEDPERMANENT, ASC_SOURCE_SERVICEUSER,
                                            ASC_REASON_SU_CALLINGAETITLENOTRECOGNIZED};
      ASC_rejectAssociation(association, &stranger);
    }
  }
  if (association != nullptr) {
    ASC_dropSCPAssociation(association);
    ASC_destroyAssociation(&association);
  }
}

bool StorageService::isWelcome(T_ASC_Association& association) const {
  std::array<char, 64> calling{}, called{}, responding{};
  if (ASC_getAPTitles(association.params, calling.data(), calling.size(), called.data(), called.size(),
                      responding.data(), responding.size())
          .bad())
    return false;
  return trimmed(calling.data()) == address_.ae_title && trimmed(called.data()) == settings_.ae_title;
}

void StorageService::hurry() const {
  // Small answers are sent, and small pieces acknowledged, at once: else each file takes a tenth of a second. The
  // system forgets the second.
  const int yes = 1;
  ::setsockopt(connection_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  ::setsockopt(connection_, IPPROTO_TCP, TCP_QUICKACK, &yes, sizeof yes);
}

void StorageService::answerAll(T_ASC_Association& association) {
  while (true) {
    hurry();
    T_ASC_PresentationContextID context = 0;
    T_DIMSE_Message message{};
    const OFCondition heard = DIMSE_receiveCommand(&association, DIMSE_NONBLOCKING, static_cast<int>(limits_.idle_s),
                                                   &context, &message, nullptr);
    if (heard == DUL_PEERREQUESTEDRELEASE) {
      ASC_acknowledgeRelease(&association);
      return;
    }
    bool is_answered = false;
    if (heard.good()) alive_();
    if (heard.good() && message.CommandField == DIMSE_C_STORE_RQ)
      is_answered = take(association, context, message.msg.CStoreRQ);
    else if (heard.good() && message.CommandField == DIMSE_C_ECHO_RQ)
      is_answered = DIMSE_sendEchoResponse(&association, context, &message.msg.CEchoRQ, STATUS_Success, nullptr).good();
    if (!is_answered) {
      ASC_abortAssociation(&association);
      return;
    }
  }
}

void StorageService::progressed(void* service, unsigned long bytes) {
  auto& self = *static_cast<StorageService*>(service);
  if (bytes > self.limits_.file_bytes) {
    self.talk_.outcome.store(DicomOutcome::too_much, std::memory_order_release);
    ::_exit(0);
  }
  self.hurry();
  self.alive_();
}

bool StorageService::take(T_ASC_Association& association, unsigned char context, T_DIMSE_C_StoreRQ& request) {
  // Each move has an association of its own, in which it is the first message.
  constexpr unsigned kOurs = O_STORE_MOVEORIGINATORAETITLE | O_STORE_MOVEORIGINATORID;
  if ((request.opts & kOurs) != kOurs || request.MoveOriginatorID != 1 ||
      trimmed(request.MoveOriginatorApplicationEntityTitle) != settings_.ae_title)
    return false;
  const std::uint32_t n = talk_.files.load(std::memory_order_acquire);
  const std::string path = "/proc/self/fd/" + std::to_string(file_);
  DcmOutputFileStream* out = nullptr;
  if (file_ < 0 || DIMSE_createFilestream(path.c_str(), &request, &association, context, 1, &out).bad()) return false;
  T_ASC_PresentationContextID data_context = 0;
  const OFCondition received =
      DIMSE_receiveDataSetInFile(&association, DIMSE_NONBLOCKING, static_cast<int>(limits_.idle_s), &data_context, out,
                                 &StorageService::progressed, this);
  delete out;
  const off_t bytes = ::lseek(file_, 0, SEEK_END);
  if (received.bad() || bytes <= 0) return false;
  const std::uint64_t all = talk_.bytes.load(std::memory_order_acquire) + static_cast<std::uint64_t>(bytes);
  if (n >= std::min(limits_.files, talk_.file_bytes.size()) || all > limits_.all_bytes) {
    talk_.outcome.store(DicomOutcome::too_much, std::memory_order_release);
    ::_exit(0);
  }
  if (!copyAll(file_, assets::kKeptDescriptor, static_cast<std::uint64_t>(bytes))) return false;
  talk_.file_bytes[n] = static_cast<std::uint64_t>(bytes);
  talk_.bytes.store(all, std::memory_order_release);
  talk_.files.store(n + 1, std::memory_order_release);
  T_DIMSE_C_StoreRSP answer{};
  answer.MessageIDBeingRespondedTo = request.MessageID;
  answer.DimseStatus = STATUS_Success;
  answer.DataSetType = DIMSE_DATASET_NULL;
  OFStandard::strlcpy(answer.AffectedSOPClassUID, request.AffectedSOPClassUID, sizeof answer.AffectedSOPClassUID);
  OFStandard::strlcpy(answer.AffectedSOPInstanceUID, request.AffectedSOPInstanceUID,
                      sizeof answer.AffectedSOPInstanceUID);
  answer.opts = O_STORE_AFFECTEDSOPCLASSUID | O_STORE_AFFECTEDSOPINSTANCEUID;
  return DIMSE_sendStoreResponse(&association, context, &request, &answer, nullptr).good();
}

}  // namespace app
