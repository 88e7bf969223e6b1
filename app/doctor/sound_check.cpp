#include "app/doctor/checks.h"
#include "app/text/list.h"

namespace app {

Finding checkSound(const Machine& machine) {
  // " 0 [PCH            ]: HDA-Intel - HDA Intel PCH", and a second line of detail.
  std::vector<std::string> cards;
  for (const std::string& line : linesOf(machine.proc / "asound/cards")) {
    const std::size_t name = line.find("]: ");
    if (name != std::string::npos) cards.push_back(line.substr(name + 3));
  }
  std::error_code none;
  const bool has_pipewire = std::filesystem::exists(machine.runtime / "pipewire-0", none);
  const bool has_pulse = std::filesystem::exists(machine.runtime / "pulse/native", none);
  const std::string server = has_pipewire ? "PipeWire" : has_pulse ? "PulseAudio" : "";
  if (cards.empty() && server.empty())
    return {"sound", Health::warn, "There is no sound card: the drill is felt and seen, not heard.",
            "Plug in a sound card or a headset if you want to hear it."};
  if (server.empty())
    return {"sound", Health::ok, joined(cards) + ", without a sound server: one program at a time.",
            "sudo apt install pipewire-audio shares it between programs."};
  return {"sound", Health::ok, (cards.empty() ? "No card of its own" : joined(cards)) + ", by " + server + "."};
}

}  // namespace app
