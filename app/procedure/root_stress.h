// What forceps do to the tooth between their beaks and the bone that still holds its root: bending stress at sections
// along it, a cantilever loaded by the grip,
//   sigma = held (F_n / A + max over fibres of (M_u r_v / I_u - M_v r_u / I_v)),   r: from the section's middle,
// held: the share of the held surface that lies beyond the section.
// Parts of a section that do not touch, as two roots, bend each about its own middle. Enamel counts a third of dentine,
// pulp nothing. An event at 60 MPa, as teeth break (8 % of extractions by forceps), not solved: the piece stays whole.
// Sources: reference/extraction 1.2, 1.3. Check: a round root of 3.5 mm breaks at 253 N mm. The piece lies in its frame
// Q (haptics/body/bodies.h). N, mm, MPa. Main thread; a survey takes 5 ms and is made at most twice a second.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/patient.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/tick.h"

namespace app {

/// A piece and the bone around it, a copy.
struct HeldPiece {
  assets::VolumeGrid grid;                 ///< of the bytes: the tooth's
  std::vector<std::uint8_t> solid, label;  ///< of the piece in Q; label: assets::Tissue
  std::vector<std::uint8_t> jaw;           ///< solid, in P
  haptics::PiecePose X_PQ;
};

inline constexpr std::size_t kRootSections = 8;

struct RootSection {
  glm::dvec3 centre_Q_mm{0.0}, u_Q{0.0}, v_Q{0.0};  ///< unit: principal axes of the section
  double area_mm2 = 0.0;
  double second_u_mm4 = 0.0, second_v_mm4 = 0.0;  ///< for bending about u, about v
  static constexpr std::size_t kFibres = 24;
  std::array<glm::dvec2, kFibres> fibres_mm{};  ///< r along u and v, the farthest towards each of as many sides
  double held = 0.0;                            ///< see above
  bool is_crown = false;                        ///< with enamel
};

/// kRootSections from the grip to the root's end, without those that have no dentine. Empty: no bone holds it.
std::vector<RootSection> rootSections(const HeldPiece& piece, const glm::dvec3& grip_Q_mm);

/// Tension at the farthest fibre. `torque_Q_Nmm` about `at_Q_mm`.
double stressAt_N_per_mm2(const RootSection& section, const glm::dvec3& force_Q_N, const glm::dvec3& torque_Q_Nmm,
                          const glm::dvec3& at_Q_mm);

class RootStress {
 public:
  static constexpr double kHigh_N_per_mm2 = 40.0, kBreaks_N_per_mm2 = 60.0;

  /// Borrows the patient, whose labels the tooth has.
  explicit RootStress(const assets::Patient& patient) : patient_(patient) {}

  /// With the newest tick.
  void follow(const haptics::Tick& newest, const haptics::Bodies& bodies);
  /// None: nothing is gripped, or no bone holds it.
  std::optional<double> now_N_per_mm2() const { return now_N_per_mm2_; }
  /// Since the start.
  double most_N_per_mm2() const { return most_N_per_mm2_; }
  bool isCrown() const { return is_crown_; }
  /// Once for every grip that breaks it, for people.
  std::optional<std::string> news();

 private:
  bool isDue(const haptics::Tick& newest) const;
  void survey(const haptics::Tick& newest, const haptics::Bodies& bodies);
  void update(const haptics::Tick& newest);

  const assets::Patient& patient_;
  std::vector<RootSection> sections_;
  int piece_ = 0;  ///< surveyed, as Tick::gripped
  double surveyed_s_ = 0.0;
  std::optional<double> now_N_per_mm2_;
  double most_N_per_mm2_ = 0.0;
  bool is_crown_ = false, is_broken_ = false;  ///< where it is highest; in this grip
  std::optional<std::string> news_;
};

}  // namespace app
