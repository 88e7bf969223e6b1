#include "haptics/device/usb/usb_pump.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>

#include "haptics/device/monotonic_clock.h"

namespace haptics {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
/// Failures in a row, with pauses growing to 64 ms: about a second, then the handle is dead.
constexpr int kMaxFailures = 20;
constexpr int kMaxPause_ms = 64;
/// The longest sleep when nothing is due.
constexpr std::int64_t kMaxSleep_ns = 100 * kMillisecond_ns;
/// Between two checks while sendLast() waits.
constexpr std::int64_t kWait_ns = kMillisecond_ns / 2;

/// Best effort.
void requestPriority(int priority) noexcept {
  sched_param param{};
  param.sched_priority = priority;
  pthread_setschedparam(pthread_self(), SCHED_FIFO, &param);
  pthread_setname_np(pthread_self(), "molar-usb");
}

void count(std::atomic<std::uint64_t>& counter) noexcept { counter.fetch_add(1, std::memory_order_relaxed); }

}  // namespace

UsbPump::UsbPump(UsbLink& link, const UsbStream& stream)
    : link_(link),
      stream_(stream),
      outbox_(stream.rest, toNs(stream.rest_after)),
      out_(link, link.out(), UsbReport::kMaxBytes) {
  for (int i = 0; i < std::max(1, stream_.in_flight); ++i) ins_.emplace_back(link, link.in(), link.in().packet_bytes);
  thread_ = std::thread([this] { run(); });
}

UsbPump::~UsbPump() { stop(); }

void UsbPump::stop() noexcept {
  quit_.store(true);
  wake_.raise();
  if (thread_.joinable()) thread_.join();
}

// ---- the servo thread

const UsbReport& UsbPump::newestReport() noexcept {
  const UsbReport& report = received_.read();
  serial_seen_ = report.serial;
  return report;
}

bool UsbPump::awaitReport(std::int64_t deadline_ns) noexcept {
  while (received_.read().serial == serial_seen_)
    if (!received_signal_.awaitUntil(deadline_ns)) return received_.read().serial != serial_seen_;
  return true;
}

void UsbPump::send(const UsbReport& report, std::uint32_t rests) noexcept {
  outbox_.send(report, rests, link_.clock().now_ns());
  wake_.raise();
}

// ---- any thread

void UsbPump::rest() noexcept {
  outbox_.rest();
  wake_.raise();
}

bool UsbPump::sendLast(const UsbReport& report, std::chrono::milliseconds within) noexcept {
  const std::int64_t deadline_ns = link_.clock().now_ns() + toNs(within);
  outbox_.requestLast(report, deadline_ns);
  wake_.raise();
  const timespec pause{0, kWait_ns};
  while (!outbox_.isOver() && link_.clock().now_ns() < deadline_ns)
    clock_nanosleep(CLOCK_MONOTONIC, 0, &pause, nullptr);
  return outbox_.isOver() && outbox_.lastWasTaken();
}

UsbCounters UsbPump::counters() const noexcept {
  const auto read = [](const std::atomic<std::uint64_t>& counter) { return counter.load(std::memory_order_relaxed); };
  UsbCounters c;
  c.reports_in = read(counted_.reports_in);
  c.reports_out = read(counted_.reports_out);
  c.replaced_out = outbox_.replaced();
  c.silences = outbox_.silences();
  c.in_timeouts = read(counted_.in_timeouts);
  c.out_timeouts = read(counted_.out_timeouts);
  c.stalls = read(counted_.stalls);
  c.short_reports = read(counted_.short_reports);
  c.overlong_reports = read(counted_.overlong_reports);
  c.errors = read(counted_.errors);
  return c;
}

// ---- the event thread

void UsbPump::run() noexcept {
  requestPriority(stream_.priority);
  while (!quit_.load()) {
    std::int64_t now_ns = link_.clock().now_ns();
    if (gone_) {
      outbox_.close();
      wake_.awaitUntil(monotonic_ns() + kMaxSleep_ns);
      continue;
    }
    clearHalt(link_.in(), in_health_);
    clearHalt(link_.out(), out_health_);
    submitIn(now_ns);
    submitOut(now_ns);
    if (!link_.pump(nextCheck_ns(now_ns), wake_.descriptor())) gone_ = true;
    wake_.lower();
    now_ns = link_.clock().now_ns();
    settleIn(now_ns);
    settleOut(now_ns);
    updateState(now_ns);
  }
  cancelAll();
}

void UsbPump::submitIn(std::int64_t now_ns) noexcept {
  if (in_health_.halted || now_ns < in_health_.again_at_ns) return;
  for (UsbTransfer& in : ins_)
    if (!in.inFlight() && !in.finished()) in.submit(in.buffer().size(), now_ns + toNs(stream_.in_deadline));
}

void UsbPump::submitOut(std::int64_t now_ns) noexcept {
  if (out_.inFlight() || out_.finished() || out_health_.halted || now_ns < out_health_.again_at_ns) return;
  const std::optional<UsbReport> report = outbox_.next(now_ns);
  if (!report) return;
  std::copy_n(report->bytes.begin(), report->size, out_.buffer().begin());
  out_.submit(report->size, now_ns + toNs(stream_.out_deadline));
}

void UsbPump::settleIn(std::int64_t now_ns) noexcept {
  for (;;) {
    UsbTransfer* first = nullptr;
    for (UsbTransfer& in : ins_) {
      in.expire(now_ns);
      gone_ |= in.isDead(now_ns, toNs(stream_.dead_after));
      if (in.finished() && (!first || in.order() < first->order())) first = &in;
    }
    if (!first) return;
    first->takeFinished();
    if (first->overflowed()) {
      count(counted_.overlong_reports);
    } else if (first->outcome() == UsbOutcome::done) {
      in_health_ = {};
      receive(first->moved(), now_ns);
    } else if (first->outcome() == UsbOutcome::late) {
      if (!in_health_.halted) count(counted_.in_timeouts);
    } else {
      settleTrouble(first->outcome(), in_health_, now_ns);
      // A halted pipe can be cleared only without transfers in flight.
      for (UsbTransfer& in : ins_) in.cancel();
    }
  }
}

void UsbPump::receive(std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept {
  std::optional<UsbReport> report;
  if (stream_.reader) {
    report = stream_.reader(bytes);
  } else if (bytes.size() < stream_.report_bytes) {
    count(counted_.short_reports);
  } else if (bytes.size() > stream_.report_bytes) {
    count(counted_.overlong_reports);
  } else {
    report.emplace(bytes);
  }
  if (!report) return;
  count(counted_.reports_in);
  received_at_ns_ = now_ns;
  report->serial = ++serial_;
  report->received_ns = now_ns;
  received_.publish(*report);
  received_signal_.raise();
}

void UsbPump::settleOut(std::int64_t now_ns) noexcept {
  out_.expire(now_ns);
  gone_ |= out_.isDead(now_ns, toNs(stream_.dead_after));
  if (!out_.takeFinished()) return;
  if (out_.outcome() == UsbOutcome::done) {
    out_health_ = {};
    out_late_ = false;
    count(counted_.reports_out);
    outbox_.taken();
    return;
  }
  outbox_.notTaken();
  if (out_.outcome() == UsbOutcome::late) {
    out_late_ = true;
    count(counted_.out_timeouts);
  } else {
    settleTrouble(out_.outcome(), out_health_, now_ns);
  }
}

void UsbPump::settleTrouble(UsbOutcome outcome, Health& health, std::int64_t now_ns) noexcept {
  if (outcome == UsbOutcome::gone) {
    gone_ = true;
  } else if (outcome == UsbOutcome::stalled) {
    if (!health.halted) count(counted_.stalls);
    health.halted = true;
  } else {
    count(counted_.errors);
    const int pause_ms = std::min(kMaxPause_ms, 1 << std::min(health.failures, 6));
    health.again_at_ns = now_ns + pause_ms * kMillisecond_ns;
    gone_ |= ++health.failures > kMaxFailures;
  }
}

void UsbPump::clearHalt(const UsbPipe& pipe, Health& health) noexcept {
  if (!health.halted || health.clearings >= stream_.max_clearings) return;
  const bool is_out = &health == &out_health_;
  if (is_out ? out_.inFlight() : std::ranges::any_of(ins_, &UsbTransfer::inFlight)) return;
  ++health.clearings;
  health.halted = !link_.clearHalt(pipe);
}

void UsbPump::updateState(std::int64_t now_ns) noexcept {
  const bool silent = serial_ == 0 || now_ns - received_at_ns_ > toNs(stream_.late_after);
  state_.store(gone_                                     ? UsbState::gone
               : in_health_.halted || out_health_.halted ? UsbState::stalled
               : silent || out_late_                     ? UsbState::late
                                                         : UsbState::ok);
}

std::int64_t UsbPump::nextCheck_ns(std::int64_t now_ns) const noexcept {
  std::int64_t next_ns = now_ns + kMaxSleep_ns;
  const auto by = [&](std::int64_t at_ns) {
    if (at_ns > now_ns) next_ns = std::min(next_ns, at_ns);
  };
  for (const UsbTransfer& in : ins_)
    if (in.inFlight()) by(in.deadline_ns());
  if (out_.inFlight()) by(out_.deadline_ns());
  by(received_at_ns_ + toNs(stream_.late_after) + 1);
  by(outbox_.nextCheck_ns(next_ns));
  by(in_health_.again_at_ns);
  by(out_health_.again_at_ns);
  // A transfer that finished during submission does not wait.
  if (out_.finished() || std::ranges::any_of(ins_, &UsbTransfer::finished)) return now_ns;
  return next_ns;
}

bool UsbPump::anyInFlight() const noexcept {
  return out_.inFlight() || std::ranges::any_of(ins_, &UsbTransfer::inFlight);
}

void UsbPump::cancelAll() noexcept {
  outbox_.close();
  for (UsbTransfer& in : ins_) in.cancel();
  out_.cancel();
  const std::int64_t until_ns = link_.clock().now_ns() + toNs(stream_.dead_after);
  while (anyInFlight() && link_.clock().now_ns() < until_ns)
    if (!link_.pump(link_.clock().now_ns() + kMillisecond_ns, -1)) break;
  if (anyInFlight()) gone_ = true;
}

}  // namespace haptics
