// The default input of the machine's sound, mono, through PortAudio. Without one, one line says so. Construction and
// destruction take up to a second while cards are searched. `take` runs on PortAudio's thread: it must not wait,
// allocate or throw.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

namespace app {

class SoundInput {
 public:
  /// Samples -1..1, the newest last. `overrun`: some before them, nobody knows how many, were lost.
  using Take = std::function<void(std::span<const float> samples, bool overrun)>;

  /// `report`: called once with why nothing will be heard.
  SoundInput(double rate_Hz, Take take, const std::function<void(const std::string&)>& report);
  ~SoundInput();
  SoundInput(const SoundInput&) = delete;
  SoundInput& operator=(const SoundInput&) = delete;

  bool isAvailable() const;

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace app
