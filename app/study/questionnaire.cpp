#include "app/study/questionnaire.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

struct ShippedQuestionnaire {
  std::string_view name, text;
};
constexpr auto kShippedQuestionnaires = std::to_array<ShippedQuestionnaire>({
#include "shipped_questionnaires.inc"
});

constexpr std::size_t kMostItems = 60, kMostScaleWords = 11, kLongestId = 16, kLongestWords = 300;
constexpr int kMostPublished = 30, kMostPublishedSteps = 10;

std::string wordsFrom(assets::TomlReader& keys, const std::string& table, const std::string& key) {
  std::string words = keys.text(table, key);
  if (words.empty() || words.size() > kLongestWords)
    keys.refuse(table, key, "give 1 to " + std::to_string(kLongestWords) + " bytes of text in quotes");
  return words;
}

std::string idFrom(assets::TomlReader& keys, const std::string& table) {
  const std::string id = keys.text(table, "id");
  const bool is_plain = std::ranges::all_of(id, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
  if (id.empty() || id.size() > kLongestId || !is_plain)
    keys.refuse(table, "id", "give 1 to " + std::to_string(kLongestId) + " letters, digits, '-' or '_'");
  return id;
}

void readScale(assets::TomlReader& keys, Questionnaire& made) {
  made.low = static_cast<int>(keys.integer("", "low", 0, 10));
  made.high = static_cast<int>(keys.integer("", "high", made.low + 1, 100));
  made.scale = keys.texts("", "scale", kMostScaleWords);
  const auto steps = static_cast<std::size_t>(made.high - made.low) + 1;
  if (made.scale.size() != 2 && made.scale.size() != steps)
    keys.refuse("", "scale", "give the words of both ends, or of all " + std::to_string(steps) + " steps");
}

/// What `count` people of another study answered.
std::optional<PublishedSummary> publishedFrom(assets::TomlReader& keys, const std::string& table, std::size_t count,
                                              const Questionnaire& of) {
  PublishedSummary published{count, {}, {}};
  const auto read = [&](const std::string& key, const assets::NumberRange& range) -> std::optional<double> {
    if (!keys.has(table, key)) return {};
    if (count == 0) keys.refuse(table, key, "say of how many answers: published_count above the items");
    return keys.number(table, key, range);
  };
  published.mean = read("published_mean", {static_cast<double>(of.low), static_cast<double>(of.high), ""});
  published.deviation = read("published_deviation", {0.0, static_cast<double>(of.high - of.low), ""});
  return published.mean || published.deviation ? std::optional(published) : std::nullopt;
}

/// Every item with every one after it: the column "mental-effort".
void addComparisons(Questionnaire& made) {
  const std::vector<QuestionItem> scales = made.items;
  for (std::size_t a = 0; a < scales.size(); ++a)
    for (std::size_t b = a + 1; b < scales.size(); ++b)
      made.items.push_back(
          {scales[a].id + "-" + scales[b].id,
           "",
           "Which of the two added more to the workload, " + scales[a].name + " or " + scales[b].name + "?",
           "",
           {scales[a].name, scales[b].name}});
}

Questionnaire questionnaireFrom(assets::TomlReader keys) {
  Questionnaire made;
  made.id = idFrom(keys, "");
  made.title = wordsFrom(keys, "", "title");
  made.source = wordsFrom(keys, "", "source");
  made.scoring = static_cast<Scoring>(keys.choice("", "scoring", {"categories", "sus", "mean", "words", "weighted"}));
  if (!made.isOfWords()) readScale(keys, made);
  std::size_t published_count = 0;
  if (keys.has("", "published_count")) {
    if (made.isOfWords() || made.high - made.low > kMostPublishedSteps)
      keys.refuse("", "published_count", "is for scales of up to eleven steps");
    published_count = static_cast<std::size_t>(keys.integer("", "published_count", 2, kMostPublished));
    made.published_note = keys.text("", "published_note", "");
  }
  const std::size_t count = keys.tables("item", 1, kMostItems);
  std::set<std::string> known{"participant", "group", "session"};
  for (std::size_t n = 1; n <= count; ++n) {
    const std::string table = "item." + std::to_string(n);
    QuestionItem item;
    item.id = idFrom(keys, table);
    if (!known.insert(item.id).second) keys.refuse(table, "id", "another column has this head, give each item its own");
    item.category = keys.text(table, "category", "");
    item.says = wordsFrom(keys, table, "says");
    if (made.scoring == Scoring::weighted) item.name = wordsFrom(keys, table, "name");
    if (made.scoring == Scoring::categories && item.category.empty())
      keys.refuse(table, "category", "an item that is scored by category needs one");
    item.published = publishedFrom(keys, table, published_count, made);
    made.items.push_back(std::move(item));
  }
  if (made.scoring == Scoring::sus && (count != 10 || made.low != 1 || made.high != 5))
    keys.refuse("", "scoring", "SUS has ten items from 1 to 5");
  keys.refuseUnknownKeys();
  if (made.scoring == Scoring::weighted) addComparisons(made);
  return made;
}

const ShippedQuestionnaire* shippedNamed(const std::string& name) {
  const auto found = std::ranges::find(kShippedQuestionnaires, name, &ShippedQuestionnaire::name);
  return found == kShippedQuestionnaires.end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> Questionnaire::categories() const {
  std::vector<std::string> names;
  for (const QuestionItem& item : items)
    if (!item.category.empty() && std::ranges::find(names, item.category) == names.end())
      names.push_back(item.category);
  return names;
}

std::optional<double> scoreOf(const Questionnaire& questionnaire, const std::vector<std::optional<double>>& answers) {
  const auto missing = std::ranges::count_if(answers, [](const std::optional<double>& answer) { return !answer; });
  double sum = 0.0;
  if (questionnaire.scoring == Scoring::sus) {
    if (missing > 1) return {};
    const double middle = 0.5 * (questionnaire.low + questionnaire.high);
    for (std::size_t n = 0; n < answers.size(); ++n) {
      const double answer = answers[n].value_or(middle);
      sum += n % 2 == 0 ? answer - questionnaire.low : questionnaire.high - answer;
    }
    return 2.5 * sum;
  }
  if (questionnaire.scoring == Scoring::weighted) {
    const auto weights = weightsOf(questionnaire, answers);
    if (!weights || missing > 0) return {};
    double pairs = 0.0;
    for (std::size_t n = 0; n < weights->size(); ++n) sum += (*weights)[n] * *answers[n], pairs += (*weights)[n];
    return pairs > 0.0 ? std::optional(sum / pairs) : std::nullopt;
  }
  if (questionnaire.scoring != Scoring::mean || missing > 0 || answers.empty()) return {};
  for (const std::optional<double>& answer : answers) sum += *answer;
  return sum / static_cast<double>(answers.size());
}

std::optional<std::vector<double>> weightsOf(const Questionnaire& questionnaire,
                                             const std::vector<std::optional<double>>& answers) {
  const auto scales = static_cast<std::size_t>(
      std::ranges::count_if(questionnaire.items, [](const QuestionItem& item) { return item.choices.empty(); }));
  if (scales == questionnaire.items.size() || answers.size() != questionnaire.items.size()) return {};
  std::vector<double> weights(scales, 0.0);
  std::size_t at = scales;
  for (std::size_t a = 0; a < scales; ++a)
    for (std::size_t b = a + 1; b < scales; ++b, ++at) {
      if (!answers[at]) return {};
      weights[*answers[at] < 1.5 ? a : b] += 1.0;
    }
  return weights;
}

std::vector<std::string> shippedQuestionnaires() {
  std::vector<std::string> names;
  for (const ShippedQuestionnaire& shipped : kShippedQuestionnaires) names.emplace_back(shipped.name);
  return names;
}

std::string shippedQuestionnaireText(const std::string& name) {
  const ShippedQuestionnaire* shipped = shippedNamed(name);
  return shipped == nullptr ? "" : std::string(shipped->text);
}

Questionnaire questionnaireNamed(const std::string& name) {
  if (name.ends_with(".toml")) return questionnaireFrom(assets::TomlReader::fromFile(name));
  const ShippedQuestionnaire* shipped = shippedNamed(name);
  if (shipped == nullptr)
    throw UsageError("questionnaire " + name + ": there is none of that name, give one of " +
                     joined(shippedQuestionnaires()) + ", or a file that ends in .toml");
  return questionnaireFrom({shipped->text, name});
}

}  // namespace app
