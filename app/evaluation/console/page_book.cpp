#include "app/evaluation/console/page_book.h"

namespace app {

PageBook::Known PageBook::known(const std::string& page, std::uint64_t number) const {
  const auto found = known_.find({page, number});
  if (found != known_.end()) return found->second;
  return known_.size() < kMostTaken ? Known::no : Known::too_many;
}

std::string PageBook::why(const std::string& page, std::uint64_t number) const {
  const auto found = why_.find({page, number});
  return found == why_.end() ? "" : found->second;
}

void PageBook::begin(const std::string& page, std::uint64_t number) { known_[{page, number}] = Known::waiting; }

void PageBook::refuse(const std::string& page, std::uint64_t number, std::string why) {
  known_[{page, number}] = Known::refused;
  why_[{page, number}] = std::move(why);
}

void PageBook::accept(const std::string& page, std::uint64_t number, std::size_t events) {
  known_[{page, number}] = Known::waiting;
  accepted_.push_back({{page, number}, events});
}

std::vector<std::pair<std::string, std::uint64_t>> PageBook::takeSafe(
    const std::function<bool(std::size_t events)>& is_safe) {
  std::vector<Key> safe;
  while (!accepted_.empty() && is_safe(accepted_.front().events)) {
    known_[accepted_.front().key] = Known::safe;
    safe.push_back(std::move(accepted_.front().key));
    accepted_.pop_front();
  }
  return safe;
}

}  // namespace app
