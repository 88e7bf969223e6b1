// A recorded session made ready to be looked at: its patient, any moment of it, what happened when. Frame P. One thread
// at a time. Construction takes seconds (patient, structures), prepare() runs the session once.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/debrief/bookmarks.h"
#include "app/debrief/flap_film.h"
#include "app/debrief/session_story.h"
#include "app/debrief/site_film.h"
#include "app/procedure/socket/sharp_edges.h"
#include "app/session/second_hand_event.h"
#include "app/session/session_moments.h"
#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "assets/risk_structures.h"

namespace app {

class DebriefRun {
 public:
  /// `patient_folder`: of an imported patient; empty: the built-in one, or only what the session itself holds. Throws
  /// SessionError, UsageError, LoadError.
  DebriefRun(const std::string& session, const std::string& patient_folder);
  DebriefRun(const DebriefRun&) = delete;
  DebriefRun& operator=(const DebriefRun&) = delete;

  /// Runs about `most_s` more of the session. False: all of it has been.
  bool prepare(double most_s);
  bool isPrepared() const { return moments_.isIndexed(); }
  double preparedTo_s() const { return prepared_s_; }
  double length_s() const { return moments_.length_s(); }

  /// As far as it is prepared.
  void goTo(double t_s) { moments_.goTo(t_s); }
  /// To a moment near it that is at hand, for a hand that scrubs.
  void goNear(double t_s) { moments_.goNear(t_s); }
  SessionMoments& moments() { return moments_; }
  const SessionMoments& moments() const { return moments_; }

  const std::string& path() const { return path_; }
  /// File without its folder.
  std::string name() const;
  /// As scanned, with its gum as it is closed. Not known: only what the session itself holds.
  const assets::Patient& patient() const { return patient_; }
  bool knowsPatient() const { return has_patient_; }
  const std::optional<assets::PlannedCut>& cut() const { return cut_; }
  const assets::RiskStructures& risks() const { return risks_; }
  /// Bricks of the jaw's grid that have changed since the last call; may name one twice.
  std::vector<glm::ivec3> takeChangedBricks();
  /// Chips, follicle, stitches, marks of the work.
  const SiteFilm& site() const { return *site_; }
  const SessionStory& story() const { return story_; }
  /// Where the other hand's instrument was drawn; empty: there was none, or it was not recorded.
  const SecondHandTrack& secondHand() const { return second_hand_; }
  /// Whether sharpEdges() looks: not at all, once a second of the session at most, or where the bone has changed.
  enum class Look : std::uint8_t { never, each_second, now };
  /// Of bone at this moment, as SocketWatch finds them in a rehearsal; a look takes 0.1 s. Null: no piece of the tooth
  /// is out, or nobody has looked.
  const std::vector<SharpEdge>* sharpEdges(Look look);
  /// None: the session began with the flap raised, or its patient is not known.
  const FlapFilm* flap() const { return flap_ ? &*flap_ : nullptr; }
  /// Read at the first call, for who shows them. Throws SessionError: its file is broken.
  Bookmarks& bookmarks();
  /// Words of bookmarks whose file has none, as the session is sealed: shown, and stored nowhere.
  void addWords(const std::vector<Bookmark>& words) { words_ = words; }
  /// Of story, and of bookmarks that were read, in order of time.
  std::vector<SessionMark> marks() const;
  /// For people: what is not as it was.
  std::vector<std::string> remarks() const;

 private:
  void lookAtSite(const haptics::Tick& tick);
  void beginFlap(const StoredStart& start);
  /// As the patient lay; of a session before that was stored, down in the usual picture.
  glm::dvec3 down_P() const;

  std::string path_;
  std::optional<Bookmarks> bookmarks_;
  std::vector<Bookmark> words_;
  SessionMoments moments_;
  bool has_patient_ = false;
  assets::Patient patient_;
  std::optional<assets::PlannedCut> cut_;
  assets::RiskStructures risks_;
  SessionStory story_;
  std::optional<SiteFilm> site_;
  std::optional<FlapFilm> flap_;
  std::optional<FlapRecord> recorded_flap_;
  SecondHandTrack second_hand_;
  struct EdgesSeen {
    double t_s = 0.0;
    std::uint64_t bone_digest = 0;
    std::array<bool, haptics::kMaxPieces> is_out{};
    std::optional<std::vector<SharpEdge>> edges;  ///< none: no piece is out
  };
  std::optional<EdgesSeen> edges_seen_;
  double prepared_s_ = 0.0;
  std::vector<glm::ivec3> changed_;  ///< while the session was run once
};

}  // namespace app
