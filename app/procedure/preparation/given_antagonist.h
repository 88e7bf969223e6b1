// Opposing teeth that are not made: of a mesh (STL, closed or open, frame P, mm, standing where the teeth meet), or of
// the patient's own scan. What is kept of them is the lowest surface over the tooth, so that a session is measured
// without the file. And the hinge on which jaws close: an axis along x of P, behind the tooth and over the bite. Any
// thread; a mesh of 10^6 faces some 2 s, most of it reading.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/procedure/preparation/occlusal_heights.h"
#include "assets/ct_volume.h"
#include "assets/mesh/stl_read.h"
#include "assets/prepared_tooth.h"

namespace app {

struct GivenAntagonist {
  assets::OpposingTeeth teeth;
  bool is_arch = false;  ///< so broad that it turns about the condyles
  std::string remark;    ///< for people; empty: none
};

/// `intact`: of the tooth before anything was cut. Throws UsageError of one line, beginning with `name`.
GivenAntagonist givenAntagonist(std::span<const assets::StlTriangle> mesh, const assets::ToothFrame& frame,
                                const OcclusalRaster& intact, std::string digest, const std::string& name);
/// Of a file. Throws UsageError of one line, beginning with `option`, what reading throws included.
GivenAntagonist readAntagonist(const std::string& path, const Crown& crown, const std::string& option);

/// Whether a scan has teeth of the other jaw.
bool hasOpposingTeeth(const assets::CtVolume& scan, int fdi);
/// None: its teeth do not stand over the tooth. Jaws that were scanned open are closed on the tooth, which is remarked.
std::optional<GivenAntagonist> scannedAntagonist(const assets::CtVolume& scan, int fdi, const Crown& crown);

/// How far the axis of the condyles lies behind a tooth and over the bite, mm: of Bonwill's triangle (100 mm) under
/// Balkwill's angle (22 degrees), textbook means, and how far the tooth stands behind the incisors in a mean arch.
glm::dvec2 usualHinge_mm(int fdi);
/// Of the middle of the tooth's biting surface.
glm::dvec3 hinge_P_mm(const Crown& crown, const glm::dvec2& behind_and_over_mm);

}  // namespace app
