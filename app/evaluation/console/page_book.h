// What pages have said, by page and number: each is taken once, whatever is sent again, and acknowledged once it is
// safe. Pure; one thread; some 100 ns a call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace app {

class PageBook {
 public:
  static constexpr std::size_t kMostTaken = 200'000;  ///< then nothing more is taken: no person says so much

  enum class Known : std::uint8_t { no, waiting, safe, refused, too_many };
  Known known(const std::string& page, std::uint64_t number) const;
  /// Of one that was refused.
  std::string why(const std::string& page, std::uint64_t number) const;

  /// It is being looked at.
  void begin(const std::string& page, std::uint64_t number);
  void refuse(const std::string& page, std::uint64_t number, std::string why);
  /// Safe when so many events are.
  void accept(const std::string& page, std::uint64_t number, std::size_t events);
  /// Those that have become safe since the last call, in the order in which they were taken.
  std::vector<std::pair<std::string, std::uint64_t>> takeSafe(const std::function<bool(std::size_t events)>& is_safe);
  bool waits() const { return !accepted_.empty(); }

 private:
  using Key = std::pair<std::string, std::uint64_t>;
  struct Accepted {
    Key key;
    std::size_t events;
  };
  std::map<Key, Known> known_;
  std::map<Key, std::string> why_;
  std::deque<Accepted> accepted_;
};

}  // namespace app
