#include "app/case/clearance_source.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <span>
#include <stdexcept>

#include <fmt/core.h>

#include "app/case/cache_folder.h"
#include "app/text/message.h"
#include "assets/load_error.h"
#include "assets/patient/structure_file.h"

namespace app {
namespace {

/// Multiply and rotate, 64 bits at a time: against accidents, not forgery.
class RiskHash {
 public:
  void add(std::uint64_t word) { hash_ = std::rotl((hash_ ^ word) * 0x9e3779b97f4a7c15u, 29); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const glm::dvec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const std::vector<std::uint8_t>& bytes) {
    add(std::uint64_t{bytes.size()});
    for (std::size_t first = 0; first < bytes.size(); first += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + first, std::min(sizeof word, bytes.size() - first));
      add(word);
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0x524953u;
};

}  // namespace

std::uint64_t riskFingerprint(const assets::Patient& patient) {
  RiskHash hash;
  hash.add(std::uint64_t{kRiskStructuresRevision});
  const assets::VolumeGrid& grid = patient.ct.grid;
  for (int axis = 0; axis < 3; ++axis) hash.add(static_cast<std::uint64_t>(grid.size[axis]));
  hash.add(grid.spacing_mm), hash.add(grid.origin_P_mm);
  hash.add(patient.ct.label), hash.add(patient.ct.tooth);
  hash.add(static_cast<std::uint64_t>(patient.site ? patient.site->fdi : 0));
  hash.add(patient.focus_P_mm());
  hash.add(patient.mandibular_canal_radius_mm);
  for (const glm::dvec3& p : patient.mandibular_canal_P_mm) hash.add(p);
  return hash.value();
}

assets::RiskStructures cachedRiskStructures(const assets::Patient& patient) {
  const std::uint64_t fingerprint = riskFingerprint(patient);
  const std::filesystem::path file = cacheFolder() / fmt::format("clearance-{:016x}", fingerprint);
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) {
    try {
      const auto kept = assets::readStructures(file.string(), fingerprint, assets::kRiskStructures);
      assets::RiskStructures structures;
      std::ranges::copy(kept, structures.distance.begin());
      return structures;
    } catch (const assets::LoadError&) {
      printMessage("the cached distances to nerve and neighbours cannot be read, computing them again");
    }
  }
  assets::RiskStructures structures = riskStructures(patient);
  try {
    std::filesystem::create_directories(file.parent_path(), ignored);
    assets::writeStructures(structures.distance, fingerprint, file.string());
  } catch (const std::runtime_error& error) {
    printMessage(fmt::format("the distances to nerve and neighbours are not cached: {}", error.what()));
  }
  return structures;
}

}  // namespace app
