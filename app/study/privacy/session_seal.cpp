#include "app/study/privacy/session_seal.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "assets/toml_reader.h"
#include "calibration/output_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSealedBytes = 256;

}  // namespace

std::string sealedKeyPath(const std::string& folder, SealedStream stream) {
  return (fs::path(folder) / "keys" / (std::string(kSealedStreams[static_cast<std::size_t>(stream)]) + ".key"))
      .string();
}

SessionSeal::SessionSeal(const PublicStudyKeys& study, const std::string& folder, std::string session)
    : folder_(folder), session_(std::move(session)) {
  std::error_code failed;
  const fs::path place = fs::path(folder) / "keys";
  if (!fs::create_directory(place, failed)) throw UsageError(place.string() + ": cannot be made, give another folder");
  fs::permissions(place, fs::perms::owner_all, failed);
  for (std::size_t n = 0; n < keys_.size(); ++n) {
    keys_[n] = SecretKey::random();
    calibration::OutputFile(sealedKeyPath(folder, static_cast<SealedStream>(n)), false)
        .commit(sealedTo(study, *keys_[n]));
  }
}

std::string SessionSeal::seal(SealedStream stream, std::string_view table, std::uint64_t row,
                              std::string_view plain) const {
  const auto& key = keys_[static_cast<std::size_t>(stream)];
  return key ? sealedWith(*key, {session_, table, row}, plain) : std::string();
}

void SessionSeal::destroy(SealedStream stream) {
  keys_[static_cast<std::size_t>(stream)].reset();
  std::error_code failed;
  fs::remove(sealedKeyPath(folder_, stream), failed);
  calibration::syncToDisk((fs::path(folder_) / "keys").string());
}

OpenedSession::OpenedSession(const PrivateStudyKeys& study, const std::string& folder, std::string session)
    : session_(std::move(session)) {
  for (std::size_t n = 0; n < keys_.size(); ++n) {
    const std::string path = sealedKeyPath(folder, static_cast<SealedStream>(n));
    std::error_code failed;
    if (fs::is_regular_file(path, failed)) keys_[n] = study.opened(assets::readSmallFile(path, kMostSealedBytes));
  }
}

std::optional<std::string> OpenedSession::open(SealedStream stream, std::string_view table, std::uint64_t row,
                                               std::string_view sealed) const {
  const auto& key = keys_[static_cast<std::size_t>(stream)];
  return key ? openedWith(*key, {session_, table, row}, sealed) : std::nullopt;
}

}  // namespace app
