// A K-file in the hand: how it lies in the canal, what the hand feels, what wears it out. Each tick the shape of least
// energy is found - bend of the joints, overlap with the live wall, friction, rubber stop, spring between hand and
// handle - by Newton steps of riccati_sweep, then its twist. The handle follows the hand's axis and roll; its place is
// a proxy on a spring of at most 0.8 N/mm, part of the same energy, so a jammed file's own stiffness is never rendered.
// Quasi-static: no speed but that of the hand. Frame P; T as in a Tool: +z along the handle away from the tip, origin
// where the shaft leaves the handle. mm, rad, N, N mm. Servo thread: no allocation, lock or clock in step(); bounded by
// 12 steps. A pure function of state and inputs. Source: reference/sisters 1.2 to 1.6.
#pragma once

#include <optional>

#include "calibration/geometry/frames.h"
#include "haptics/bone/solid_field.h"
#include "haptics/file/file_twist.h"
#include "haptics/file/riccati_sweep.h"
#include "haptics/file/wall_contact.h"
#include "haptics/wrench.h"

namespace haptics {

using FilePose = calibration::Pose<calibration::Patient, calibration::Tool>;

/// The ring on the shaft meets the tooth's reference plane.
struct RubberStop {
  double from_tip_mm = 0.0;  ///< the working length
  glm::dvec3 reference_P_mm{0.0}, out_P{0.0, 0.0, 1.0};
};

class FileFragments;

struct FileScene {
  const SolidField* wall = nullptr;  ///< null: in the air
  std::optional<RubberStop> stop;
  const PerNode<glm::dvec3>* pull_P_N = nullptr;  ///< loads on nodes; null: none
  const FileFragments* fragments = nullptr;       ///< of other files; null: none
  const SolidField* laid = nullptr;               ///< wall beside the wall: what was laid; null: none
};

struct FileGrip {
  bool rigid = false;  ///< the handle is where the hand is
  double N_per_mm = kFileCoupling_N_per_mm;
};

/// What is left in the canal when a file breaks.
struct FileFragment {
  double from_tip_mm = 0.0;  ///< of the whole file
  double diameter_mm = 0.0, torque_Nmm = 0.0, damage = 0.0;
  std::size_t links = 0;
  PerNode<glm::dvec3> node_P_mm{};  ///< [0] the break
};

/// All that a file remembers, by value.
struct FileState {
  ChainShape shape;
  FilePose hand_X_PT;               ///< as far as the hand was followed
  PerNode<double> roll_rad{};       ///< of each node; [0] the handle
  PerNode<double> last_roll_rad{};  ///< by the last tick
  PerNode<double> normal_N{};       ///< of the last tick
  PerNode<Bristle> bristle{};
  PerNode<glm::dvec2> slip_mm{};     ///< of the last tick, along the axis and round it
  PerNode<glm::dvec2> rest_chord{};  ///< bend without load, about the two axes of its material; 2 sin(angle / 2)
  PerNode<double> damage{};          ///< by bending in turn; breaks at 1
  glm::dmat3 follow{1.0};            ///< way of node 0 for a way of the hand
  glm::dmat3 felt_N_per_mm{0.0};     ///< of the chain at node 0
  bool rest_straight = true;
};

struct FileTick {
  Wrench<calibration::Patient> on_hand{};  ///< torque about node 0, bend and twist
  double torque_Nmm = 0.0;                 ///< of the hand on the file, about its axis
  double torque_share = 0.0;               ///< largest of torque over breaking torque
  double strain = 0.0;                     ///< largest of the outer fibre
  double strain_from_tip_mm = 0.0;
  double normal_N = 0.0;                       ///< sum over all sections
  double stop_N = 0.0;                         ///< of the rubber stop
  double energy_Nmm = 0.0, started_Nmm = 0.0;  ///< of the tick's own potential: found, and at its first guess
  double axial_N_per_mm = 0.0;                 ///< of the file at the handle; negative: it buckles
  int steps = 0, evaluations = 0;
  bool unsettled = false;                  ///< not at rest within the steps; goes on from here next tick
  bool reverted = false;                   ///< no step was downhill: the shape before it stands
  bool refused = false;                    ///< input that is no number: nothing changed
  bool set = false;                        ///< steel bent beyond 3 %: it keeps a bend
  std::optional<std::size_t> broken_link;  ///< in this tick
};

class FileInCanal {
 public:
  FileInCanal(const FileChain& chain, const FileLaw& law, const FileGrip& grip, const FilePose& X_PT);

  FileTick step(const FilePose& hand_X_PT, const FileScene& scene) noexcept;

  /// Bent beforehand: the last `bent_mm` along an arc of `angle_rad` about the direction `towards_rad` of the handle's
  /// x.
  void prebend(double bent_mm, double angle_rad, double towards_rad) noexcept;

  const FileChain& chain() const noexcept { return chain_; }  ///< shorter once it broke
  const FileLaw& law() const noexcept { return law_; }
  const FileState& state() const noexcept { return state_; }
  const ChainBalance& balance() const noexcept { return balance_; }
  const std::optional<FileFragment>& fragment() const noexcept { return fragment_; }
  /// Of links, before it broke.
  double wholeLength_mm() const noexcept { return whole_mm_; }

 private:
  struct Kept;
  struct Limit;
  bool isPressed() const noexcept;
  void follow(const FilePose& hand_X_PT) noexcept;
  SectionContact wallAt(const ChainShape& shape, const Kept& kept, const FileScene& scene,
                        std::size_t i) const noexcept;
  double besideWall_Nmm(const ChainShape& shape, const Kept& kept, const ChainBalance& sum) const noexcept;
  bool meetWall(const ChainShape& shape, const Kept& kept, const FileScene& scene, const ChainBalance& sum,
                PerNode<SectionContact>& wall, Limit& limit) const noexcept;
  ChainBalance balanceAt(const ChainShape& shape, const Kept& kept, const FileScene& scene,
                         Limit& limit) const noexcept;
  ShaftLoad stopAt(const ChainShape& shape, const FileScene& scene, double& energy_Nmm) const noexcept;
  void settle(const Kept& kept, const FileScene& scene, FileTick& tick) noexcept;
  void twistAndSlide(const ChainShape& before, const Kept& kept, FileTick& tick) noexcept;
  void wearOut(const RestTurns& rest, FileTick& tick) noexcept;
  void breakAt(std::size_t link, double torque_Nmm) noexcept;
  RestTurns restTurns() const noexcept;

  FileChain chain_;
  FileLaw law_;
  FileGrip grip_;
  double whole_mm_;
  FileState state_;
  ChainBalance balance_;
  std::optional<FileFragment> fragment_;
};

}  // namespace haptics
