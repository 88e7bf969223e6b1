// The start screen as a state machine: lists of choices, one of each chosen, one list under the keys. What is chosen
// are arguments of `molar rehearse` or `molar check`, so that the start screen cannot mean anything that the command
// line does not. Plain values; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/display/window.h"

namespace app {

/// What is done: a third molar is removed, or one tooth is treated or prepared.
enum class StartTask : std::uint8_t { extraction, root_canal, preparation };

struct StartChoice {
  std::string words;   ///< in its list
  std::string beside;  ///< at the right edge, quieter; empty: nothing
  std::string about;   ///< what it means, one or two lines
  std::vector<std::string> arguments;
  std::string why_not = "";  ///< cannot be started, and what to do; empty: it can
  /// Of a patient: imported. Of a session to go on with: of an imported patient, which is to be chosen beside it.
  bool is_imported = false;
  bool has_mouth = true;                   ///< of a case: a face whose mouth opens
  bool is_to_check = false;                ///< of a patient: what was found in its scan is looked at before a rehearsal
  StartTask task = StartTask::extraction;  ///< of a task
  int fdi = 0;                             ///< of a tooth, and of a built-in case its third molar; 0: none
  bool is_of_extraction = false;           ///< of a hand: it removes a third molar and nothing else
};

struct StartList {
  std::string title;
  std::vector<StartChoice> choices;  ///< at least one
  std::size_t chosen = 0;
  const StartChoice& choice() const { return choices[chosen]; }
};

/// With a recorded session, which brings its own case.
inline bool goesOn(const StartChoice& choice) {
  return !choice.arguments.empty() && choice.arguments.front() == "--continue";
}

/// In the order of Tab.
enum class StartListName : std::uint8_t { cases, tasks, teeth, hand, calibration, position, opening, sessions };
inline constexpr std::size_t kStartLists = 8;
using StartLists = std::vector<StartList>;

class StartMenu {
 public:
  enum class Answer : std::uint8_t { none, start, leave };

  /// kStartLists of them.
  explicit StartMenu(StartLists lists) : lists_(std::move(lists)) {}

  Answer take(const render::KeyPressed& key);
  void choose(std::size_t list, std::size_t choice);
  /// The wheel over a list: down is positive. A list that does not count stays.
  void scroll(std::size_t list, int by);
  /// Refused with a message where a choice cannot be started.
  Answer start();

  const StartLists& lists() const { return lists_; }
  std::size_t focus() const { return focus_; }
  /// A session to go on with brings its own case and task, but not an imported patient; only a built-in one has a mouth
  /// to open; a tooth is chosen where a task is of one.
  bool isOverruled(std::size_t list) const;
  /// A patient that is to be checked first is chosen, for a new rehearsal.
  bool startsCheck() const;
  /// It was looked at: the next start rehearses it, confirmed or not.
  void rehearseAsItIs(const std::string& patient_folder);
  /// Of `molar`: "rehearse", then those of all choices; or "check" and the patient.
  std::vector<std::string> arguments() const;

  /// How the rehearsal ended, or why it did not start (`trouble`); until the next key or click.
  void say(const std::string& message, bool trouble) { message_ = message, is_trouble_ = trouble; }
  const std::string& message() const { return message_; }
  bool isTrouble() const { return is_trouble_; }
  /// The session recorded last; empty: none.
  std::string newestSession() const;
  /// Of the choices, list by list; for chooseAsIn().
  std::vector<std::string> chosenWords() const;
  /// Takes over what was chosen there, where it is still offered; sessions begin anew.
  void chooseAsIn(const std::vector<std::string>& chosen_words);

 private:
  const StartChoice& chosen(StartListName list) const { return lists_[static_cast<std::size_t>(list)].choice(); }
  std::string contradiction() const;
  void followSide(std::size_t changed);
  void moveFocus(int by);
  void moveChoice(std::size_t list, int by);

  StartLists lists_;
  std::size_t focus_ = 0;
  std::string message_;
  bool is_trouble_ = false;
};

}  // namespace app
