#include "app/imaging_server/web_server.h"

#include <curl/curl.h>

#include <exception>
#include <optional>
#include <utility>

#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr long kConnect_s = 15, kSlowest_bytes_per_s = 1000;
constexpr long kOk = 200, kNoContent = 204, kRedirected = 300, kRefused = 400, kFailed = 500;

/// curl_slist of a request's head.
class HeadLines {
 public:
  HeadLines() = default;
  ~HeadLines() { curl_slist_free_all(lines_); }
  HeadLines(const HeadLines&) = delete;
  HeadLines& operator=(const HeadLines&) = delete;
  void add(const char* line) { lines_ = curl_slist_append(lines_, line); }
  curl_slist* lines() const { return lines_; }

 private:
  curl_slist* lines_ = nullptr;
};

std::string whyNoAnswer(CURLcode code, const ServerAddress& address) {
  switch (code) {
    case CURLE_COULDNT_RESOLVE_HOST:
      return "no such host is known; check the address";
    case CURLE_COULDNT_CONNECT:
      return "nothing answers at port " + std::to_string(address.port) + "; check that it runs, and the port";
    case CURLE_PEER_FAILED_VERIFICATION:
      return "its certificate is not trusted; name its authority's file as ca_file in " + serverSettingsFile();
    case CURLE_SSL_CACERT_BADFILE:
      return "the ca_file in " + serverSettingsFile() + " cannot be read as certificates; check it";
    case CURLE_SSL_CONNECT_ERROR:
      return "no encrypted connection comes about; check that the port speaks https";
    case CURLE_OPERATION_TIMEDOUT:
      return "it sends nothing any more; nothing was imported, try again";
    default:
      return "the connection broke; nothing was imported, try again";
  }
}

std::string whyRefused(long status) {
  const std::string number = " (" + std::to_string(status) + ")";
  if (status == 401 || status == 403)
    return "it takes neither this password nor token" + number + "; see " + serverSettingsFile();
  if (status >= kFailed) return "it failed to answer" + number + "; ask who runs it";
  if (status == 404) return "there is no DICOMweb at this path, or no such study" + number + "; check the address";
  if (status >= kRefused) return "it refuses the question" + number + "; check the address and --find";
  if (status >= kRedirected)
    return "it sends on to another address, which is not followed" + number + "; give that address itself";
  return "it gave an unusual answer" + number + "; check the address";
}

}  // namespace

struct WebServer::Connection {
  Connection() {
    curl_global_init(CURL_GLOBAL_DEFAULT);
    handle = curl_easy_init();
  }
  ~Connection() {
    curl_easy_cleanup(handle);
    curl_global_cleanup();
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  CURL* handle = nullptr;
};

/// Where an answer goes: text, or files. An exception may not cross libcurl; it is kept.
struct WebServer::Answer {
  const char* accept = "";
  std::string where;
  const ReceiveLimits* limits = nullptr;
  CURL* handle = nullptr;
  std::string text;
  assets::ReceivedFiles* files = nullptr;  ///< none: text
  std::optional<MultipartReader> reader{};
  const ReportReceived* report = nullptr;
  std::exception_ptr refused{};

  void take(std::span<const char> bytes) {
    long status = 0;
    curl_easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &status);
    if (status != kOk) return;  // what an error page says is of no use
    if (files == nullptr) {
      if (text.size() + bytes.size() > limits->list_bytes)
        throw UsageError(where + ": its list of studies is endless; ask for fewer with --find");
      text.append(bytes.data(), bytes.size());
      return;
    }
    if (!reader) {
      const char* type = nullptr;
      curl_easy_getinfo(handle, CURLINFO_CONTENT_TYPE, &type);
      reader.emplace(type == nullptr ? "" : type, where, *limits, *files);
    }
    reader->read(bytes);
    if (report != nullptr && *report) (*report)(files->count(), files->bytes());
  }

  static std::size_t arrived(char* bytes, std::size_t size, std::size_t count, void* to) {
    auto& answer = *static_cast<Answer*>(to);
    try {
      answer.take({bytes, size * count});
      return size * count;
    } catch (...) {
      answer.refused = std::current_exception();
      return 0;
    }
  }
};

WebServer::WebServer(ServerAddress address, ServerSettings settings, ReceiveLimits limits)
    : address_(std::move(address)),
      settings_(std::move(settings)),
      limits_(limits),
      connection_(std::make_unique<Connection>()) {
  if (connection_->handle == nullptr) throw UsageError(address_.shown() + ": no connection can be made; restart molar");
}

WebServer::~WebServer() = default;

void WebServer::get(const std::string& path, Answer& answer) {
  CURL* const handle = connection_->handle;
  curl_easy_reset(handle);
  answer.handle = handle;
  answer.where = address_.shown();
  answer.limits = &limits_;
  const std::string url = address_.url() + path;
  curl_easy_setopt(handle, CURLOPT_URL, url.c_str());
  curl_easy_setopt(handle, CURLOPT_PROTOCOLS_STR, address_.is_encrypted ? "https" : "http");
  curl_easy_setopt(handle, CURLOPT_FOLLOWLOCATION, 0L);
  curl_easy_setopt(handle, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(handle, CURLOPT_SSL_VERIFYPEER, 1L);
  curl_easy_setopt(handle, CURLOPT_SSL_VERIFYHOST, 2L);
  if (!settings_.ca_file.empty()) curl_easy_setopt(handle, CURLOPT_CAINFO, settings_.ca_file.c_str());
  if (address_.isThisMachine()) curl_easy_setopt(handle, CURLOPT_NOPROXY, "*");
  curl_easy_setopt(handle, CURLOPT_CONNECTTIMEOUT, kConnect_s);
  curl_easy_setopt(handle, CURLOPT_LOW_SPEED_LIMIT, kSlowest_bytes_per_s);
  curl_easy_setopt(handle, CURLOPT_LOW_SPEED_TIME, limits_.idle_s);
  curl_easy_setopt(handle, CURLOPT_WRITEFUNCTION, &Answer::arrived);
  curl_easy_setopt(handle, CURLOPT_WRITEDATA, &answer);
  if (!settings_.token.empty()) {
    curl_easy_setopt(handle, CURLOPT_HTTPAUTH, CURLAUTH_BEARER);
    curl_easy_setopt(handle, CURLOPT_XOAUTH2_BEARER, settings_.token.c_str());
  } else if (!settings_.user.empty()) {
    curl_easy_setopt(handle, CURLOPT_HTTPAUTH, CURLAUTH_BASIC);
    curl_easy_setopt(handle, CURLOPT_USERNAME, settings_.user.c_str());
    curl_easy_setopt(handle, CURLOPT_PASSWORD, settings_.password.c_str());
  }
  HeadLines head;
  head.add(answer.accept);
  curl_easy_setopt(handle, CURLOPT_HTTPHEADER, head.lines());

  const CURLcode code = curl_easy_perform(handle);
  if (answer.refused) std::rethrow_exception(answer.refused);
  if (code != CURLE_OK) throw UsageError(answer.where + ": " + whyNoAnswer(code, address_));
  long status = 0;
  curl_easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &status);
  if (status == kNoContent) return;  // nothing matches
  if (status != kOk) throw UsageError(answer.where + ": " + whyRefused(status));
  if (answer.reader) answer.reader->finish();
}

std::string WebServer::list(const std::string& path) {
  Answer answer;
  answer.accept = "Accept: application/dicom+json";
  get(path, answer);
  return answer.text.empty() ? "[]" : std::move(answer.text);
}

std::vector<FoundStudy> WebServer::studies(const std::vector<QueryKey>& keys) {
  const std::string fields = "&includefield=00081030&includefield=00080061&includefield=00201208&limit=";
  return studiesOf(list("/studies?" + asUrlQuery(keys) + fields + std::to_string(kMostStudies)), address_.shown());
}

void WebServer::receive(const std::string& study_uid, assets::ReceivedFiles& files, const ReportReceived& report) {
  const std::string study = "/studies/" + study_uid;
  for (const std::string& series : seriesOf(list(study + "/series?Modality=CT"), address_.shown())) {
    Answer answer;
    // The star asks for the packing that it has: without it servers unpack, or fail to.
    answer.accept = "Accept: multipart/related; type=\"application/dicom\"; transfer-syntax=*";
    answer.files = &files;
    answer.report = &report;
    get(study + "/series/" + series, answer);
  }
}

}  // namespace app
