// The default output of the machine's sound, mono, through PortAudio. Without a card there is silence and one line that
// says so. Construction and destruction take up to a second while cards are searched; sound
// libraries are silenced, stderr is not touched. `fill` runs on PortAudio's thread: it must not wait, allocate or
// throw.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

namespace app {

class SoundCard {
 public:
  /// Samples -1..1 of the next piece of sound.
  using Fill = std::function<void(std::span<float> samples)>;

  /// `make`: called once with the rate in Hz, before the first sample is asked for. `report`: called once with why
  /// there will be no sound.
  SoundCard(const std::function<Fill(double rate_Hz)>& make, const std::function<void(const std::string&)>& report);
  ~SoundCard();
  SoundCard(const SoundCard&) = delete;
  SoundCard& operator=(const SoundCard&) = delete;

  bool isAvailable() const;
  /// From a sample that is filled to the ear, as the card reports it; 0 without one.
  double latency_s() const;

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace app
