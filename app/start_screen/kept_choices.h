// What was chosen at the last start, for the next one: one line of text a choice, in the user's data folder. What is
// not offered any more is left out; a file that is damaged, or cannot be read or written, costs the choices only. Main
// thread; one small file.
#pragma once

#include <string>
#include <vector>

namespace app {

/// StartMenu::chosenWords() of the last start; empty: none.
std::vector<std::string> keptChoices();

void keepChoices(const std::vector<std::string>& words);

}  // namespace app
