// Pictures of something over a session, each from its time until the next: kept where it changed, thinned where there
// are too many, so that memory is bounded. Any one thread.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace app {

template <class Content>
class Film {
 public:
  struct Picture {
    double t_s = 0.0;
    std::uint64_t serial = 0;  ///< from 1, no two alike
    Content content;
  };

  /// `between_s`: shortest time between two; doubled each time every second of `most` is dropped.
  Film(std::size_t most, double between_s) : most_(most), between_s_(between_s) {}

  bool isDue(double t_s) const { return t_s >= next_s_; }
  /// In order of time. The first is never dropped.
  void keep(double t_s, Content content) {
    pictures_.push_back({t_s, ++serial_, std::move(content)});
    next_s_ = t_s + between_s_;
    if (pictures_.size() <= most_) return;
    std::vector<Picture> left;
    for (std::size_t n = 0; n < pictures_.size(); n += 2) left.push_back(std::move(pictures_[n]));
    pictures_ = std::move(left);
    between_s_ *= 2.0;
  }

  /// The newest that was kept by then; null: none was. Holds until the next is kept.
  const Picture* at(double t_s) const {
    const auto after = std::ranges::upper_bound(pictures_, t_s, {}, &Picture::t_s);
    return after == pictures_.begin() ? nullptr : &*std::prev(after);
  }
  const Picture* newest() const { return pictures_.empty() ? nullptr : &pictures_.back(); }
  std::size_t size() const { return pictures_.size(); }

 private:
  std::size_t most_;
  double between_s_, next_s_ = 0.0;
  std::uint64_t serial_ = 0;
  std::vector<Picture> pictures_;
};

}  // namespace app
