// An answer of many DICOM files (multipart/related, RFC 2046 and 2387) as it comes in, piece by piece, into files
// without names. Bounds: bytes of a file and of all, files, length of a part's head. One thread; no copy but the last
// bytes of a piece.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "assets/import/dicom/received_files.h"

namespace app {

struct ReceiveLimits {
  std::size_t files = 20'000;
  std::uint64_t file_bytes = std::uint64_t{1} << 30;  ///< a volume of 768³ in one file
  std::uint64_t all_bytes = std::uint64_t{8} << 30;
  std::uint64_t list_bytes = std::uint64_t{4} << 20;  ///< of a list of studies
  long idle_s = 30;                                   ///< without a kilobyte a second
};

class MultipartReader {
 public:
  /// Of the answer's content type. Throws UsageError: it is no multipart/related of application/dicom. `where` names
  /// the server in messages.
  MultipartReader(std::string_view content_type, std::string where, const ReceiveLimits& limits,
                  assets::ReceivedFiles& files);

  /// Throws UsageError: damaged, or too much; LoadError: the disk is full.
  void read(std::span<const char> bytes);
  /// The answer is over. Throws UsageError: it is not whole.
  void finish() const;

 private:
  enum class State { before, boundary, head, body, after };

  bool step();
  void takeBody(std::size_t end);
  [[noreturn]] void refuse(const std::string& why) const;

  std::string where_;
  const ReceiveLimits& limits_;
  assets::ReceivedFiles& files_;
  std::string delimiter_;  ///< end of line, two hyphens, boundary
  std::string held_;
  std::size_t at_ = 0;  ///< in held_: before it everything is read
  State state_ = State::before;
  std::uint64_t file_bytes_ = 0;
};

}  // namespace app
