// A stepped procedure as events of a recording: which it is, each step as it begins and ends, each error, and what the
// surgeon predicted beside what was computed; their words, and what is made of them again. All steps are ended at the
// end of a rehearsal, so only a killed session lacks some. Times: s since the start, simulated. Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace app {

/// Kinds of these events.
inline constexpr char kStepEvent[] = "step";
inline constexpr char kPredictionEvent[] = "prediction";

enum class StepState : std::uint8_t {
  not_reached,
  open,     ///< begun
  met,      ///< its rule was met
  given,    ///< done before, or by an assistant
  skipped,  ///< by hand
  omitted   ///< the operation went past it without its rule being met
};
/// As in files.
std::string_view nameOf(StepState state);

struct StepRecord {
  std::string key{}, title{};
  StepState state = StepState::not_reached;
  std::optional<double> begin_s{};
  double duration_s = 0.0;                            ///< until it ended, or the last tick
  std::vector<std::pair<std::string, int>> errors{};  ///< by key, in the order of their first

  void count(const std::string& error);
};

struct ProcedureRun {
  std::string name, guidance;  ///< "third-molar", "guided"
  std::vector<StepRecord> steps;

  bool isComplete() const;  ///< every step has ended
  /// When the last step ended; none: it is not complete.
  std::optional<double> end_s() const;
};

std::string procedureText(const ProcedureRun& run);
std::string stepBeginText(const StepRecord& step);
std::string stepErrorText(const StepRecord& step, const std::string& error, double t_s);
std::string stepEndText(const StepRecord& step);
/// Adds what an event of kStepEvent says; text of other words changes nothing.
void addStepEvent(std::optional<ProcedureRun>& run, const std::string& text);

/// What an operation will take: as the surgeon thinks, and as computed from the scan.
struct Prediction {
  std::string difficulty;         ///< easy, moderate or difficult; empty: not said
  std::optional<double> minutes;  ///< none: not said
  double at_s = 0.0;              ///< when it was said
  std::string computed;           ///< difficulty, alike; empty: not known
  std::optional<double> index;    ///< Pederson's, 3 to 10

  bool isGiven() const { return !difficulty.empty() || minutes; }
};

std::string predictionText(const Prediction& prediction);
/// None of other words.
std::optional<Prediction> predictionFrom(const std::string& text);

/// For people, beside the time that was used: "moderate, 12 min; computed: easy (4 of 10); used: 9.5 min". Empty:
/// nothing was predicted.
std::string predictionInWords(const Prediction& prediction, double end_s);
/// For people, one line a step: "3 Bare the crown: met after 0:41; cutting dry twice".
std::vector<std::string> stepsInWords(const ProcedureRun& run);
/// "third-molar, guided: 5 of 8 steps met, 3 given, 2 errors".
std::string procedureInWords(const ProcedureRun& run);

}  // namespace app
