#include "haptics/device/usb/usb_outbox.h"

#include <utility>

namespace haptics {

void UsbOutbox::send(const UsbReport& report, std::uint32_t rests, std::int64_t now_ns) noexcept {
  wanted_.publish({report, rests, ++sent_number_, now_ns});
}

void UsbOutbox::requestLast(const UsbReport& report, std::int64_t deadline_ns) noexcept {
  Phase open = Phase::open;
  if (!phase_.compare_exchange_strong(open, Phase::writing)) return;
  last_ = report;
  last_deadline_ns_ = deadline_ns;
  Phase writing = Phase::writing;
  phase_.compare_exchange_strong(writing, Phase::last_wanted);
}

std::optional<UsbReport> UsbOutbox::next(std::int64_t now_ns) noexcept {
  const Phase phase = phase_.load();
  if (phase == Phase::over || phase == Phase::writing) return {};
  if (phase == Phase::last_wanted) return nextLast(now_ns);

  rests_under_way_ = rests_.load();
  resting_ |= rests_under_way_ != rests_sent_;
  if (rests_under_way_ != rests_sent_) return rest_;

  const Outgoing& newest = wanted_.read();
  const bool is_new = newest.number != number_taken_;
  const bool is_old = rest_after_ns_ > 0 && now_ns - newest.made_ns >= rest_after_ns_;
  const bool goes_out = is_new && !is_old && newest.rests == rests_under_way_;
  if (is_new) replaced_.fetch_add(newest.number - number_taken_ - (goes_out ? 1 : 0), std::memory_order_relaxed);
  number_taken_ = newest.number;
  made_at_ns_ = newest.made_ns;
  if (goes_out) {
    resting_ = false;
    return newest.report;
  }
  if (resting_ || !is_old) return {};
  silences_.fetch_add(1, std::memory_order_relaxed);
  resting_ = true;
  return rest_;
}

std::optional<UsbReport> UsbOutbox::nextLast(std::int64_t now_ns) noexcept {
  if (std::exchange(last_tried_, true) && now_ns >= last_deadline_ns_) {
    end(false);
    return {};
  }
  last_under_way_ = true;
  return last_;
}

void UsbOutbox::taken() noexcept {
  if (std::exchange(last_under_way_, false))
    end(true);
  else
    rests_sent_ = rests_under_way_;
}

void UsbOutbox::notTaken() noexcept {
  last_under_way_ = false;
  resting_ = false;
}

std::int64_t UsbOutbox::nextCheck_ns(std::int64_t never_ns) const noexcept {
  return !resting_ && rest_after_ns_ > 0 ? made_at_ns_ + rest_after_ns_ : never_ns;
}

void UsbOutbox::end(bool taken) noexcept {
  if (phase_.load() == Phase::over) return;
  last_taken_.store(taken);
  phase_.store(Phase::over);
}

}  // namespace haptics
