// Damaged answers of imaging servers: files that lie inside what was sent, a list, or one sentence.
#include <gtest/gtest.h>

#include "app/imaging_server/multipart_reader.h"
#include "app/imaging_server/study_list.h"
#include "app/text/usage_error.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace {

TEST(ImagingServerMutants, AnswersOfManyFiles) {
  const std::string type = "multipart/related; type=\"application/dicom\"; boundary=\"b-1\"";
  const std::string part =
      "--b-1\r\nContent-Type: application/dicom; transfer-syntax=1.2\r\n\r\nbody\r\n--b\r\nmore\r\n";
  // The type, then the answer.
  const std::string good = type + "\n" + part + part + part + "--b-1--\r\n";
  app::ReceiveLimits limits;
  limits.files = 100;
  limits.file_bytes = limits.all_bytes = 1 << 20;
  const auto judge = [&](const std::string& mutant, std::size_t, std::uint64_t number) {
    const std::size_t line = std::min(mutant.find('\n'), mutant.size());
    assets::ReceivedFiles files;
    tests::refusalOf<app::UsageError>([&] {
      app::MultipartReader reader(mutant.substr(0, line), "server x", limits, files);
      const std::size_t piece = 1 + number % 97;
      for (std::size_t at = line; at < mutant.size(); at += piece)
        reader.read({mutant.data() + at, std::min(piece, mutant.size() - at)});
      reader.finish();
    });
    EXPECT_LE(files.bytes(), mutant.size());
    EXPECT_LE(files.count(), limits.files);
  };
  mutants::forEachMutant({good}, 1000, judge, 4);
}

TEST(ImagingServerMutants, ListsOfStudies) {
  const std::string good = R"([{"0020000D":{"vr":"UI","Value":["1.2.3"]},"0020000E":{"Value":["1.2.3.4"]},
    "00080020":{"vr":"DA","Value":["20260314"]},"00081030":{"vr":"LO","Value":["Jaw"]},
    "00080061":{"vr":"CS","Value":["CT","OT"]},"00201208":{"vr":"IS","Value":[72]}},
    {"0020000D":{"vr":"UI","Value":["1.2.4"]},"0020000E":{"Value":["1.2.3.5"]}}])";
  const auto judge = [&](const std::string& mutant, std::size_t, std::uint64_t) {
    tests::refusalOf<app::UsageError>([&] {
      for (const app::FoundStudy& study : app::studiesOf(mutant, "server x")) {
        EXPECT_TRUE(app::isIdentifier(study.uid));
        EXPECT_LE(study.description.size(), 60u);
        EXPECT_EQ(study.description.find('\x1b'), std::string::npos);
      }
    });
    tests::refusalOf<app::UsageError>([&] {
      for (const std::string& uid : app::seriesOf(mutant, "server x")) EXPECT_TRUE(app::isIdentifier(uid));
    });
  };
  mutants::forEachMutant({good}, 1000, judge, 2);
}

}  // namespace
