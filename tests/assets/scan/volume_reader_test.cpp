#include "assets/scan/volume_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <functional>

#include "assets/load_error.h"
#include "assets/scan/vdb_file.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/refusal.h"

namespace {

using testing::HasSubstr;

std::string refusalToRead(const std::function<void()>& read) {
  return tests::refusalOf<assets::LoadError>([&] { read(); });
}

/// A process with this answer and exit.
std::string refusalOfAnswer(const std::string& bytes, const std::function<void()>& end) {
  const int answer = ::memfd_create("answer", MFD_CLOEXEC);
  EXPECT_EQ(::write(answer, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  const pid_t child = ::fork();
  if (child == 0) {
    end();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  const std::string refusal = refusalToRead([&] { assets::volumeFromAnswer(answer, status, "p/volume.vdb"); });
  ::close(answer);
  return refusal;
}

assets::CtVolume oneLeaf() {
  return {{{8, 8, 8}, 0.5, {1, 2, 3}},
          std::vector<std::int16_t>(512, 700),
          std::vector<std::uint8_t>(512, 1),
          std::vector<std::uint8_t>(512, 200),
          std::vector<std::uint8_t>(512, 48)};
}

/// The answer for `oneLeaf`: i32 size[3], 4 bytes of padding, f64 spacing, f64 origin[3], then the voxels.
std::string goodAnswer() {
  std::string bytes(48, '\0');
  const std::int32_t size[] = {8, 8, 8};
  const double place[] = {0.5, 1, 2, 3};
  std::memcpy(bytes.data(), size, sizeof size);
  std::memcpy(bytes.data() + 16, place, sizeof place);
  return bytes + std::string(4 * 512, '\1');
}

TEST(VolumeReader, ReturnsTheFile) {
  const on_disk::Folder folder;
  const assets::CtVolume volume = oneLeaf();
  assets::writeVdb(volume, folder.at("v.vdb"));
  const assets::CtVolume read = assets::readVolumeInChild(folder.at("v.vdb"));
  EXPECT_EQ(read.grid, volume.grid);
  EXPECT_EQ(read.hounsfield, volume.hounsfield);
  EXPECT_EQ(read.label, volume.label);
  EXPECT_EQ(read.solid, volume.solid);
  EXPECT_EQ(read.tooth, volume.tooth);
}

TEST(VolumeReader, ReadsIfTheCallerIgnoresSigchld) {
  const on_disk::Folder folder;
  assets::writeVdb(oneLeaf(), folder.at("v.vdb"));
  const auto before = ::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(refusalToRead([&] { assets::readVolumeInChild(folder.at("v.vdb")); }), "accepted");
  EXPECT_EQ(::signal(SIGCHLD, before), SIG_IGN) << "restored";
}

TEST(VolumeReader, ReportsLackOfMemory) {
  const on_disk::Folder folder;
  assets::CtVolume large;
  large.grid = {{300, 300, 300}, 0.5, {0, 0, 0}};
  large.hounsfield.assign(27'000'000, 5);
  large.label.assign(27'000'000, 1);
  large.solid.assign(27'000'000, 9);
  assets::writeVdb(large, folder.at("v.vdb"));
  const int answer = ::memfd_create("answer", MFD_CLOEXEC);
  const pid_t child = ::fork();
  if (child == 0) assets::runVolumeReader(folder.at("v.vdb"), {60'000'000, 60'000, 60'000}, answer);
  int status = 0;
  ::waitpid(child, &status, 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // memory cannot be limited there
  EXPECT_THAT(refusalToRead([&] { assets::volumeFromAnswer(answer, status, "p/volume.vdb"); }),
              HasSubstr("not enough memory"));
#endif
  ::close(answer);
}

TEST(VolumeReader, ReportsTheReadersMessage) {
  const on_disk::Folder folder;
  on_disk::write(folder.at("v.vdb"), std::string(2000, 'x'));
  EXPECT_THAT(refusalToRead([&] { assets::readVolumeInChild(folder.at("v.vdb")); }),
              HasSubstr("it cannot be read as OpenVDB"));
}

TEST(VolumeReader, SurvivesAReaderThatCrashesOrIsKilled) {
  EXPECT_EQ(refusalOfAnswer(goodAnswer(), [] {}), "accepted");
  EXPECT_THAT(refusalOfAnswer(goodAnswer(), [] { ::raise(SIGKILL); }), HasSubstr("its reader failed on it"));
  EXPECT_THAT(refusalOfAnswer(goodAnswer(), [] { ::_exit(4); }), HasSubstr("its reader failed on it"));
  EXPECT_THAT(refusalOfAnswer("", [] { ::_exit(5); }), HasSubstr("not enough memory"));
  EXPECT_EQ(refusalOfAnswer("p/volume.vdb: told\nso", [] { ::_exit(3); }), "p/volume.vdb: told?so");
  EXPECT_THAT(refusalOfAnswer("", [] { ::_exit(3); }), HasSubstr("its reader failed on it")) << "an empty message";
}

TEST(VolumeReader, ValidatesTheAnswer) {
  const std::string good = goodAnswer();
  const auto with = [&](std::size_t at, auto value) {
    std::string bytes = good;
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return refusalOfAnswer(bytes, [] {});
  };
  EXPECT_THAT(with(0, std::int32_t{9}), HasSubstr("its reader failed on it"));
  EXPECT_THAT(with(0, std::int32_t{-8}), HasSubstr("no voxels"));
  EXPECT_THAT(with(0, std::int32_t{2'000'000'000}), HasSubstr("too large"));
  EXPECT_THAT(with(16, 0.0), HasSubstr("is outside 0.001 to 50 mm"));
  EXPECT_THAT(with(24, std::nan("")), HasSubstr("finite"));
  EXPECT_THAT(refusalOfAnswer(good.substr(0, 40), [] {}), HasSubstr("its reader failed on it"));
  EXPECT_THAT(refusalOfAnswer(good + "x", [] {}), HasSubstr("its reader failed on it"));
  EXPECT_THAT(refusalOfAnswer("", [] {}), HasSubstr("its reader failed on it"));
}

TEST(VolumeReader, StopsAtItsLimitOfProcessorTime) {
  const on_disk::Folder folder;
  assets::CtVolume large;
  large.grid = {{200, 200, 200}, 0.5, {0, 0, 0}};
  large.hounsfield.assign(8'000'000, 5);
  large.label.assign(8'000'000, 1);
  large.solid.assign(8'000'000, 9);
  assets::writeVdb(large, folder.at("v.vdb"));
  const int answer = ::memfd_create("answer", MFD_CLOEXEC);
  const pid_t child = ::fork();
  if (child == 0) assets::runVolumeReader(folder.at("v.vdb"), {4'000'000'000, 1, 60'000}, answer);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(answer);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF) << status;
}

}  // namespace
