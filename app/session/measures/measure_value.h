// A measure of a rehearsal as told to people and programs: by the ids of reference/product 4 (M2.path, S10.dry …).
// Plain values; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace app {

struct MeasureValue {
  std::string_view id, name, unit;  ///< unit empty: a pure number
  std::optional<double> value;      ///< none: the recording cannot tell, see `why`
  std::string_view why;             ///< words, where there is no value
  std::optional<double> t_s;        ///< the moment it is of
  std::string conditions = {};      ///< that it depends on; empty: none but the recording's
  bool is_confirmed = true;         ///< false: it rests on a tooth or canal that nobody has confirmed, see rests_on.h
};

/// A measure without its value.
struct MeasureName {
  std::string_view id, name, unit;
};

/// Each without value, for this reason.
template <class Names>
std::vector<MeasureValue> untold(const Names& names, std::string_view why) {
  std::vector<MeasureValue> values;
  for (const MeasureName& one : names) values.push_back({one.id, one.name, one.unit, {}, why, {}});
  return values;
}

}  // namespace app
