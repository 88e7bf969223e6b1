// K-files as ISO 3630-1 names them: the size is the diameter of the tip in 1/100 mm, the cutting part is 16 mm long and
// grows by 0.02 mm a millimetre, the shaft goes on as thick. Lengths 21, 25 and 31 mm from the tip to the handle;
// handle colours pink, grey, purple to 10, then white, yellow, red, blue, green, black over and over. Nominal: made
// files are up to 0.02 mm off, from 70 on 0.04 (colours, tolerances, sections unverified). Plain values; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace assets {

enum class KFileMetal : std::uint8_t { steel, nickel_titanium };
/// Twisted from this wire: square up to size 25, triangular from 30 (makers' catalogues).
enum class KFileSection : std::uint8_t { square, triangle };

inline constexpr std::array kKFileSizes{6,  8,  10, 15, 20, 25,  30,  35,  40,  45, 50,
                                        55, 60, 70, 80, 90, 100, 110, 120, 130, 140};
inline constexpr std::array kKFileLengths_mm{21, 25, 31};

struct KFile {
  static constexpr double kCutting_mm = 16.0, kTaper = 0.02;
  static constexpr double kFlutesPerMm = 1.9;  ///< 1.5 to 2.3, unverified

  int size = 25;
  double length_mm = 25.0;
  KFileMetal metal = KFileMetal::steel;

  double tip_mm() const { return 0.01 * size; }
  double diameter_mm(double from_tip_mm) const;
  KFileSection section() const { return size <= 25 ? KFileSection::square : KFileSection::triangle; }
  /// Advance of an edge in one turn.
  double lead_mm() const { return (section() == KFileSection::square ? 4.0 : 3.0) / kFlutesPerMm; }
  std::string_view colour() const;
};

/// None: ISO 3630-1 has no such size.
std::optional<KFile> kFile(int size, int length_mm, KFileMetal metal);

}  // namespace assets
