// An ideal preparation from a file: a volume of solid fraction or of 0 and 1 (NRRD), or the closed mesh of the prepared
// tooth (STL), both in frame P, mm, where the patient's tooth stands. It becomes what is to be left of the crown, on
// the crown's voxels: a skin of a voxel or two between the file's surface and the tooth's is no preparation and is
// taken off; below its end towards the root nothing is taken. And what it is: a crown where it goes all around. Any
// thread; a second.
#pragma once

#include <string>

#include "app/procedure/preparation/prepared_ideal.h"
#include "assets/prepared_tooth.h"

namespace app {

/// Whether a name given for an ideal is that of a file.
bool isIdealFile(const std::string& name);

/// Throws UsageError of one line, beginning with `option`, what reading throws included.
assets::GivenIdeal readGivenIdeal(const std::string& path, const Crown& crown, const std::string& option);

/// The same of a field: `left`, on the crown's grid, of a file's digest.
assets::GivenIdeal givenIdeal(BoxBytes left, const Crown& crown, std::string digest, const std::string& option);

/// Form and zones of an ideal that was given.
class GivenForm {
 public:
  GivenForm(const Crown& crown, const BoxBytes& ideal);

  /// A crown's margin and walls, a cavity's groove and box are those of the ideal itself; else none are known.
  const IdealRule& rule() const { return rule_; }
  /// Of a place in the tooth's frame.
  PreparedZone zone(const glm::dvec3& p_mm) const;

 private:
  IdealRule rule_;
  OcclusalMap top_;  ///< of what is to be left
};

}  // namespace app
