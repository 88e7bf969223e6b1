// Addresses, questions and answers of imaging servers, without a network.
#include <gtest/gtest.h>

#include <random>

#include "app/imaging_server/multipart_reader.h"
#include "app/imaging_server/server_address.h"
#include "app/imaging_server/study_list.h"
#include "app/imaging_server/study_query.h"
#include "app/text/usage_error.h"
#include "tests/refusal.h"

namespace app {
namespace {

std::string refusalOf(const std::function<void()>& task) { return tests::refusalOf<UsageError>(task); }

TEST(ServerAddress, HasHostPortAndPath) {
  const ServerAddress web = serverAddress("https://pacs.example/dicom-web/");
  EXPECT_EQ(web.url(), "https://pacs.example:443/dicom-web");
  EXPECT_TRUE(web.is_encrypted);
  EXPECT_EQ(serverAddress("http://[::1]:8042/a").url(), "http://[::1]:8042/a");
  const ServerAddress dicom = serverAddress("dicom://10.0.0.7:11112/PACS_1");
  EXPECT_EQ(dicom.ae_title, "PACS_1");
  EXPECT_EQ(dicom.port, 11112);
  EXPECT_EQ(dicom.url(), "dicom://10.0.0.7:11112/PACS_1");
  EXPECT_FALSE(isServerAddress("scan_folder"));
  EXPECT_TRUE(isServerAddress("http://anywhere"));
}

TEST(ServerAddress, RefusesSecretsAndWhatNoAddressIs) {
  EXPECT_NE(refusalOf([] { serverAddress("https://me:secret@pacs.example/"); }).find("does not belong"),
            std::string::npos);
  EXPECT_EQ(refusalOf([] { serverAddress("https://me:secret@pacs.example/"); }).find("secret"), std::string::npos);
  for (const char* bad :
       {"http://pacs.example/dicom-web", "https://", "https:///path", "https://host:0/x", "https://host:70000/",
        "https://host:x/", "https://ho st/", "https://host/a?PatientID=1", "https://[::1/", "dicom://host:104",
        "dicom://host:104/", "dicom://host/SEVENTEEN_LETTERS", "https://host/\r\nHost: other"})
    EXPECT_NE(refusalOf([&] { serverAddress(bad); }), "accepted") << bad;
}

TEST(StudyQuery, KnowsTheKeysOfAStudyAndEncodesValues) {
  const auto keys = studyQuery("PatientID=A 1/&StudyDate=20260101-20261231");
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].group, 0x0010);
  EXPECT_EQ(asUrlQuery(keys), "PatientID=A%201%2F&StudyDate=20260101-20261231");
}

TEST(StudyQuery, AsksForSomebody) {
  for (const char* bad : {"", "PatientID", "PatientID=", "PatientID=*", "PatientID=?*", "Colour=blue", "=x",
                          "PatientID=1&", "PatientID=a\\b", "PatientID=a\nb"})
    EXPECT_NE(refusalOf([&] { studyQuery(bad); }), "accepted") << bad;
  EXPECT_EQ(refusalOf([] { studyQuery("Colour=Miller"); }).find("Miller"), std::string::npos);
}

TEST(StudyList, IsReadFromTheStandardsModel) {
  const auto studies = studiesOf(R"([{"0020000D":{"vr":"UI","Value":["1.2.3"]},
      "00080020":{"vr":"DA","Value":["20260314"]},"00081030":{"vr":"LO","Value":["Jaw\u001b[31m\u009b low"]},
      "00080061":{"vr":"CS","Value":["CT","OT"]},"00201208":{"vr":"IS","Value":[72]}},
      {"0020000D":{"vr":"UI","Value":["1.2.2"]},"00080020":{"vr":"DA","Value":["20250101"]}}])",
                                 "server x");
  ASSERT_EQ(studies.size(), 2u);
  EXPECT_EQ(studies[0].date, "2025-01-01");
  EXPECT_EQ(studies[0].images, 0);
  EXPECT_EQ(studies[1].uid, "1.2.3");
  EXPECT_EQ(studies[1].description, "Jaw[31m low");
  EXPECT_EQ(studies[1].modalities, "CT, OT");
  EXPECT_EQ(studies[1].images, 72);
  EXPECT_EQ(seriesOf(R"([{"0020000E":{"Value":["9.1"]}}])", "s"), std::vector<std::string>{"9.1"});
  EXPECT_TRUE(studiesOf("[]", "s").empty());
}

TEST(StudyList, RefusesWhatIsNone) {
  const std::string bomb(100'000, '[');
  for (const std::string& bad :
       {std::string("{}"), std::string("nothing"), bomb, std::string("[{}]"), std::string("[1]"),
        std::string(R"([{"0020000D":{"Value":["../../../etc"]}}])"), std::string(R"([{"0020000D":{"Value":[7]}}])")})
    EXPECT_NE(refusalOf([&] { studiesOf(bad, "server x"); }), "accepted") << bad.substr(0, 60);
}

class Multipart : public testing::Test {
 protected:
  static constexpr const char* kType = "multipart/related; type=\"application/dicom\"; boundary=\"=_b 1\"";

  /// What comes of an answer that arrives in pieces of at most so many bytes.
  std::vector<std::string> filesOf(const std::string& answer, std::size_t piece, std::mt19937* random = nullptr,
                                   const std::string& type = kType) {
    assets::ReceivedFiles files;
    MultipartReader reader(type, "server x", limits_, files);
    for (std::size_t at = 0; at < answer.size();) {
      const std::size_t size = std::min(random != nullptr ? 1 + (*random)() % piece : piece, answer.size() - at);
      reader.read({answer.data() + at, size});
      at += size;
    }
    reader.finish();
    files.close();
    std::vector<std::string> out;
    for (std::size_t n = 0; n < files.count(); ++n) out.emplace_back(files.file(n).begin(), files.file(n).end());
    return out;
  }
  static std::string part(const std::string& body) {
    return "--=_b 1\r\nContent-Type: application/dicom; transfer-syntax=1.2\r\nX: y\r\n\r\n" + body + "\r\n";
  }

  ReceiveLimits limits_;
};

TEST_F(Multipart, FilesAreTheSameHoweverTheyArriveInPieces) {
  std::mt19937 random(7);
  std::vector<std::string> files;
  std::string answer = "before\r\n";
  for (int n = 0; n < 12; ++n) {
    std::string file(random() % 3000, '\0');
    for (char& c : file) c = "\r\n-=_b 1a"[random() % 9];
    if (file.find("\r\n--=_b 1") != std::string::npos) continue;
    files.push_back(file);
    answer += part(file);
  }
  answer += "--=_b 1--\r\nafter";
  ASSERT_GT(files.size(), 8u);
  EXPECT_EQ(filesOf(answer, answer.size()), files);
  for (int round = 0; round < 60; ++round)
    EXPECT_EQ(filesOf(answer, std::size_t{1} << (round % 11), &random), files) << round;
  // Without quotes, without heads, without a line before.
  EXPECT_EQ(filesOf("--q\r\n\r\nbody\r\n--q--", 3, nullptr, "multipart/related;boundary=q"),
            std::vector<std::string>{"body"});
}

TEST_F(Multipart, WhatIsCutDamagedOrTooMuchIsRefusedInOneSentence) {
  const std::string good = part("first") + part("second");
  const auto why = [&](const std::string& answer, const std::string& type = kType) {
    return refusalOf([&] { filesOf(answer, 700, nullptr, type); });
  };
  EXPECT_NE(why(good).find("ends within a file"), std::string::npos);
  EXPECT_NE(why(good + "--=_b 1").find("ends within"), std::string::npos);
  EXPECT_NE(why(good + "--=_b 1garbage\r\n").find("damaged boundary"), std::string::npos);
  EXPECT_NE(why(std::string(100'000, 'x')).find("no boundary"), std::string::npos);
  EXPECT_NE(why("--=_b 1\r\nX: " + std::string(100'000, 'x')).find("endless head"), std::string::npos);
  EXPECT_NE(why("--=_b 1" + std::string(100'000, ' ')).find("damaged boundary"), std::string::npos);
  EXPECT_NE(why("--=_b 1\r\nContent-Type: text/html\r\n\r\n<html>").find("no DICOM file"), std::string::npos);
  EXPECT_NE(why(good, "text/html").find("no DICOM files"), std::string::npos);
  EXPECT_NE(why(good, "multipart/related; type=\"image/jpeg\"; boundary=b").find("no DICOM files"), std::string::npos);
  EXPECT_NE(why(good, "multipart/related").find("where files begin"), std::string::npos);
  EXPECT_NE(why(good, "multipart/related; boundary=" + std::string(71, 'b')).find("where files begin"),
            std::string::npos);
  limits_.files = 5;
  std::string many;
  for (int n = 0; n < 6; ++n) many += part("x");
  EXPECT_NE(why(many + "--=_b 1--").find("more than 20,000 files"), std::string::npos);
  limits_ = {};
  limits_.file_bytes = 1000;
  EXPECT_NE(why(part(std::string(1001, 'x')) + "--=_b 1--").find("larger than any scan"), std::string::npos);
  limits_ = {};
  limits_.all_bytes = 1000;
  EXPECT_NE(why(part(std::string(600, 'x')) + part(std::string(600, 'x')) + "--=_b 1--").find("more than 8 GB"),
            std::string::npos);
}

}  // namespace
}  // namespace app
