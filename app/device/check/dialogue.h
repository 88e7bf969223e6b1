// Questions to a person, answered line by line. `q` or the end of the input ends every question without an answer: the
// caller then lets go and leaves. An invalid answer is asked again. One thread.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace app {

class Dialogue {
 public:
  Dialogue(std::istream& answers, std::ostream& words) : answers_(answers), words_(words) {}

  void say(const std::string& text);
  /// True once the user did it.
  bool confirm(const std::string& to_do);
  /// The first letter of the answer, one of `letters`.
  std::optional<char> choice(const std::string& question, std::string_view letters);
  /// 30.6 or 30,6.
  std::optional<double> number(const std::string& question, double min, double max);

  /// The user wants to leave.
  bool isOver() const { return over_; }

 private:
  std::optional<std::string> line(const std::string& prompt);

  std::istream& answers_;
  std::ostream& words_;
  bool over_ = false;
};

enum class OwnerTask { rest, hold, first_button, second_button, let_go, upper_corner, lower_corner };

/// Who holds the device while it is checked. A person follows the dialogue; a simulated owner is called here.
class Owner {
 public:
  virtual ~Owner() = default;
  virtual void perform(OwnerTask /*task*/) {}
};

}  // namespace app
