// A questionnaire as TOML: items, scale and how it is scored. The shipped ones are part of the program; a site may add
// its own file. Strict: what is wrong or misspelt is refused in one line. Start-up; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace app {

struct QuestionItem {
  std::string id;        ///< the head of its column: "V1"
  std::string category;  ///< empty: none
  std::string says;
};

enum class Scoring {
  categories,  ///< each item, and the mean of those of a category
  sus,         ///< Brooke 1996: odd items x - low, even ones high - x; 2.5 times the sum
  mean,        ///< of all items: the raw NASA task load index
  words,       ///< answers are sentences
};

struct Questionnaire {
  std::string id, title, source;
  int low = 1, high = 7;
  std::vector<std::string> scale;  ///< of each step, or of both ends; empty for words
  Scoring scoring = Scoring::categories;
  std::vector<QuestionItem> items;

  /// In the order of the items.
  std::vector<std::string> categories() const;
  bool isOfWords() const { return scoring == Scoring::words; }
};

/// Score of one participant's answers, in the order of the items; none: too many are missing (SUS more than one, whose
/// place the middle of the scale takes; the mean and words any).
std::optional<double> scoreOf(const Questionnaire& questionnaire, const std::vector<std::optional<double>>& answers);

std::vector<std::string> shippedQuestionnaires();
/// A shipped one by name, or the file of a name that ends in .toml. Throws UsageError for another name, LoadError for
/// what is wrong in a file.
Questionnaire questionnaireNamed(const std::string& name);
/// The shipped file's text, to be copied and edited.
std::string shippedQuestionnaireText(const std::string& name);

}  // namespace app
