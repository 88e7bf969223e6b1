// The protocol of an experiment, read from TOML: participant (an anonymous id), bone, two laws, what varies, method,
// probing. Strict: unknown keys are refused; every refusal names file, line and key. Keys, units and ranges:
// app/psychophysics/README.md; example: app/psychophysics/example.toml. Start-up only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/psychophysics/observer.h"
#include "app/psychophysics/probe.h"
#include "app/psychophysics/staircase.h"
#include "haptics/contact/law.h"
#include "haptics/tool/tool.h"

namespace app {

enum class Method : std::uint8_t {
  constant,   ///< "2afc-constant": the method of constant stimuli
  staircase,  ///< "staircase": transformed up-down tracks, mixed
  pair        ///< "2afc": one comparison, repeated
};

struct BoneChoice {
  enum class Kind : std::uint8_t { flat, trabecular, volume, patient } kind = Kind::flat;
  double voxel_mm = 0.2;          ///< of the built-in phantoms
  std::uint64_t seed = 1;         ///< of the trabecular phantom
  std::string path;               ///< volume file, or patient folder; empty: the built-in patient
  bool is_hounsfield = true;      ///< volume: Hounsfield, else solid fraction
  std::optional<ProbeSite> site;  ///< needed for a volume
};

struct Protocol {
  std::string title, participant;
  Method method = Method::constant;
  BoneChoice bone;
  haptics::Tool tool;
  ProbePlan probe;
  haptics::LawSettings standard, comparison;
  double peak_force_N = 3.3;
  std::string parameter;  ///< varied parameter of the comparison; empty for `pair`
  std::string unit;
  std::vector<double> levels;  ///< constant: rising; staircase: start of each track
  int trials = 40;             ///< per level (constant) or in total (pair)
  StaircaseRule staircase;
  double between_trials_s = 1.0;
  ObserverSettings observer;

  /// The comparison law at a level.
  haptics::LawSettings comparisonAt(double level) const;
  /// The standard's value of the varied parameter; none if the standard is another law or nothing varies.
  std::optional<double> standardValue() const;
};

/// `where` names the file. Relative paths in it stay unchanged. Throws UsageError.
Protocol protocolFromToml(const std::string& text, const std::string& where);

}  // namespace app
