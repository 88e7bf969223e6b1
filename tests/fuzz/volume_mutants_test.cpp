// A volume.vdb changed with a new checksum: OpenVDB may crash, hang or exhaust memory, in the child process only.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "assets/load_error.h"
#include "assets/scan/file_checksum.h"
#include "assets/scan/vdb_file.h"
#include "assets/scan/volume_reader.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace {

assets::CtVolume smallVolume() {
  assets::CtVolume volume;
  volume.grid = {{24, 17, 20}, 0.4, {1, 2, 3}};
  for (std::size_t v = 0; v < volume.grid.voxelCount(); ++v) {
    volume.hounsfield.push_back(static_cast<std::int16_t>(v % 3 == 0 ? -1000 : 17 * v % 2000));
    volume.label.push_back(static_cast<std::uint8_t>(v % 7));
    volume.solid.push_back(static_cast<std::uint8_t>(v % 256));
  }
  return volume;
}

/// With narrower limits than usual, which some mutants exceed.
assets::CtVolume readWithinNarrowLimits(const std::string& path) {
  const int answer = ::memfd_create("answer", MFD_CLOEXEC);
  const pid_t reader = ::fork();
  if (reader == 0) assets::runVolumeReader(path, {600'000'000, 100, 6000}, answer);
  int status = 0;
  while (::waitpid(reader, &status, 0) < 0) {
  }
  try {
    auto volume = assets::volumeFromAnswer(answer, status, path);
    ::close(answer);
    return volume;
  } catch (...) {
    ::close(answer);
    throw;
  }
}

TEST(VolumeMutants, AForgedVolumeIsReadOrRefusedForAnyFailureOfItsReader) {
  const on_disk::Folder folder;
  assets::writeVdb(smallVolume(), folder.at("v.vdb"));
  constexpr std::size_t kSealBytes = 24;
  const std::string sealed = on_disk::read(folder.at("v.vdb"));
  std::uint64_t tried = 0, refused = 0;
  const auto judge = [&](const std::string& mutant, std::size_t, std::uint64_t) {
    on_disk::write(folder.at("v.vdb"), mutant);
    assets::appendChecksum(folder.at("v.vdb"));
    const std::string refusal = tests::refusalOf<assets::LoadError>([&] {
      const auto volume = readWithinNarrowLimits(folder.at("v.vdb"));
      EXPECT_EQ(volume.hounsfield.size(), volume.grid.voxelCount());
      EXPECT_EQ(volume.solid.size(), volume.grid.voxelCount());
    });
    ++tried;
    refused += refusal == "accepted" ? 0 : 1;
  };
  constexpr std::uint64_t kForkCosts = 50;
  mutants::forEachMutant({sealed.substr(0, sealed.size() - kSealBytes)}, 60, judge, kForkCosts);
  if (tried >= mutants::kEnoughToJudge) {
    EXPECT_GT(refused, tried / 4);
  }
}

// Answers of a compromised reader.
TEST(VolumeMutants, ADamagedAnswerOfTheReaderIsAVolumeOrRefused) {
  const on_disk::Folder folder;
  assets::writeVdb(smallVolume(), folder.at("v.vdb"));
  const int served = ::memfd_create("answer", MFD_CLOEXEC);
  const pid_t reader = ::fork();
  if (reader == 0) assets::runVolumeReader(folder.at("v.vdb"), {600'000'000, 300, 6000}, served);
  int status = 0;
  while (::waitpid(reader, &status, 0) < 0) {
  }
  ASSERT_EQ(status, 0);
  struct stat facts {};
  ASSERT_EQ(::fstat(served, &facts), 0);
  std::string good(static_cast<std::size_t>(facts.st_size), '\0');
  ASSERT_EQ(::pread(served, good.data(), good.size(), 0), facts.st_size);
  ::close(served);

  const int answer = ::memfd_create("answer", MFD_CLOEXEC);
  std::uint64_t tried = 0, refused = 0;
  mutants::forEachMutant({good}, 1000, [&](const std::string& mutant, std::size_t, std::uint64_t number) {
    ASSERT_EQ(::ftruncate(answer, 0), 0);
    ASSERT_EQ(::pwrite(answer, mutant.data(), mutant.size(), 0), static_cast<ssize_t>(mutant.size()));
    constexpr int kExit = 1 << 8, kInWords = 3 * kExit;
    const int ended = number % 10 == 0 ? kInWords : 0;
    const std::string refusal = tests::refusalOf<assets::LoadError>([&] {
      const auto volume = assets::volumeFromAnswer(answer, ended, folder.at("v.vdb"));
      EXPECT_EQ(volume.hounsfield.size(), volume.grid.voxelCount());
      EXPECT_EQ(volume.label.size(), volume.grid.voxelCount());
      EXPECT_EQ(volume.solid.size(), volume.grid.voxelCount());
      EXPECT_EQ(ended, 0);
    });
    ++tried;
    refused += refusal == "accepted" ? 0 : 1;
  });
  ::close(answer);
  if (tried >= mutants::kEnoughToJudge) {
    EXPECT_GT(refused, tried / 4);
    EXPECT_LT(refused, tried);
  }
}

TEST(VolumeMutants, AChangeWithoutANewChecksumIsAlwaysDetected) {
  const on_disk::Folder folder;
  assets::writeVdb(smallVolume(), folder.at("v.vdb"));
  const std::string sealed = on_disk::read(folder.at("v.vdb"));
  mutants::forEachMutant({sealed}, 300, [&](const std::string& mutant, std::size_t, std::uint64_t) {
    if (mutant == sealed) return;
    on_disk::write(folder.at("v.vdb"), mutant);
    EXPECT_NE(tests::refusalOf<assets::LoadError>([&] { assets::requireChecksum(folder.at("v.vdb")); }), "accepted");
  });
}

}  // namespace
