// A DICOMweb client against servers that answer badly: each ends in one sentence, soon.
#include <gtest/gtest.h>

#include "app/imaging_server/web_server.h"
#include "app/text/usage_error.h"
#include "tests/app/imaging_server/fake_server.h"
#include "tests/refusal.h"

namespace app {
namespace {

using tests::FakeServer;
using Line = FakeServer::Line;

constexpr const char* kJson = "application/dicom+json";
constexpr const char* kParts = "multipart/related; type=\"application/dicom\"; boundary=b";

std::string seriesList() { return FakeServer::head("200 OK", kJson) + R"([{"0020000E":{"Value":["1.2"]}}])"; }
std::string part(const std::string& body) { return "--b\r\nContent-Type: application/dicom\r\n\r\n" + body + "\r\n"; }

class HostileServer : public testing::Test {
 protected:
  /// The refusal when files are asked for; `answer` is the server's to that question.
  std::string receiving(const std::function<void(Line&)>& answer) {
    FakeServer server([&](const std::string& request, Line& line) {
      if (request.find("/series?") != std::string::npos)
        line.say(seriesList());
      else
        answer(line);
    });
    assets::ReceivedFiles files;
    return tests::refusalOf<UsageError>([&] {
      WebServer client(serverAddress(server.url()), settings_, limits_);
      client.receive("1.2.3", files);
    });
  }
  std::string receivingText(const std::string& text) {
    return receiving([&](Line& line) { line.say(text); });
  }
  /// The refusal when studies are asked for.
  std::string listing(const std::function<void(Line&)>& answer) {
    FakeServer server([&](const std::string&, Line& line) { answer(line); });
    return tests::refusalOf<UsageError>([&] {
      WebServer client(serverAddress(server.url()), settings_, limits_);
      client.studies(studyQuery("PatientID=7"));
    });
  }

  ServerSettings settings_;
  ReceiveLimits limits_;
};

void expectOneSentence(const std::string& refusal, const std::string& words) {
  EXPECT_TRUE(refusal.starts_with("server 127.0.0.1: ")) << refusal;
  EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
  EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
}

TEST_F(HostileServer, WrongBoundariesTypesAndCutBodies) {
  const std::string ok = FakeServer::head("200 OK", kParts);
  expectOneSentence(receivingText(ok + "--c\r\n\r\nx\r\n--c--"), "ends within a file");
  expectOneSentence(receivingText(ok + std::string(200'000, 'x')), "no boundary");
  expectOneSentence(receivingText(ok + part("x")), "ends within a file");
  expectOneSentence(receivingText(FakeServer::head("200 OK", "text/html") + "<html>"), "holds no DICOM files");
  expectOneSentence(receivingText("HTTP/1.1 200 OK\r\nContent-Type: " + std::string(kParts) +
                                  "\r\nContent-Length: 100000\r\n\r\n" + part("x")),
                    "connection broke");
  expectOneSentence(receivingText("not HTTP at all\r\n\r\n"), "connection broke");
  expectOneSentence(receivingText(""), "connection broke");
}

TEST_F(HostileServer, ErrorsAndRedirectionsAreSaidAndNotFollowed) {
  expectOneSentence(receivingText(FakeServer::head("500 Oops", "text/plain") + "a stack trace of names"), "(500)");
  expectOneSentence(receivingText(FakeServer::head("404 Not Found", "text/plain")), "(404)");
  expectOneSentence(receivingText(FakeServer::head("401 Unauthorized", "text/plain")), "(401)");
  expectOneSentence(receivingText(FakeServer::head("202 Accepted", "text/plain")), "(202)");
  FakeServer elsewhere([](const std::string&, Line& line) { line.say(seriesList()); });
  expectOneSentence(receivingText("HTTP/1.1 302 Found\r\nLocation: " + elsewhere.url() + "\r\n\r\n"), "not followed");
  EXPECT_TRUE(elsewhere.requests().empty());
}

TEST_F(HostileServer, EndlessAnswersEndAtTheirLimits) {
  limits_.file_bytes = 1'000'000;
  limits_.list_bytes = 100'000;
  limits_.files = 200;
  expectOneSentence(receiving([](Line& line) {
                      line.say(FakeServer::head("200 OK", kParts) + "--b\r\n\r\n");
                      while (line.say(std::string(65'536, 'x'))) {
                      }
                    }),
                    "larger than any scan");
  expectOneSentence(receiving([](Line& line) {
                      line.say(FakeServer::head("200 OK", kParts));
                      for (int n = 0; n < 1'000'000 && line.say(part("")); ++n) {
                      }
                    }),
                    "more than 20,000 files");
  expectOneSentence(listing([](Line& line) {
                      line.say(FakeServer::head("200 OK", kJson));
                      while (line.say(std::string(65'536, '['))) {
                      }
                    }),
                    "list of studies is endless");
  expectOneSentence(listing([](Line& line) { line.say(FakeServer::head("200 OK", kJson) + std::string(90'000, '[')); }),
                    "cannot be read");
}

TEST_F(HostileServer, ASlowDripIsNotWaitedFor) {
  limits_.idle_s = 1;
  expectOneSentence(receiving([](Line& line) {
                      line.say(FakeServer::head("200 OK", kParts) + part("x") + "--b\r\n\r\n");
                      while (line.say("x") && line.rest(std::chrono::milliseconds(20))) {
                      }
                    }),
                    "sends nothing any more");
  expectOneSentence(listing([](Line& line) { line.rest(std::chrono::seconds(20)); }), "sends nothing any more");
}

TEST(WebServer, SendsTheTokenAndAsksForWhatIsThere) {
  FakeServer server([](const std::string& request, Line& line) {
    if (request.find("Authorization: Bearer quiet-word") == std::string::npos)
      line.say(FakeServer::head("401 Unauthorized", "text/plain"));
    else if (request.find("/series?Modality=CT") != std::string::npos)
      line.say(seriesList());
    else
      line.say(FakeServer::head("200 OK", kParts) + part("one") + part("two") + "--b--\r\n");
  });
  ServerSettings settings;
  settings.token = "quiet-word";
  WebServer client(serverAddress(server.url()), settings);
  assets::ReceivedFiles files;
  client.receive("1.2.3", files);
  files.close();
  ASSERT_EQ(files.count(), 2u);
  EXPECT_EQ(std::string(files.file(1).begin(), files.file(1).end()), "two");
  const auto requests = server.requests();
  ASSERT_EQ(requests.size(), 2u);
  EXPECT_TRUE(requests[1].starts_with("GET /dicom-web/studies/1.2.3/series/1.2 HTTP"));
  EXPECT_NE(requests[1].find("transfer-syntax=*"), std::string::npos);
}

TEST(WebServer, NobodyThereIsOneSentence) {
  const auto asking = [](const std::string& url) {
    return tests::refusalOf<UsageError>([&] { WebServer(serverAddress(url), {}).studies(studyQuery("PatientID=7")); });
  };
  int port = 0;
  {
    port = FakeServer([](const std::string&, Line&) {}).port();
  }
  expectOneSentence(asking("http://127.0.0.1:" + std::to_string(port) + "/x"), "nothing answers at port");
  EXPECT_NE(asking("https://no-such-host.invalid/x").find("no such host is known"), std::string::npos);
  FakeServer plain([](const std::string&, Line& line) { line.say("HTTP/1.1 200 OK\r\n\r\n"); });
  const std::string url = plain.url();
  EXPECT_NE(asking("https" + url.substr(4)).find("no encrypted connection"), std::string::npos);
}

}  // namespace
}  // namespace app
