// What `molar file` computes: a file held at its handle under a force, or pushed into a canal, turned and filed there.
// Frame: the handle's axis points down -z, x across; mm, N, N mm. Throws UsageError for what there is not.
#pragma once

#include <optional>
#include <string>

#include "assets/synthetic/root_canal.h"
#include "haptics/file/file_in_canal.h"

namespace app {

struct KFileOptions {
  int size = 25, length_mm = 25, nodes = static_cast<int>(haptics::kUsualLinks), strokes = 0;
  std::string material = "steel", at = "tip", canal, solver = "rest", wear = "wear";
  double force_N = 0.0, prebend_deg = 0.0, turn_deg = 0.0;
  std::optional<double> depth_mm, working_mm, uniform_N_mm2;
  bool json = false;
};

struct FiledAnswer {
  assets::KFile file;
  haptics::FileInCanal rest;
  haptics::FileTick tick;
  bool unsettled = false;
  bool entered = true;                          ///< the tip lies in the canal, or there is none
  double torque_Nmm = 0.0, torque_share = 0.0;  ///< the largest while it was turned
  double due_mm3 = 0.0, removed_mm3 = 0.0;      ///< by strokes
};

assets::KFile chosenFile(const KFileOptions& options);
haptics::FileChain chosenChain(const KFileOptions& options, const assets::KFile& file);
std::size_t loadedNode(const KFileOptions& options);
/// The canal of --canal, after all that is said of it was found possible; none: free.
std::optional<assets::RootCanal> chosenCanal(const KFileOptions& options, const assets::KFile& file);

/// Held at its handle, drawn across at a node, until nothing moves.
FiledAnswer freeFile(const KFileOptions& options, const assets::KFile& file);
/// Pushed from above the orifice along the handle's axis, to its depth or until the hand bears the force; then turned,
/// then drawn out and in again stroke by stroke.
FiledAnswer pushedFile(const KFileOptions& options, const assets::KFile& file, const assets::RootCanal& canal);

}  // namespace app
