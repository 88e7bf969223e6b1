// Measures a root canal treatment again and again while the tooth changes block by block: sections of canals whose
// walls did not change are kept, so is what was cut of each block; roof, outline, straight lines and perforations are
// asked again where a change may matter to them. What it finds is what treatmentOf() finds at once. Frame P, mm. One
// thread. Work (root_canal_bench): the first time some 0.5 s of a molar, after a stroke 0.2 to 0.35 s of CPU time.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "app/procedure/root_canal/canal_sections.h"
#include "app/procedure/root_canal/laid_blocks.h"
#include "app/procedure/root_canal/tooth_now.h"
#include "app/procedure/root_canal/treatment.h"

namespace app {

class TreatmentMeter {
 public:
  /// Borrows both.
  TreatmentMeter(const assets::ToothCanals& tooth, const ToothBlocks& before);
  TreatmentMeter(const TreatmentMeter&) = delete;
  TreatmentMeter& operator=(const TreatmentMeter&) = delete;

  /// The bytes of a block as they are now.
  void change(glm::ivec3 block, const ToothNow::Bytes& bytes);
  /// What is laid in a block now.
  void lay(glm::ivec3 block, const LaidBlocks::Bytes& bytes) { is_laid_new_ = laid_.set(block, bytes) || is_laid_new_; }

  Treatment measure(const FileUse& files);

 private:
  struct Canal {
    CanalSections sections;
    TreatedCanal treated;
    bool is_known = false, is_line_known = false;
    double removed_mm3 = 0.0;
  };
  /// Of a block.
  struct Cut {
    std::vector<double> of_canal_mm3;
    LostTissue lost;
    bool may_be_hole = false, is_new = true;
  };
  void follow();
  void measureCanals(const FileUse& files);

  const assets::ToothCanals& tooth_;
  const ToothBlocks& before_;
  ToothNow now_;
  std::vector<Canal> canals_;
  std::vector<Cut> cuts_;          ///< as now_.told()
  std::vector<std::size_t> news_;  ///< places in them
  LaidBlocks laid_;
  bool is_laid_new_ = false;
  std::optional<RoofOutcome> roof_;
  std::optional<OutlineOutcome> outline_;
  std::optional<std::vector<Perforation>> perforations_;
};

}  // namespace app
