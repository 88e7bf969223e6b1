// The gum that is raised, as a sheet of springs over the bone: rows from the incision to the flap's base, columns along
// the arch. A vertex sticks to the bone until it is peeled off; those at the base and along uncut sides are never. Free
// ones follow springs, bone, instrument and retractor.
// Extended position-based dynamics (Macklin, Mueller and Chentanez 2016), 10 substeps of 1 ms a frame. Membrane of
// E = 0.5 MPa and 1.2 mm: with the 3 MPa of gum (reference/extraction 8) 5 N would not turn the flap up, the mucosa of
// its base is softer (our choice). Springs along rows and columns with 3/4 E h times tributary width over length,
// diagonals with half of that; an even strip then stretches by F / (E h b) and narrows by a third. Springs over two
// edges, 20 times as soft, only resist folding. Frame P, mm, N, s. The same inputs give the same bits; any thread.
// About 1 ms a frame of 1200 vertices; nothing while all stick or are at rest.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

namespace app {

struct SheetVertex {
  glm::dvec3 home_P_mm{0.0}, normal_P{0.0};  ///< on the closed gum, outer surface
  glm::dvec3 at_P_mm{0.0}, velocity_P_mm_per_s{0.0};
  double thickness_mm = 1.2;  ///< as drawn
  glm::dvec3 bone_P_mm{0.0};  ///< under it, where the gum is stuck
  double stuck = 1.0;         ///< 1 whole, 0 free
  bool is_attached = false;   ///< for good
  bool is_cut = false;        ///< at the incision, through the whole gum
  bool is_torn = false;       ///< by a bur
  double inverse_mass = 0.0;  ///< 1 / (N s² / mm)

  bool isFree() const { return stuck <= 0.0 && !is_attached; }
};

class FlapSheet {
 public:
  static constexpr double kFrame_s = 0.01;
  static constexpr double kE_N_per_mm2 = 0.5, kMembrane_mm = 1.2;
  static constexpr double kPeel_mm = 2.6;      ///< about the elevator's tip
  static constexpr double kPeel_s = 0.025;     ///< of contact
  static constexpr double kElevator_mm = 1.4;  ///< radius of what lifts the sheet
  static constexpr double kSlip_N = 5.0;       ///< the retractor holds no more

  FlapSheet() = default;
  /// Row by row; row 0 is the incision. Attached and cut are set; masses are made here.
  FlapSheet(int columns, int rows, std::vector<SheetVertex> vertices);

  /// How far outside the bone a point is, and which way is out; for vertices that are free.
  struct Ground {
    double above_mm = 1.0;
    glm::dvec3 out_P{0.0};
  };
  using GroundAt = std::function<Ground(const glm::dvec3& p_P_mm)>;

  struct Instrument {
    glm::dvec3 tip_P_mm{0.0}, shaft_P{0.0};  ///< unit, away from the tip
    double length_mm = 10.0;                 ///< of what lifts
  };
  struct Load {
    const GroundAt& ground;
    const Instrument* elevator = nullptr;
    glm::dvec3 down_P{0.0};
    glm::dvec3 pull_P_N{0.0};  ///< on row 0, in all: for tests
  };
  /// One frame of kFrame_s.
  void step(const Load& load);

  /// Adhesion goes where the elevator's tip works: next to what is free or cut. Returns how many came free.
  int peel(const glm::dvec3& tip_P_mm);
  /// Something free or cut is within reach of the tip.
  bool isOpenAt(const glm::dvec3& tip_P_mm) const;

  /// The retractor's blade takes what is free around the middle of the edge, down to the base; goals are set by pull().
  /// False: the edge is not free.
  bool hold();
  void letGo() {
    if (isHeld()) still_frames_ = 0;
    ties_.clear();
  }
  bool isHeld() const { return !ties_.empty(); }
  /// Where the held vertices are drawn to when `part` of the way is done, from where they were; all shifted alike by
  /// what their middle asks for.
  void pull(double part, const std::function<glm::dvec3(std::size_t vertex)>& goal_P_mm,
            const std::function<glm::dvec3(const glm::dvec3& middle_P_mm)>& shift_mm);
  /// On the retractor, of the newest frame.
  double held_N() const { return held_N_; }

  /// Vertices within `reach_mm` of a point are torn off their neighbours. Returns how many are new.
  int tear(const glm::dvec3& at_P_mm, double reach_mm);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  const std::vector<SheetVertex>& vertices() const { return vertices_; }
  std::vector<SheetVertex>& vertices() { return vertices_; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  bool anyFree() const { return any_free_; }
  double freeArea_mm2() const;
  double columnLength_mm(int column) const;  ///< at rest
  /// Free places, positions and tears of another sheet of the same gum, where it has a vertex near.
  void takeOver(const FlapSheet& former);
  double worstStretch() const;
  /// Of all positions and adhesions: the same inputs give the same.
  std::uint64_t digest() const;

 private:
  struct Spring {
    std::size_t a = 0, b = 0;
    double rest_mm = 0.0, compliance_mm_per_N = 0.0;
    bool only_pushes = false;
  };
  struct Tie {
    std::size_t vertex = 0;
    glm::dvec3 off_mm{0.0};  ///< from its home when it was taken
    glm::dvec3 goal_P_mm{0.0}, before_P_mm{0.0};
  };
  void addSprings();
  void addSpring(std::size_t a, std::size_t b, double N_per_mm, bool only_pushes = false);
  void substep(const Load& load, double h_s);
  void relax(double h_s);
  void keepOff(const Load& load);

  int columns_ = 0, rows_ = 0;
  std::vector<SheetVertex> vertices_;
  std::vector<Spring> springs_;
  std::vector<Tie> ties_;
  std::vector<glm::dvec3> before_;
  glm::dvec3 held_sum_N_{0.0};
  double held_N_ = 0.0;
  bool any_free_ = false;
  int still_frames_ = 0;
};

}  // namespace app
