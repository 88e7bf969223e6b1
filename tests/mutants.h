// Damaged copies of good files, for tests that feed readers with what nobody would write by hand: flipped bits, cut
// ends, spliced and doubled pieces, lines lost, doubled or far too long, numbers of a text or of the bytes made NaN,
// huge, negative or none, or lists nested in lists. Mutant n of a file is always the same bytes, on any machine.
// `forEachMutant` tries as many as the caller says, or as the environment's MOLAR_MUTANTS says, from MOLAR_FIRST_MUTANT
// on; a mutant that takes more than 10 s of processor time (60 under a sanitizer) ends the program (SIGPROF), and one
// that makes the program larger than 1 GB fails the test. About 2 µs a mutant of a few kilobytes.
#pragma once

#include <sys/resource.h>
#include <sys/time.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace mutants {

class Mutator {
 public:
  Mutator(std::string good, std::uint64_t number) : bytes_(std::move(good)), random_(number) {}

  /// One to four changes, half of the files changed in their first 512 bytes only.
  std::string changed() {
    reach_ = below(2) == 0 ? 512 : std::numeric_limits<std::size_t>::max();
    for (std::size_t changes = 1 + below(4); changes > 0 && !bytes_.empty(); --changes) changeOnce();
    return std::move(bytes_);
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : static_cast<std::size_t>(random_() % end); }
  std::size_t place() { return below(std::min(bytes_.size(), reach_)); }
  std::size_t pieceAt(std::size_t at) { return 1 + below(std::min<std::size_t>(bytes_.size() - at, 64)); }

  void changeOnce() {
    const std::size_t at = place();
    switch (below(12)) {
      case 0:
        bytes_[at] = static_cast<char>(bytes_[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes_[at] = static_cast<char>(random_());
        break;
      case 2:
        bytes_.resize(at);
        break;
      case 3:
        bytes_.replace(at, pieceAt(at), bytes_.substr(place(), 1 + below(64)));
        break;
      case 4:
        bytes_.insert(at, bytes_.substr(at, pieceAt(at)));
        break;
      case 5:
        bytes_.erase(at, pieceAt(at));
        break;
      case 6:
      case 7:
        changeNumber(at);
        break;
      case 8:
        changeLine(at);
        break;
      case 9:
        bytes_.insert(at, piece());
        break;
      case 10:
        bytes_.replace(at, below(4), piece());
        break;
      default:
        putBinary(at);
    }
  }

  std::string piece() {
    static constexpr std::array<std::string_view, 40> kPieces = {"-1",
                                                                 "0",
                                                                 "1",
                                                                 "255",
                                                                 "256",
                                                                 "65536",
                                                                 "2147483647",
                                                                 "-2147483648",
                                                                 "4294967295",
                                                                 "1e308",
                                                                 "nan",
                                                                 "-inf",
                                                                 "1e-308",
                                                                 "-0",
                                                                 "1e9",
                                                                 "0.5",
                                                                 "99999999999999999999",
                                                                 "\n",
                                                                 "\n\n",
                                                                 "\r\n",
                                                                 " ",
                                                                 "\"",
                                                                 "'",
                                                                 "%s%n",
                                                                 "%99999999d",
                                                                 "../",
                                                                 "[",
                                                                 "]",
                                                                 "{",
                                                                 "}",
                                                                 ":",
                                                                 ",",
                                                                 "=",
                                                                 "#",
                                                                 "null",
                                                                 "true",
                                                                 "/etc/passwd",
                                                                 "\xef\xbb\xbf",
                                                                 "\xff\xfe",
                                                                 "5125"};
    return std::string(kPieces[below(kPieces.size())]);
  }

  /// The first number of the text at or behind `at`, if there is one.
  void changeNumber(std::size_t at) {
    constexpr std::string_view kDigits = "+-.0123456789";
    const std::size_t from = bytes_.find_first_of(kDigits, at);
    if (from == std::string::npos || from > at + 200) return;
    const std::size_t end = std::min(bytes_.find_first_not_of("+-.0123456789e", from), bytes_.size());
    bytes_.replace(from, end - from, below(2) == 0 ? smallNumberOrNest() : piece());
  }

  /// Now and then lists in lists, deeper than a reader that calls itself for each can follow.
  std::string smallNumberOrNest() {
    const std::size_t number = below(300);
    const std::size_t deep = number < 295 ? 0 : 100'000;
    return deep == 0 ? std::to_string(number) : std::string(deep, '[') + std::string(deep, ']');
  }

  void changeLine(std::size_t at) {
    const std::size_t before = bytes_.rfind('\n', at);
    const std::size_t from = before == std::string::npos ? 0 : before + 1;
    const std::size_t end = bytes_.find('\n', from);
    const std::size_t next = end == std::string::npos ? bytes_.size() : end + 1;
    const std::string line = bytes_.substr(from, std::min<std::size_t>(next - from, 4096));
    switch (below(4)) {
      case 0:
        bytes_.erase(from, next - from);
        break;
      case 1:
        bytes_.insert(from, line);
        break;
      case 2:
        bytes_.insert(place(), line);
        break;
      default:
        bytes_.insert(at, std::string(below(3) == 0 ? 70000 : 1000, below(2) == 0 ? 'a' : '1'));
    }
  }

  template <class Number>
  void put(std::size_t at, Number number, bool reversed) {
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), &number, sizeof number);
    if (reversed) std::reverse(bytes.begin(), bytes.end());
    std::copy_n(bytes.begin(), std::min(bytes.size(), bytes_.size() - at), bytes_.begin() + static_cast<long>(at));
  }

  /// A number as the machine stores it, of any width and byte order, often on an even place as headers have them.
  void putBinary(std::size_t at) {
    if (below(4) != 0) at &= ~std::size_t{1};
    const bool reversed = below(4) == 0;
    constexpr std::array<std::int64_t, 9> kWhole = {0, -1, 1, 0x7fff, 0x8000, 0x7fffffff, -0x80000000L, 0x40000000, 3};
    constexpr std::array<double, 7> kReal = {std::numeric_limits<double>::quiet_NaN(),
                                             std::numeric_limits<double>::infinity(),
                                             3.0e38,
                                             -1.0,
                                             0.0,
                                             1.0e-38,
                                             512.0};
    const std::int64_t whole = kWhole[below(kWhole.size())];
    const double real = kReal[below(kReal.size())];
    switch (below(5)) {
      case 0:
        put(at, static_cast<std::int16_t>(whole), reversed);
        break;
      case 1:
        put(at, static_cast<std::int32_t>(whole), reversed);
        break;
      case 2:
        put(at, whole, reversed);
        break;
      case 3:
        put(at, static_cast<float>(real), reversed);
        break;
      default:
        put(at, real, reversed);
    }
  }

  std::string bytes_;
  std::mt19937_64 random_;
  std::size_t reach_ = 0;
};

inline std::string mutantOf(const std::string& good, std::uint64_t number) { return Mutator(good, number).changed(); }

inline std::uint64_t numberFromEnvironment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// Ends the program if what it watches takes more than ten seconds of processor time: a wait that no busy machine
/// makes.
class HangWatch {
 public:
  HangWatch() { set(kLongest_s); }
  ~HangWatch() { set(0); }
  HangWatch(const HangWatch&) = delete;
  HangWatch& operator=(const HangWatch&) = delete;

 private:
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  static constexpr time_t kLongest_s = 60;
#else
  static constexpr time_t kLongest_s = 10;
#endif

  static void set(time_t seconds) {
    const itimerval timer{{0, 0}, {seconds, 0}};
    ::setitimer(ITIMER_PROF, &timer, nullptr);
  }
};

inline long largest_kB() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

/// Tries from which on their shares, refused and not, mean something.
inline constexpr std::uint64_t kEnoughToJudge = 50;

/// Calls `judge(mutant, which of the good files, number)`; the good files take turns. Where a mutant `costs` as much as
/// that many others, MOLAR_MUTANTS means as many fewer.
template <class Judge>
void forEachMutant(const std::vector<std::string>& good, std::uint64_t usual_count, const Judge& judge,
                   std::uint64_t costs = 1) {
  constexpr long kMost_kB = 1'000'000;
  const std::uint64_t first = numberFromEnvironment("MOLAR_FIRST_MUTANT", 1);
  const std::uint64_t asked = numberFromEnvironment("MOLAR_MUTANTS", usual_count * costs);
  const std::uint64_t count = (asked + costs - 1) / costs;
  const long before_kB = largest_kB();
  for (std::uint64_t number = first; number < first + count; ++number) {
    const std::size_t which = number % good.size();
    const std::string mutant = mutantOf(good[which], number);
    const testing::ScopedTrace trace(__FILE__, __LINE__,
                                     "mutant " + std::to_string(number) + " of file " + std::to_string(which));
    const HangWatch watch;
    judge(mutant, which, number);
    if (largest_kB() > std::max(before_kB, kMost_kB)) {
      ADD_FAILURE() << "the program has grown to " << largest_kB() << " kB";
      return;
    }
  }
}

}  // namespace mutants
