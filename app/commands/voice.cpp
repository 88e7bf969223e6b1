// `molar voice`: the process beside a session that records the voice, started by it.

#include <memory>

#include "app/commands/command.h"
#include "app/evaluation/voice/voice_process.h"
#include "app/text/command_line.h"

namespace app {

void addVoice(CommandLine& molar) {
  auto options = std::make_shared<VoiceOptions>();
  CommandLine& command =
      molar.command("voice", "Records the voice of a session beside it; molar evaluate starts it after the consent");
  command.forEngineers();
  command.option("--folder", options->folder, "Of the recording; one of a process that died is gone on with")
      .required();
  command.option("--words", options->words, "Descriptor to answer on").wholeFrom(3, 1'000'000).required();
  command.option("--key", options->key, "Descriptor of the key that all is sealed with").wholeFrom(3, 1'000'000);
  command.option("--session", options->session, "Its name, for the seal");
  command.option("--file", options->file, "Sound that stands for a microphone, 48 kHz");
  command.option("--played", options->played, "Descriptor of what is handed to the sound card").wholeFrom(3, 1'000'000);
  command.flag("--told", options->is_clock_told, "Time is what the session says");
  command.does([options] { return runVoice(*options); });
}

}  // namespace app
