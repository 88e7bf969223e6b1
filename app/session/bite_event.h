// A bite on articulating paper as an event of a recording: what was marked, and from when the tooth is, so that it can
// be done again on the re-run tooth. Whole µm and thousandths of mm², as written. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace app {

inline constexpr char kBiteEvent[] = "bite";

struct BiteRecord {
  struct Contact {
    std::string where;      ///< "mesiobuccal"
    double area_mm2 = 0.0;  ///< of the mark, as seen along the way of closing
    double gap_um = 0.0;    ///< at its narrowest
    bool operator==(const Contact&) const = default;
  };

  double t_s = 0.0;  ///< after the last tick whose tooth it is
  double paper_um = 0.0;
  bool is_made = true;                 ///< the antagonist was made, not scanned
  double high_um = 0.0;                ///< how far the tooth keeps the jaws open
  std::optional<double> clearance_um;  ///< of the narrowest place when closed; none: nothing opposes it
  std::string first;                   ///< where it touches first; empty: it does not
  std::vector<Contact> contacts;       ///< largest first
  std::string closing = {};            ///< "hinge", "balance"; empty: along the tooth's axis
  bool is_balanced = false;            ///< on three contacts around the middle

  bool operator==(const BiteRecord&) const = default;
  double area_mm2() const {
    double sum = 0.0;
    for (const Contact& contact : contacts) sum += contact.area_mm2;
    return sum;
  }
};

std::string biteText(const BiteRecord& bite);
/// None of other words, and of numbers that no bite has.
std::optional<BiteRecord> biteFrom(const std::string& text);

}  // namespace app
