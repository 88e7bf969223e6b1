#include "app/start_screen/start_menu.h"

#include <algorithm>

namespace app {
namespace {

constexpr auto kCases = static_cast<std::size_t>(StartListName::cases),
               kTasks = static_cast<std::size_t>(StartListName::tasks),
               kTeeth = static_cast<std::size_t>(StartListName::teeth),
               kOpening = static_cast<std::size_t>(StartListName::opening),
               kSessions = static_cast<std::size_t>(StartListName::sessions);

/// 4 of 46.
int quadrantOf(int fdi) { return fdi / 10; }

}  // namespace

StartMenu::Answer StartMenu::take(const render::KeyPressed& key) {
  using render::Key;
  if (!key.down) return Answer::none;
  // A key held down moves, but neither starts nor leaves.
  if (!key.repeated) {
    if (key.key == Key::escape) return Answer::leave;
    if (key.key == Key::enter) return start();
  }
  message_.clear();
  if (key.key == Key::tab) moveFocus(key.shift ? -1 : 1);
  if (key.key == Key::right) moveFocus(1);
  if (key.key == Key::left) moveFocus(-1);
  if (key.key == Key::down) moveChoice(focus_, 1);
  if (key.key == Key::up) moveChoice(focus_, -1);
  if (key.key == Key::home) moveChoice(focus_, -static_cast<int>(lists_[focus_].choices.size()));
  if (key.key == Key::end) moveChoice(focus_, static_cast<int>(lists_[focus_].choices.size()));
  return Answer::none;
}

/// Lists that are overruled are passed over.
void StartMenu::moveFocus(int by) {
  const auto count = static_cast<int>(lists_.size());
  do {
    focus_ = static_cast<std::size_t>((static_cast<int>(focus_) + by + count) % count);
  } while (isOverruled(focus_));
}

void StartMenu::moveChoice(std::size_t which, int by) {
  StartList& list = lists_[which];
  const auto last = static_cast<int>(list.choices.size()) - 1;
  list.chosen = static_cast<std::size_t>(std::clamp(static_cast<int>(list.chosen) + by, 0, last));
  followSide(which);
}

/// A built-in jaw has the teeth of one side: the case follows the tooth, and the tooth the case.
void StartMenu::followSide(std::size_t changed) {
  if (changed != kCases && changed != kTeeth) return;
  const int own = lists_[changed].choice().fdi;
  StartList& other = lists_[changed == kCases ? kTeeth : kCases];
  if (own == 0 || other.choice().fdi == 0 || quadrantOf(own) == quadrantOf(other.choice().fdi)) return;
  const auto fits = [&](const StartChoice& choice) {
    const bool is_alike = changed == kTeeth || choice.fdi % 10 == other.choice().fdi % 10;
    return choice.fdi != 0 && quadrantOf(choice.fdi) == quadrantOf(own) && is_alike;
  };
  const auto found = std::ranges::find_if(other.choices, fits);
  if (found != other.choices.end()) other.chosen = static_cast<std::size_t>(found - other.choices.begin());
}

void StartMenu::choose(std::size_t list, std::size_t choice) {
  message_.clear();
  if (list >= lists_.size() || choice >= lists_[list].choices.size()) return;
  // Whoever points at a case means a new rehearsal; a mouth is opened with its case chosen before.
  if (isOverruled(list)) {
    if (list == kOpening && (lists_[kCases].choice().is_imported || !lists_[kCases].choice().has_mouth)) return;
    if (list == kTeeth && chosen(StartListName::tasks).task == StartTask::extraction) return;
    lists_[kSessions].chosen = 0;
  }
  focus_ = list;
  lists_[list].chosen = choice;
  followSide(list);
}

void StartMenu::scroll(std::size_t list, int by) {
  if (list >= lists_.size() || isOverruled(list)) return;
  message_.clear();
  focus_ = list;
  moveChoice(list, by);
}

StartMenu::Answer StartMenu::start() {
  for (std::size_t n = 0; n < lists_.size(); ++n)
    if (const StartChoice& choice = lists_[n].choice(); !isOverruled(n) && !choice.why_not.empty()) {
      say(choice.words + ": " + choice.why_not, true);
      return Answer::none;
    }
  if (lists_[kSessions].choice().is_imported && !lists_[kCases].choice().is_imported) {
    say("This session is of an imported patient: choose that patient under " + lists_[kCases].title + ".", true);
    return Answer::none;
  }
  if (const std::string why_not = contradiction(); !why_not.empty()) {
    say(why_not, true);
    return Answer::none;
  }
  message_.clear();
  return Answer::start;
}

/// Choices that do not go together; empty: they do.
std::string StartMenu::contradiction() const {
  const StartTask task = chosen(StartListName::tasks).task;
  const StartChoice& hand = chosen(StartListName::hand);
  if (goesOn(lists_[kSessions].choice()) || task == StartTask::extraction) return "";
  if (!chosen(StartListName::cases).has_mouth)
    return "A practice block has no tooth: choose a patient under " + lists_[kCases].title + ".";
  if (hand.is_of_extraction) return hand.words + ": it removes a third molar, choose another hand.";
  if (task == StartTask::preparation && chosen(StartListName::teeth).fdi == 0)
    return "Choose the tooth to be prepared under " + lists_[kTeeth].title + ".";
  return "";
}

bool StartMenu::isOverruled(std::size_t list) const {
  const bool goes_on = goesOn(lists_[kSessions].choice()), imported_goes_on = lists_[kSessions].choice().is_imported;
  if (list == kOpening) return goes_on || lists_[kCases].choice().is_imported || !lists_[kCases].choice().has_mouth;
  if (list == kTasks) return goes_on;
  if (list == kTeeth) return goes_on || chosen(StartListName::tasks).task == StartTask::extraction;
  return list == kCases && goes_on && !imported_goes_on;
}

bool StartMenu::startsCheck() const {
  return lists_[kCases].choice().is_to_check && !goesOn(lists_[kSessions].choice());
}

void StartMenu::rehearseAsItIs(const std::string& patient_folder) {
  for (StartChoice& choice : lists_[kCases].choices)
    if (choice.is_to_check && choice.arguments.front() == patient_folder) choice.is_to_check = false;
}

std::vector<std::string> StartMenu::arguments() const {
  if (startsCheck()) return {"check", lists_[kCases].choice().arguments.front()};
  std::vector<std::string> all{"rehearse"};
  for (std::size_t n = 0; n < lists_.size(); ++n)
    if (!isOverruled(n)) {
      const std::vector<std::string>& more = lists_[n].choice().arguments;
      all.insert(all.end(), more.begin(), more.end());
    }
  return all;
}

std::string StartMenu::newestSession() const {
  const std::vector<StartChoice>& sessions = lists_[kSessions].choices;
  const auto newest = std::ranges::find_if(sessions, goesOn);
  return newest == sessions.end() ? std::string() : newest->arguments.back();
}

std::vector<std::string> StartMenu::chosenWords() const {
  std::vector<std::string> words;
  for (const StartList& list : lists_) words.push_back(list.choice().words);
  return words;
}

void StartMenu::chooseAsIn(const std::vector<std::string>& chosen_words) {
  for (std::size_t n = 0; n < std::min(lists_.size(), chosen_words.size()); ++n) {
    if (n == kSessions) continue;
    const auto same = std::ranges::find(lists_[n].choices, chosen_words[n], &StartChoice::words);
    if (same != lists_[n].choices.end()) lists_[n].chosen = static_cast<std::size_t>(same - lists_[n].choices.begin());
  }
}

}  // namespace app
