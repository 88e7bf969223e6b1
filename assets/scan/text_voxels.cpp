#include "assets/scan/text_voxels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <span>
#include <string>
#include <string_view>

#include "assets/scan/header_text.h"

namespace assets {

namespace {

bool isSeparator(char c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); }

class HexSource : public ByteSource {
 public:
  HexSource(const RegularFile& file, std::uint64_t from_byte) : characters_(file, from_byte), path_(file.path()) {}

  std::size_t fill(std::span<char> bytes) override {
    std::size_t done = 0;
    for (; done < bytes.size(); ++done) {
      const auto high = digit();
      if (!high) break;
      const auto low = digit();
      if (!low) refuseTruncated(path_);
      bytes[done] = static_cast<char>(*high << 4 | *low);
    }
    return done;
  }

 private:
  std::optional<int> digit() {
    while (const auto c = characters_.next()) {
      if (isSeparator(*c)) continue;
      if (*c >= '0' && *c <= '9') return *c - '0';
      if (*c >= 'a' && *c <= 'f') return *c - 'a' + 10;
      if (*c >= 'A' && *c <= 'F') return *c - 'A' + 10;
      refuseScan(path_, "its voxels are not hexadecimal digits as its header states; export the volume again");
    }
    return std::nullopt;
  }

  CharacterReader characters_;
  std::string path_;
};

template <class Stored>
class TextSource : public ByteSource {
 public:
  TextSource(const RegularFile& file, std::uint64_t from_byte) : characters_(file, from_byte), path_(file.path()) {}

  std::size_t fill(std::span<char> bytes) override {
    std::size_t done = 0;
    for (; done + sizeof(Stored) <= bytes.size(); done += sizeof(Stored)) {
      const std::string word = nextWord();
      if (word.empty()) break;
      const auto stored = std::bit_cast<std::array<char, sizeof(Stored)>>(number(word));
      std::copy(stored.begin(), stored.end(), bytes.begin() + static_cast<std::ptrdiff_t>(done));
    }
    return done;
  }

 private:
  std::string nextWord() {
    constexpr std::size_t kMax = 64;
    std::string word;
    while (const auto c = characters_.next()) {
      if (!isSeparator(*c))
        word += *c;
      else if (!word.empty())
        break;
      if (word.size() > kMax) refuseWord(word);
    }
    return word;
  }

  Stored number(std::string_view word) const {
    Stored value{};
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) refuseWord(word);
    return value;
  }

  [[noreturn]] void refuseWord(std::string_view word) const {
    refuseScan(path_,
               "its voxel " + printableExcerpt(word) + " is not a number of the stated type; export the volume again");
  }

  CharacterReader characters_;
  std::string path_;
};

}  // namespace

std::unique_ptr<ByteSource> hexSource(const RegularFile& file, std::uint64_t from_byte) {
  return std::make_unique<HexSource>(file, from_byte);
}

std::unique_ptr<ByteSource> textSource(VoxelType type, const RegularFile& file, std::uint64_t from_byte) {
  return withVoxelType(type, [&](auto stored) -> std::unique_ptr<ByteSource> {
    return std::make_unique<TextSource<decltype(stored)>>(file, from_byte);
  });
}

}  // namespace assets
