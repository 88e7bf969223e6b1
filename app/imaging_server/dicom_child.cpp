#include "app/imaging_server/dicom_child.h"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <thread>

// DCMTK's own headers include this first.
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/scu.h>

#include "app/imaging_server/storage_service.h"
#include "app/imaging_server/study_list.h"
#include "assets/import/dicom/transfer_syntax.h"
#include "assets/scan/confined_child.h"

namespace app {
namespace {

/// At the end of a task in the child: the program reads the outcome.
[[noreturn]] void leave(DicomTalk& talk, DicomOutcome outcome) {
  talk.outcome.store(outcome, std::memory_order_release);
  ::_exit(0);
}

/// Until something new comes.
void waitAtMost(long seconds) {
  const auto ms = static_cast<std::uint32_t>(1000 * seconds);
  assets::limitChildTime(ms, ms);
}

/// A question to the server; answers are counted, and looked at one by one.
class Asking : public DcmSCU {
 public:
  Asking(const ServerAddress& address, const ServerSettings& settings, const ReceiveLimits& limits, const char* service,
         DicomTalk& talk)
      : limits_(limits), service_(service), talk_(talk) {
    setAETitle(settings.ae_title.c_str());
    setPeerAETitle(address.ae_title.c_str());
    setPeerHostName(address.host.c_str());
    setPeerPort(static_cast<Uint16>(address.port));
    constexpr Uint32 kPatience_s = 3600;  // the timer of the process is shorter
    setDIMSEBlockingMode(DIMSE_NONBLOCKING);
    setDIMSETimeout(kPatience_s);
    setACSETimeout(static_cast<Uint32>(limits.idle_s));
    setConnectionTimeout(static_cast<Sint32>(limits.idle_s));
    OFList<OFString> syntaxes;
    syntaxes.push_back(UID_LittleEndianExplicitTransferSyntax);
    syntaxes.push_back(UID_LittleEndianImplicitTransferSyntax);
    addPresentationContext(service, syntaxes);
    waitAtMost(limits.idle_s);
    if (initNetwork().bad()) leave(talk_, DicomOutcome::broken);
    const OFCondition met = negotiateAssociation();
    if (met == NET_EC_NoAcceptablePresentationContexts) leave(talk_, DicomOutcome::no_service);
    if (met == DUL_ASSOCIATIONREJECTED) leave(talk_, DicomOutcome::unwelcome);
    if (met.bad()) leave(talk_, DicomOutcome::unreachable);
    context_ = findAnyPresentationContextID(service, "");
    if (context_ == 0) leave(talk_, DicomOutcome::no_service);
  }

  T_ASC_PresentationContextID context() const { return context_; }
  std::size_t answers() const { return answers_; }

  OFCondition handleFINDResponse(T_ASC_PresentationContextID presentation, QRResponse* response,
                                 OFBool& goes_on) override {
    waitAtMost(limits_.idle_s);
    const OFCondition handled = DcmSCU::handleFINDResponse(presentation, response, goes_on);
    if (++answers_ >= kMostStudies) goes_on = OFFalse;
    return handled;
  }
  OFCondition handleMOVEResponse(T_ASC_PresentationContextID presentation, RetrieveResponse* response,
                                 OFBool& goes_on) override {
    waitAtMost(limits_.idle_s);
    return DcmSCU::handleMOVEResponse(presentation, response, goes_on);
  }

 private:
  const ReceiveLimits& limits_;
  const char* service_;
  DicomTalk& talk_;
  T_ASC_PresentationContextID context_ = 0;
  std::size_t answers_ = 0;
};

/// Answers of a question, which own themselves.
template <class Response>
struct Answers {
  Answers() = default;
  ~Answers() {
    for (auto at = list.begin(); at != list.end(); ++at) delete *at;
  }
  Answers(const Answers&) = delete;
  Answers& operator=(const Answers&) = delete;
  OFList<Response*> list;
};

std::string valueOf(DcmDataset& answer, const DcmTagKey& tag) {
  OFString value;
  answer.findAndGetOFStringArray(tag, value);
  std::string text(value.c_str());
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

/// CT series of a study.
std::vector<std::string> seriesOfStudy(const ServerAddress& address, const ServerSettings& settings,
                                       const ReceiveLimits& limits, const std::string& study_uid, DicomTalk& talk) {
  Asking server(address, settings, limits, UID_FINDStudyRootQueryRetrieveInformationModel, talk);
  DcmDataset question;
  question.putAndInsertString(DCM_QueryRetrieveLevel, "SERIES");
  question.putAndInsertString(DCM_StudyInstanceUID, study_uid.c_str());
  question.putAndInsertString(DCM_Modality, "CT");
  question.putAndInsertString(DCM_SeriesInstanceUID, "");
  Answers<QRResponse> answers;
  if (server.sendFINDRequest(server.context(), &question, &answers.list).bad()) leave(talk, DicomOutcome::broken);
  std::vector<std::string> series;
  for (auto at = answers.list.begin(); at != answers.list.end(); ++at) {
    if ((*at)->m_dataset == nullptr) continue;
    std::string uid = valueOf(*(*at)->m_dataset, DCM_SeriesInstanceUID);
    if (isIdentifier(uid)) series.push_back(std::move(uid));
  }
  server.releaseAssociation();
  return series;
}

}  // namespace

void findStudiesInChild(const ServerAddress& address, const ServerSettings& settings, const ReceiveLimits& limits,
                        const std::vector<QueryKey>& keys, DicomTalk& talk) {
  Asking server(address, settings, limits, UID_FINDStudyRootQueryRetrieveInformationModel, talk);
  DcmDataset question;
  question.putAndInsertString(DCM_QueryRetrieveLevel, "STUDY");
  for (const DcmTagKey& asked : {DCM_StudyInstanceUID, DCM_StudyDate, DCM_StudyDescription, DCM_ModalitiesInStudy,
                                 DCM_NumberOfStudyRelatedInstances})
    question.putAndInsertString(asked, "");
  for (const QueryKey& key : keys) question.putAndInsertString(DcmTagKey(key.group, key.element), key.value.c_str());
  Answers<QRResponse> answers;
  // Some servers welcome everybody and hang up on a stranger's question.
  if (server.sendFINDRequest(server.context(), &question, &answers.list).bad()) leave(talk, DicomOutcome::unwelcome);
  std::string text;
  for (auto at = answers.list.begin(); at != answers.list.end(); ++at) {
    if ((*at)->m_dataset == nullptr) continue;
    DcmDataset& answer = *(*at)->m_dataset;
    const std::string line = valueOf(answer, DCM_StudyInstanceUID) + "\t" + valueOf(answer, DCM_StudyDate) + "\t" +
                             valueOf(answer, DCM_StudyDescription) + "\t" + valueOf(answer, DCM_ModalitiesInStudy) +
                             "\t" + valueOf(answer, DCM_NumberOfStudyRelatedInstances) + "\n";
    if (text.size() + line.size() > talk.text.size()) break;
    text += line;
  }
  std::memcpy(talk.text.data(), text.data(), text.size());
  talk.text_size.store(static_cast<std::uint32_t>(text.size()), std::memory_order_release);
  server.releaseAssociation();
  leave(talk, DicomOutcome::done);
}

void moveStudyInChild(const ServerAddress& address, const ServerSettings& settings, const ReceiveLimits& limits,
                      const std::string& study_uid, DicomTalk& talk) {
  const std::vector<std::string> all = seriesOfStudy(address, settings, limits, study_uid, talk);
  StorageService storage(address, settings, limits, talk, [&] { waitAtMost(limits.idle_s); });
  if (!storage.isOpen()) leave(talk, DicomOutcome::port_taken);
  std::thread receiving([&] { storage.run(); });
  for (const std::string& series : all) {
    Asking server(address, settings, limits, UID_MOVEStudyRootQueryRetrieveInformationModel, talk);
    DcmDataset question;
    question.putAndInsertString(DCM_QueryRetrieveLevel, "SERIES");
    question.putAndInsertString(DCM_StudyInstanceUID, study_uid.c_str());
    question.putAndInsertString(DCM_SeriesInstanceUID, series.c_str());
    Answers<RetrieveResponse> answers;
    const OFCondition moved =
        server.sendMOVERequest(server.context(), settings.ae_title.c_str(), &question, &answers.list);
    if (moved.bad()) leave(talk, DicomOutcome::broken);
    const bool is_done = !answers.list.empty() && answers.list.back()->m_status == STATUS_Success &&
                         answers.list.back()->m_numberOfFailedSubops == 0;
    if (!is_done) leave(talk, DicomOutcome::not_sent);
    server.releaseAssociation();
  }
  storage.finish();
  receiving.join();
  leave(talk, DicomOutcome::done);
}

}  // namespace app
