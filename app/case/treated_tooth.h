// The patient of a root-canal treatment: one tooth with its canals and the bone around it on a fine grid, isolated by a
// rubber dam, in the head it belongs to. Frame P, mm. Start-up only; about a second, 4 bytes a voxel.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "assets/patient.h"
#include "assets/synthetic/jaw.h"
#include "assets/tooth_sampler.h"

namespace app {

/// Of voxels, for the live tooth: the narrowest built-in canal is four wide.
inline constexpr double kTreatedVoxel_mm = 0.04;

/// `whole`: head and title. `is_open`: the access cavity is cut, straight over the chamber; else the crown is whole.
assets::Patient treatedTooth(const assets::Patient& whole, const assets::ToothCanals& canals,
                             const assets::ToothSampler& fine, bool is_open);

/// `jaw`: of the built-in patient; none: a scan, whose canals are modelled. Throws UsageError, beginning with `option`,
/// where it has no such tooth or its canals cannot be treated.
assets::Patient treatedTooth(const assets::Patient& whole, const std::optional<assets::JawParameters>& jaw, int fdi,
                             bool is_open, const std::string& option, double spacing_mm = kTreatedVoxel_mm);

/// No tooth over the middle of the chamber's roof.
bool isRoofOpen(const assets::ToothCanals& tooth, const assets::CtVolume& ct);

/// A tooth of a patient on a fine grid, without its neighbours.
struct FineTooth {
  assets::ToothCanals canals;
  std::unique_ptr<assets::ToothSampler> fine;
};
enum class Canals { needed, wanted };  ///< wanted: a scan's tooth whose canals cannot be modelled is as it is labelled
/// Throws UsageError, beginning with `option`, as treatedTooth() does.
FineTooth fineToothAlone(const assets::Patient& whole, const std::optional<assets::JawParameters>& jaw, int fdi,
                         double spacing_mm, const std::string& option, Canals canals = Canals::needed);

/// Of a voxel of some tissue that is solid in part, Hounsfield.
std::int16_t greyOf(std::uint8_t solid, std::uint8_t label);

/// Signed distance to the access cavity of a tooth, negative inside, in the tooth's frame: the chamber's outline, drawn
/// out towards the bite and a little wider there.
double access_mm(const assets::PulpChamber& chamber, const glm::dvec3& p_mm);

}  // namespace app
