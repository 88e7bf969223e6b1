#include "app/commands/piece_export.h"

#include <filesystem>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "app/session/replay.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "assets/mesh/bone_surface.h"
#include "assets/mesh/gltf_file.h"
#include "assets/mesh/stl_file.h"
#include "assets/scenery/face_frame.h"
#include "calibration/output_file.h"
#include "haptics/body/bodies.h"
#include "haptics/body/piece_split.h"

namespace app {
namespace {

constexpr double kLeastExported_mm3 = 1.0;  ///< smaller ones are chips
const assets::Material kToothMaterial{{0.75f, 0.71f, 0.61f, 1.0f}, 0.25f, 0.0f};

double volumeOf_mm3(const ExportedPiece& piece) {
  double sum = 0.0;
  for (const std::uint8_t solid : piece.solid) sum += solid;
  return sum / 255.0 * piece.grid.voxelVolume_mm3();
}

/// Where it is, or lay before it was taken out.
assets::MeshPart surfaceOf(const ExportedPiece& piece) {
  assets::MeshPart part =
      assets::BoneSurface(assets::SolidVoxels::inGridOrder(piece.grid, piece.solid)).mergedMesh(piece.name);
  part.material = kToothMaterial;
  if (piece.place != PiecePlace::moved) return part;
  for (glm::vec3& p : part.position_mm) p = (piece.X_PQ * calibration::Point<calibration::Piece>{glm::dvec3(p)}).mm;
  for (glm::vec3& n : part.normal) n = piece.X_PQ.rotation * glm::dvec3(n);
  return part;
}

}  // namespace

std::vector<ExportedPiece> piecesOfSession(const std::string& path) {
  SessionReader session(path);
  refuseDamaged(session, path);
  const ReplayedState end = replayTo(session, std::numeric_limits<double>::infinity());
  if (end.divergence)
    printMessage(
        fmt::format("the replay differs from the recording from tick {} on ({}): the pieces are those of the "
                    "replay",
                    end.divergence->tick, end.divergence->what));
  std::vector<ExportedPiece> pieces;
  const haptics::Bodies& bodies = end.bodies;
  for (std::size_t n = 0; n < bodies.pieces(); ++n) {
    const haptics::CarvedBone& bone = bodies.bones()[n + 1];
    ExportedPiece piece{"", PiecePlace::in_place, bone.grid(), bone.solidInGridOrder(), bodies.pose(n), 0.0};
    if (!bodies.isAtRest(n)) piece.place = bodies.isSetAside(n) ? PiecePlace::out : PiecePlace::moved;
    piece.volume_mm3 = volumeOf_mm3(piece);
    if (piece.volume_mm3 < kLeastExported_mm3) continue;
    piece.name = fmt::format("piece-{}", pieces.size());
    pieces.push_back(std::move(piece));
  }
  if (pieces.empty()) throw UsageError(path + ": it keeps no tooth to be removed, molar export writes its bone");
  return pieces;
}

std::vector<ExportedPiece> piecesOf(const haptics::Components& tooth, std::size_t count) {
  std::vector<ExportedPiece> pieces;
  for (std::size_t n = 0; n < count; ++n) {
    pieces.push_back({fmt::format("piece-{}", n), PiecePlace::in_place, tooth.grid(), bytesOfPiece(tooth, n), {}, 0.0});
    pieces.back().volume_mm3 = volumeOf_mm3(pieces.back());
  }
  return pieces;
}

std::vector<std::string> writePieces(const std::vector<ExportedPiece>& pieces, const std::string& out, bool overwrite) {
  if (pieces.empty()) throw UsageError("--out " + out + ": there is no piece of tooth to write");
  const bool is_stl = out.ends_with(".stl");
  if (is_stl || out.ends_with(".glb")) {
    // The output is claimed before the work.
    calibration::OutputFile file(out, overwrite);
    assets::MeshModel model_P;
    for (const ExportedPiece& piece : pieces) model_P.parts.push_back(surfaceOf(piece));
    if (is_stl)
      assets::writeStl(model_P, file);
    else
      assets::writeGltf(assets::modelInFaceFrame(model_P), file);
    return {out};
  }
  const std::filesystem::path folder(out);
  if (folder.has_extension())
    throw UsageError("--out " + out + ": pieces are written as .stl, as .glb, or into a folder, name one of these");
  // Of a former run there may have been more.
  std::vector<std::string> names, files;
  for (std::size_t n = 0; n < haptics::kMaxPieces + pieces.size(); ++n) names.push_back(fmt::format("piece-{}.stl", n));
  calibration::OutputFolder claimed(out, overwrite, names);
  for (const ExportedPiece& piece : pieces) {
    const std::string name = piece.name + ".stl";
    calibration::OutputFile file((std::filesystem::path(claimed.temporaryPath()) / name).string(), false);
    assets::MeshModel model_P;
    model_P.parts.push_back(surfaceOf(piece));
    assets::writeStl(model_P, file);
    files.push_back((folder / name).string());
  }
  claimed.commit();
  return files;
}

}  // namespace app
