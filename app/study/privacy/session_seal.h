// The keys of one session, one a stream: words (notes, comments, help, problems, reasons), audio, answers. While the
// session runs they are in memory alone; FOLDER/keys holds each sealed to the study, 80 bytes. Where that file is gone
// the stream cannot be read any more, by anybody, and what was sealed stays as it is. One thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "app/study/privacy/study_keys.h"

namespace app {

enum class SealedStream : std::uint8_t { words, audio, answers };
inline constexpr std::array<std::string_view, 3> kSealedStreams{"words", "audio", "answers"};

/// "FOLDER/keys/words.key".
std::string sealedKeyPath(const std::string& folder, SealedStream stream);

/// Of a session that goes on: seals.
class SessionSeal {
 public:
  /// Makes the keys, and FOLDER/keys on the disk before anything is sealed. `session`: its folder's name. Throws
  /// UsageError: they cannot be written.
  SessionSeal(const PublicStudyKeys& study, const std::string& folder, std::string session);

  /// As bytes; `table` and `row` say where it belongs. Empty where the stream was destroyed.
  std::string seal(SealedStream stream, std::string_view table, std::uint64_t row, std::string_view plain) const;
  bool holds(SealedStream stream) const { return keys_[static_cast<std::size_t>(stream)].has_value(); }
  /// For a process of the session that seals itself; null: the stream was destroyed.
  const SecretKey* key(SealedStream stream) const {
    const auto& key = keys_[static_cast<std::size_t>(stream)];
    return key ? &*key : nullptr;
  }
  /// The participant withdraws it now: key and file are gone, nothing more is sealed.
  void destroy(SealedStream stream);

 private:
  std::string folder_, session_;
  std::array<std::optional<SecretKey>, kSealedStreams.size()> keys_;
};

/// Of a session that the study's owner reads: opens.
class OpenedSession {
 public:
  /// Streams whose sealed key is gone, or is not of this study, stay closed.
  OpenedSession(const PrivateStudyKeys& study, const std::string& folder, std::string session);

  bool holds(SealedStream stream) const { return keys_[static_cast<std::size_t>(stream)].has_value(); }
  /// None: the stream is closed, or the bytes were changed or moved.
  std::optional<std::string> open(SealedStream stream, std::string_view table, std::uint64_t row,
                                  std::string_view sealed) const;

 private:
  std::string session_;
  std::array<std::optional<SecretKey>, kSealedStreams.size()> keys_;
};

}  // namespace app
