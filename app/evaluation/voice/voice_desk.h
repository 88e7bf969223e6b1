// The voice in a session: begins once the participant allows it, writes into the event log when somebody speaks and
// when a person who should think aloud is quiet for too long, stops and deletes at once where the word is taken back.
// Words are in the recording alone. Main thread, once a frame and between phases; microseconds, but where the ticks are
// the clock (voice_link).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/evaluation/evaluation_course.h"
#include "app/evaluation/voice/microphone.h"
#include "app/evaluation/voice/speech_judge.h"
#include "app/evaluation/voice/voice_link.h"
#include "app/evaluation/voice/voice_state.h"
#include "app/study/privacy/session_seal.h"

namespace app {

class VoiceDesk {
 public:
  struct Parts {
    EvaluationCourse& course;
    MicrophoneChoice microphone;
    double silence_s = 20.0;
    bool steps = false;  ///< the ticks are the clock: only a file can be heard
    int played = -1;     ///< descriptor of a PlayedSound
    std::string program = "/proc/self/exe";
  };
  /// Borrows the course.
  explicit VoiceDesk(Parts parts);
  ~VoiceDesk();

  /// After the consent; `session`: its folder. Opens the microphone where that is allowed, and there is one. `seal`:
  /// what is stored is sealed, borrowed; null: it is not.
  void begin(const std::string& session, SessionSeal* seal, const Moment& at);
  void follow(const Moment& at);
  /// All is stored, and the log has the figures.
  void finish(const Moment& at);

  /// Of what is going to be recorded, for the checks.
  std::string plan() const;
  /// None: nothing is recorded.
  std::optional<VoiceState> state(std::int64_t now_ns) const;
  /// "20 s quiet: What are you doing?", or nothing; to be shown for some seconds.
  std::string reminder(std::int64_t now_ns) const;
  /// What is missing before the tasks may begin: 10 s of speech within the right level. Empty: nothing, or no voice is
  /// recorded.
  std::string missing() const;
  bool isRecording() const { return link_.has_value() && !link_->isOver(); }
  /// That records; 0: none.
  int process() const { return link_ ? link_->process() : 0; }

 private:
  bool canHear() const;
  void take(const VoiceWord& word, const Moment& at);
  void tellEnd(const Moment& at, const std::string& why = "its process ends again and again");
  void withdraw(const Moment& at);
  void remind(const Moment& at);
  void keepTick(const Moment& at);

  Parts parts_;
  std::string folder_;
  SessionSeal* seal_ = nullptr;
  std::optional<VoiceLink> link_;
  QuietWatch quiet_;
  const TaskTemplate* task_ = nullptr;
  VoiceState heard_;
  int starts_ = 0;
  bool has_told_end_ = false;
  std::int64_t reminded_ns_ = 0;
  std::optional<std::int64_t> tick_told_ns_;
  int ticks_ = -1;
};

}  // namespace app
