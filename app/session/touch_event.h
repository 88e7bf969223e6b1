// A touch of the bur on a tooth or the mandibular canal as an event of a recording: its words, and what is made of them
// again. Written when a touch ended; kTouchCounting stands at the beginning, so that a recording without a touch
// differs from an older one, in which nobody counted. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace app {

/// A pause this long ends a touch, of hard or soft tissue; its time is that in contact.
inline constexpr double kTouchPause_s = 0.25;

/// Of a touch of the mandibular canal; of a tooth it is the tooth's name.
inline constexpr char kCanalTouch[] = "mandibular canal";

/// Kind of these events, and the text of the first.
inline constexpr char kTouchEvent[] = "touch";
inline constexpr char kTouchCounting[] = "touches are counted from here, a pause of 0.25 s ends one";

struct Touch {
  std::string what;  ///< "lower right second molar"
  double contact_s = 0.0;
};

struct TouchCount {
  std::string what;
  int times = 0;
  double contact_s = 0.0;
};

/// "lower right second molar: 0.832 s".
std::string touchText(const Touch& touch);
/// None of other words.
std::optional<Touch> touchFrom(const std::string& text);

/// Adds it to the count of its name, or begins one.
void countInto(std::vector<TouchCount>& counts, const Touch& touch);

/// "lower right second molar 2 times, 0.8 s; mandibular canal once, 0.1 s"; empty for none.
std::string touchesText(const std::vector<TouchCount>& counts);

}  // namespace app
