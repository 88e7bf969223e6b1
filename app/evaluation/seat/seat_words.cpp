#include "app/evaluation/seat/seat_words.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace app {

std::optional<std::vector<SeatWord>> seatWordsFrom(std::span<const std::byte> datagram) {
  const std::size_t count = datagram.size() / sizeof(SeatWord);
  if (count == 0 || count > kMostSeatWords || datagram.size() % sizeof(SeatWord) != 0) return {};
  std::vector<SeatWord> words(count);
  std::memcpy(words.data(), datagram.data(), datagram.size());
  for (const SeatWord& word : words)
    if (word.mark != SeatWord::kMark || word.kind < SeatWord::Kind::value || word.kind > SeatWord::Kind::began ||
        !std::isfinite(word.value))
      return {};
  return words;
}

bool SeatBook::fits(const SeatWord& word, std::uint64_t made) const {
  switch (word.kind) {
    case SeatWord::Kind::value:
    case SeatWord::Kind::no_value:
      return word.tick < made && word.number < ids_.size();
    case SeatWord::Kind::through:
    case SeatWord::Kind::deviates:
      return word.tick < made;
    case SeatWord::Kind::began:
      return word.tick <= made;
  }
  return false;
}

bool SeatBook::take(std::span<const SeatWord> words, std::uint64_t made) {
  if (!std::ranges::all_of(words, [&](const SeatWord& word) { return fits(word, made); })) return false;
  for (const SeatWord& word : words) {
    const bool is_value = word.kind == SeatWord::Kind::value || word.kind == SeatWord::Kind::no_value;
    if (is_value && word.tick >= followed_) {
      std::deque<Since>& values = values_[word.number];
      // Said before, and not yet known to be followed.
      while (!values.empty() && values.back().tick >= word.tick && values.back().tick >= followed_) values.pop_back();
      values.push_back({word.tick, word.kind == SeatWord::Kind::value ? std::optional(word.value) : std::nullopt});
    }
    if (word.kind == SeatWord::Kind::through) {
      followed_ = std::max(followed_, word.tick + 1);
      processor_ns_ = std::max(processor_ns_, word.number);
    }
    if (word.kind == SeatWord::Kind::deviates && (!deviates_ || word.tick < *deviates_)) deviates_ = word.tick;
    if (word.kind != SeatWord::Kind::began) continue;
    ++(word.number == 1 ? taken_over_ : begun_);
    if (word.number != 1) is_brought_back_ = word.number == 2;
  }
  return true;
}

std::optional<double> SeatBook::value(std::string_view id, std::uint64_t tick) {
  const auto found = std::ranges::find(ids_, id);
  if (found == ids_.end() || (deviates_ && tick >= *deviates_)) return {};
  std::deque<Since>& values = values_[static_cast<std::size_t>(found - ids_.begin())];
  while (values.size() > 1 && values[1].tick <= tick) values.pop_front();
  return values.empty() || values.front().tick > tick ? std::nullopt : values.front().value;
}

}  // namespace app
