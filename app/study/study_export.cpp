#include "app/study/study_export.h"

#include <nlohmann/json.hpp>

#include "app/study/csv.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

using nlohmann::ordered_json;

ordered_json jsonOf(const std::optional<double>& value) { return value ? ordered_json(*value) : ordered_json(nullptr); }
ordered_json jsonOf(const std::optional<ValueRange>& range) {
  return range ? ordered_json{range->low, range->high} : ordered_json(nullptr);
}

ordered_json publishedJson(const AnswerRow& row) {
  if (!row.published) return nullptr;
  return {{"n", row.published->count},
          {"mean", jsonOf(row.published->mean)},
          {"sd", jsonOf(row.published->deviation)},
          {"possible", row.can_be_answered}};
}

ordered_json jsonOf(const std::vector<AnswerRow>& rows) {
  ordered_json list = ordered_json::array();
  for (const AnswerRow& row : rows)
    list.push_back({{"id", row.id},
                    {"says", row.says},
                    {"category", row.category},
                    {"group", row.group},
                    {"session", row.session},
                    {"n", row.summary.count},
                    {"missing", row.missing},
                    {"mean", jsonOf(row.summary.mean)},
                    {"sd", row.hasDeviation() ? jsonOf(row.summary.deviation) : ordered_json(nullptr)},
                    {"median", jsonOf(row.summary.median)},
                    {"min", jsonOf(row.summary.low)},
                    {"max", jsonOf(row.summary.high)},
                    {"mean_95", jsonOf(row.mean_interval)},
                    {"median_95", jsonOf(row.median_interval)},
                    {"values", row.hasDeviation() ? ordered_json(nullptr) : ordered_json(row.values)},
                    {"published", publishedJson(row)}});
  return list;
}

ordered_json jsonOf(const SeverityAgreement& found) {
  ordered_json json{{"alpha_nominal", jsonOf(found.nominal)},
                    {"alpha_ordinal", jsonOf(found.ordinal)},
                    {"alpha_ordinal_95", jsonOf(found.ordinal_interval)},
                    {"alpha_interval", jsonOf(found.interval)},
                    {"samples", kAlphaSamples},
                    {"seed", SeverityAgreement::kSeed},
                    {"icc_2_1", nullptr},
                    {"icc_3_1", nullptr}};
  if (!found.intraclass) return json;
  json["icc_2_1"] = found.intraclass->agreement, json["icc_3_1"] = found.intraclass->consistency;
  json["icc_2_1_95"] = jsonOf(found.intraclass->agreement_interval);
  json["icc_3_1_95"] = jsonOf(found.intraclass->consistency_interval);
  return json;
}

/// Rows of the long table.
class LongTable {
 public:
  void add(const std::vector<std::string>& names, const char* measure, const std::optional<double>& value,
           const char* unit = "") {
    if (!value) return;
    std::vector<std::string> cells = names;
    cells.insert(cells.end(), {measure, assets::exactText(*value), unit});
    text_ += csvLine(cells);
  }
  void add(const std::string& kind, const std::vector<AnswerRow>& rows) {
    for (const AnswerRow& row : rows) {
      const std::vector<std::string> names{kind, row.id, row.group, row.session};
      add(names, "n", static_cast<double>(row.summary.count));
      add(names, "missing", static_cast<double>(row.missing));
      add(names, "mean", row.summary.mean);
      if (row.hasDeviation()) add(names, "sd", row.summary.deviation);
      add(names, "median", row.summary.median);
      add(names, "min", row.summary.low);
      add(names, "max", row.summary.high);
      addRange(names, "mean_95", row.mean_interval);
      addRange(names, "median_95", row.median_interval);
      if (!row.published) continue;
      add(names, "published_n", static_cast<double>(row.published->count));
      add(names, "published_mean", row.published->mean);
      add(names, "published_sd", row.published->deviation);
      add(names, "published_possible", row.can_be_answered ? 1.0 : 0.0);
    }
  }
  void addRange(const std::vector<std::string>& names, const std::string& measure,
                const std::optional<ValueRange>& range, const char* unit = "") {
    if (!range) return;
    add(names, (measure + "_low").c_str(), range->low, unit);
    add(names, (measure + "_high").c_str(), range->high, unit);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_ = csvLine({"kind", "id", "group", "session", "measure", "value", "unit"});
};

}  // namespace

std::string studyJson(const StudyResult& result) {
  ordered_json differences = ordered_json::array(), tasks = ordered_json::array(), problems = ordered_json::array(),
               said = ordered_json::array();
  for (const Difference& difference : result.differences)
    differences.push_back({{"id", difference.id},
                           {"of", difference.of},
                           {"against", difference.against},
                           {"paired", difference.is_paired},
                           {"n", difference.count},
                           {"shift", difference.test.shift},
                           {"shift_95", jsonOf(difference.test.shift_interval)},
                           {"rank_biserial", difference.test.rank_biserial},
                           {"p", difference.test.p},
                           {"exact", difference.test.is_exact},
                           {"pairs_without_difference", difference.test.left_out},
                           {"p_holm", difference.holm_p}});
  for (const TaskRow& row : result.tasks)
    tasks.push_back({{"task", row.task},
                     {"n", row.count},
                     {"success", row.success},
                     {"partly", row.partly},
                     {"failed", row.failed},
                     {"success_95", jsonOf(row.success_share)},
                     {"time_s", jsonOf(row.time_s)},
                     {"time_95_s", jsonOf(row.time_interval_s)},
                     {"helps", row.helps}});
  for (const ProblemRow& row : result.problems) {
    ordered_json tasks_met = ordered_json::array(), per_task = ordered_json::object();
    for (const MetInTask& one : row.tasks) tasks_met.push_back(one.task), per_task[one.task] = one.met_by;
    problems.push_back({{"problem", row.problem},
                        {"title", row.title},
                        {"severity", jsonOf(row.severity)},
                        {"met_by", row.met_by},
                        {"could_meet", row.could_meet},
                        {"share_95", jsonOf(row.share)},
                        {"tasks", tasks_met},
                        {"met_by_task", per_task},
                        {"participants", row.participants},
                        {"also", row.also},
                        {"moments", row.moments}});
  }
  for (const SaidAnswer& one : result.said)
    said.push_back({{"item", one.item}, {"participant", one.participant}, {"words", one.words}});
  ordered_json discovery = nullptr;
  if (result.discovery)
    discovery = {{"chance", result.discovery->chance},
                 {"found_share", result.discovery->found_share},
                 {"participants_for_85_percent", result.discovery->needed_85}};
  const ordered_json whole{{"participants", result.participants},
                           {"groups", result.groups},
                           {"sessions", result.sessions},
                           {"items", jsonOf(result.items)},
                           {"categories", jsonOf(result.categories)},
                           {"scores", jsonOf(result.scores)},
                           {"said", said},
                           {"differences", differences},
                           {"tasks", tasks},
                           {"problems", problems},
                           {"discovery", discovery},
                           {"severity_alpha", jsonOf(result.agreement.ordinal)},
                           {"severity_agreement", jsonOf(result.agreement)},
                           {"raters_awaited", result.awaited}};
  return whole.dump(2) + "\n";
}

std::string studyCsv(const StudyResult& result) {
  LongTable table;
  table.add("item", result.items);
  table.add("category", result.categories);
  table.add("score", result.scores);
  for (const Difference& difference : result.differences) {
    const std::vector<std::string> names{"difference", difference.id, difference.words(), ""};
    table.add(names, "shift", difference.test.shift);
    table.addRange(names, "shift_95", difference.test.shift_interval);
    table.add(names, "p", difference.test.p);
    table.add(names, "p_holm", difference.holm_p);
  }
  for (const TaskRow& row : result.tasks) {
    const std::vector<std::string> names{"task", row.task, "all", ""};
    table.add(names, "n", static_cast<double>(row.count));
    table.add(names, "success", static_cast<double>(row.success));
    table.addRange(names, "success_95", row.success_share);
    table.add(names, "time", row.time_s, "s");
    table.addRange(names, "time_95", row.time_interval_s, "s");
    table.add(names, "helps", static_cast<double>(row.helps));
  }
  for (const ProblemRow& row : result.problems) {
    const std::vector<std::string> names{"problem", row.problem, "all", ""};
    table.add(names, "severity", row.severity);
    table.add(names, "met_by", static_cast<double>(row.met_by));
    table.add(names, "could_meet", static_cast<double>(row.could_meet));
    table.addRange(names, "share_95", row.share);
  }
  return table.take();
}

}  // namespace app
