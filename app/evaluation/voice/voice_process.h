// `molar voice`: the process beside a session that records the voice into its folder and says when somebody speaks
// (voice_words). Never in the rehearsal's process, low priority, off the servo's core; ends when the session does. It
// opens the microphone when it is started, which is after the consent. Linux.
#pragma once

#include <string>

namespace app {

struct VoiceOptions {
  std::string folder, file;    ///< of the recording; the sound that stands for a microphone, empty: the default input
  int words = -1;              ///< descriptor
  int key = -1;                ///< descriptor to read 32 bytes from: what is stored is sealed with them; -1: it is not
  std::string session;         ///< name for the seal
  int played = -1;             ///< descriptor of a PlayedSound; -1: nothing is played
  bool is_clock_told = false;  ///< time is what the session says, else the steady clock's
};

/// The exit status.
int runVoice(const VoiceOptions& options);

}  // namespace app
