// SHA-256 (FIPS 180-4) by OpenSSL. Any thread, one object per thread. Detects changed bytes; does not prove an author.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace calibration {

using Digest = std::array<std::uint8_t, 32>;

class Sha256 {
 public:
  /// Throws CalibrationError: not available in OpenSSL.
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::span<const std::uint8_t> bytes);
  /// Call once.
  Digest finish();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// 64 lower-case hexadecimal digits.
std::string sha256Of(std::string_view text);

}  // namespace calibration
