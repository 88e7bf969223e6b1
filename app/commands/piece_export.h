// Pieces of a tooth as surfaces for other programs and for teaching models: one STL file a piece in a folder, or all of
// them in one .stl or .glb. A piece that was taken out lies where it lay in the jaw, one that has moved where it is.
// Frame P, mm (STL), or frame F, metres (.glb), as `molar export`. A command; a second, a replay for a session.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "assets/volume_grid.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/body/components.h"

namespace app {

enum class PiecePlace : std::uint8_t { in_place, moved, out };
inline constexpr std::string_view kPiecePlaces[] = {"in place", "moved", "out"};

struct ExportedPiece {
  std::string name;  ///< "piece-0"
  PiecePlace place = PiecePlace::in_place;
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid;  ///< in the order of the grid, at rest
  calibration::Pose<calibration::Patient, calibration::Piece> X_PQ;
  double volume_mm3 = 0.0;
};

/// As they are at the end, those that are out, too; a remark for people is printed. Throws SessionError, and UsageError
/// where the session has no tooth of its own.
std::vector<ExportedPiece> piecesOfSession(const std::string& path);
/// The largest `count` components, with what is partly solid beside them.
std::vector<ExportedPiece> piecesOf(const haptics::Components& tooth, std::size_t count);

/// To `out`: FILE.stl, FILE.glb, or a folder. Returns the files. Throws UsageError without a piece, and as OutputFile.
std::vector<std::string> writePieces(const std::vector<ExportedPiece>& pieces, const std::string& out, bool overwrite);

}  // namespace app
