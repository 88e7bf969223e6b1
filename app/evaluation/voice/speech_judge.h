// From frames of 10 ms, voiced or not, to speech: somebody speaks while 30 % of the last 0.5 s are voiced, and until
// 1 s without that has passed. And when a person who should think aloud has been quiet for too long: one reminder, and
// another only after speech or 60 s. Times ns, passed in. Pure; one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace app {

struct SpeechChange {
  std::int64_t t_ns = 0;
  bool speaks = false;
};

class SpeechJudge {
 public:
  /// A frame of 10 ms that ended then.
  std::optional<SpeechChange> add(bool is_voiced, std::int64_t t_ns);
  bool speaks() const { return speaks_; }

 private:
  std::array<bool, 50> window_{};
  std::size_t next_ = 0, voiced_ = 0;
  bool speaks_ = false;
  std::int64_t spoke_ns_ = 0;
};

class QuietWatch {
 public:
  explicit QuietWatch(double silence_s) : silence_s_(silence_s) {}

  /// From here on, as if speech had ended now: of a task, or after the microphone was away.
  void begin(std::int64_t now_ns);
  void follow(const SpeechChange& change);
  /// True: the person is to be reminded, now.
  bool isDue(std::int64_t now_ns);
  /// Since speech ended; 0 while it goes on.
  double quiet_s(std::int64_t now_ns) const;
  /// It was told, and nothing was said since.
  bool isReminding() const { return reminded_ns_.has_value(); }

 private:
  double silence_s_;
  bool speaks_ = false;
  std::int64_t since_ns_ = 0;
  std::optional<std::int64_t> reminded_ns_;
};

}  // namespace app
