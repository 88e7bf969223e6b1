// Questions to a person, answered line by line. `q` or the end of the input ends every question with none: the caller
// lets go and leaves. What is no answer is asked again. One thread.
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
  /// True once they did it.
  bool asked(const std::string& to_do);
  /// The first letter of the answer, one of `letters`.
  std::optional<char> choice(const std::string& question, std::string_view letters);
  /// 30.6 or 30,6.
  std::optional<double> number(const std::string& question, double least, double most);

  /// They want to leave.
  bool isOver() const { return over_; }

 private:
  std::optional<std::string> line(const std::string& prompt);

  std::istream& answers_;
  std::ostream& words_;
  bool over_ = false;
};

}  // namespace app
