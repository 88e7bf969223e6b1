// A questionnaire as TOML: items, scale and how it is scored. The shipped ones are part of the program; a site may add
// its own file. Strict: what is wrong or misspelt is refused in one line. Start-up; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/study/published_summary.h"

namespace app {

struct QuestionItem {
  std::string id;        ///< the head of its column: "V1"
  std::string category;  ///< empty: none
  std::string says;
  std::string name;                  ///< short, "Effort"; empty: none
  std::vector<std::string> choices;  ///< of a comparison: 1 for the first, 2 for the second; empty: on the scale
  std::optional<PublishedSummary> published = {};  ///< by the study that the questionnaire is of; none: not printed
};

enum class Scoring {
  categories,  ///< each item, and the mean of those of a category
  sus,         ///< Brooke 1996: odd items x - low, even ones high - x; 2.5 times the sum
  mean,        ///< of all items: the raw NASA task load index
  words,       ///< answers are sentences
  weighted,    ///< and every pair of items compared: each item times how often it was chosen, over the pairs
};

struct Questionnaire {
  std::string id, title, source;
  int low = 1, high = 7;
  std::vector<std::string> scale;  ///< of each step, or of both ends; empty for words
  Scoring scoring = Scoring::categories;
  std::vector<QuestionItem> items;
  std::string published_note;  ///< on what is published beside its items; empty: nothing

  /// What an item may be answered with.
  int lowOf(const QuestionItem& item) const { return item.choices.empty() ? low : 1; }
  int highOf(const QuestionItem& item) const {
    return item.choices.empty() ? high : static_cast<int>(item.choices.size());
  }
  /// In the order of the items.
  std::vector<std::string> categories() const;
  bool isOfWords() const { return scoring == Scoring::words; }
};

/// Score of one participant's answers, in the order of the items; none: too many are missing (SUS more than one, whose
/// place the middle of the scale takes; the others any).
std::optional<double> scoreOf(const Questionnaire& questionnaire, const std::vector<std::optional<double>>& answers);

/// How often each item on the scale was chosen before another, 0 to one less than there are; none: not of comparisons,
/// or one is missing.
std::optional<std::vector<double>> weightsOf(const Questionnaire& questionnaire,
                                             const std::vector<std::optional<double>>& answers);

std::vector<std::string> shippedQuestionnaires();
/// A shipped one by name, or the file of a name that ends in .toml. Throws UsageError for another name, LoadError for
/// what is wrong in a file.
Questionnaire questionnaireNamed(const std::string& name);
/// The shipped file's text, to be copied and edited.
std::string shippedQuestionnaireText(const std::string& name);

}  // namespace app
