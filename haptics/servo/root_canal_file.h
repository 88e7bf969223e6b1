// A root-canal file in the hand: taken up, led along its canal (file/file_in_canal), worn against the wall
// (file/canal_wear). It meets the jaw's bone, not pieces of a tooth to be removed. The pedal opens the fingers: while
// it is down the handle turns without the file, as one grips anew. A file that an undo or a jump of the hand has put
// into the tooth has no wall until it is out. Or a cone of gutta-percha in pliers: it cuts nothing, meets what is laid
// too, and stays in the tooth once they open; the next one has no wall until the hand is out. Frame P. Servo thread; no
// allocation, lock or throw; costs in file/README.
#pragma once

#include <optional>
#include <span>

#include "haptics/body/bodies.h"
#include "haptics/bone/lay_cone.h"
#include "haptics/file/canal_wear.h"
#include "haptics/file/file_flutes.h"
#include "haptics/file/file_fragments.h"
#include "haptics/file/file_in_canal.h"
#include "haptics/servo/file_work.h"
#include "haptics/tool/tool.h"

namespace haptics {

/// Where the rubber stop of a file comes to rest on the tooth.
struct FileReference {
  glm::dvec3 point_P_mm{0.0}, out_P{0.0, 0.0, 1.0};
  double orifice_mm = 0.0;  ///< so far below it the canals begin: a cone that is let go of is seared off there
};

/// Unit length; as usual, what is none.
FileReference sanitised(const FileReference& reference) noexcept;

class RootCanalFile {
 public:
  struct Hand {
    calibration::Pose<calibration::Patient, calibration::Tool> X_PT;
    bool opens_fingers = false;
    bool relocated = false;  ///< not reached by motion, or the tooth has changed under it
    bool may_cut = true;
    bool irrigates = false;  ///< water washes flutes and canals
    double max_stiffness_N_per_mm = kFileCoupling_N_per_mm;
  };
  struct Felt {
    Wrench<calibration::Patient> on_hand{};  ///< about T's origin
    calibration::Vector<calibration::Patient> vibration_P_N{};
    calibration::Point<calibration::Patient> handle_P;
    double max_stored_Nmm = 0.0;
    bool touches = false;
    bool files = false;  ///< it may take something of the wall
    CarveResult removed;
    std::optional<LaidCone> let_go;  ///< in this tick, of a cone
  };

  /// With what earlier files have left in the tooth.
  explicit RootCanalFile(std::span<const assets::MetalFragment> before = {}) noexcept : fragments_(before) {}

  /// `tool`: with a file. Changed blocks are saved to `strokes`.
  Felt update(Bodies& bodies, StrokeHistory& strokes, const Tool& tool, const FileReference& reference,
              const WearSettings& wear, const Hand& hand, double dt_s, std::uint64_t tick) noexcept;
  /// First in each tick, whatever is in the hand; `restored`: strokes were undone or redone.
  void followStrokes(const StrokeHistory& strokes, bool restored) noexcept { fragments_.follow(strokes, restored); }
  /// Another tool is in the hand; what is left in the canals stays and may be washed.
  void putDown(double dt_s, bool irrigates) noexcept;
  bool isInHand() const { return file_.has_value(); }

  /// Of the last update().
  const FileWork& work() const { return work_; }

 private:
  bool isOut(const FileReference& reference) const noexcept;
  /// Of its tip, in a canal.
  double belowOrifice_mm(const FileReference& reference) const noexcept;
  void takeUp(const Tool& tool, const FilePose& X_PT, const WearSettings& wear, double max_stiffness_N_per_mm) noexcept;
  bool isInSolid(const FileScene& scene) const noexcept;
  LaidCone laidCone(const FileReference& reference) const noexcept;
  FilePose gripped(const Hand& hand) noexcept;
  void tell(const FileTick& tick) noexcept;
  calibration::Vector<calibration::Patient> vibration(const FileTick& tick, double dt_s) noexcept;

  std::optional<FileInCanal> file_;
  CanalFile chosen_;
  WearSettings wear_settings_;
  CanalWear wear_;
  FileFlutes flutes_;
  FileFragments fragments_;
  FileWork work_;
  double worn_before_mm3_ = 0.0, taken_before_mm3_ = 0.0;  ///< by the files before this one
  bool passes_ = false;
  bool were_open_ = false;   ///< the fingers, in the last tick
  bool has_let_go_ = false;  ///< of a cone, and is not out yet
  glm::dquat last_hand_{1.0, 0.0, 0.0, 0.0};
  double let_go_rad_ = 0.0;  ///< turned by the fingers alone
  double buzz_rad_ = 0.0;
};

}  // namespace haptics
