// The teeth of a patient whose canals can be treated: their canals, or the reason why a tooth has none here. Frame P,
// mm. Start-up only; some 0.2 s a tooth of the built-in patient.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/scan/fine_tooth.h"
#include "assets/synthetic/jaw.h"
#include "assets/tooth_canals.h"
#include "assets/tooth_sampler.h"

namespace app {

struct CanalTooth {
  int fdi = 0;
  std::optional<assets::ToothCanals> canals;
  std::string remark;  ///< why it has none, or what stands in the way
};

/// From the midline: canals in closed form.
std::vector<CanalTooth> canalTeeth(const assets::JawParameters& jaw);

/// Of a scan, by number: canals modelled into it, labelled so.
std::vector<CanalTooth> canalTeeth(const assets::CtVolume& ct);

/// On a fine grid, in its scan. `jaw`: of a built-in patient.
std::unique_ptr<assets::ToothSampler> fineTooth(const assets::CtVolume& ct,
                                                const std::optional<assets::JawParameters>& jaw,
                                                const assets::ToothCanals& canals,
                                                double spacing_mm = assets::kFineSpacing_mm);

/// For people: a line a canal.
std::string canalTable(const std::vector<CanalTooth>& teeth);

}  // namespace app
