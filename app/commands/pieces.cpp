// `molar pieces SOURCE`: what a tooth has come apart into, and what still holds it, of a patient, a session's end or a
// volume; as a table, or JSON for programs. Lengths in mm, frame P.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/case/case.h"
#include "app/case/patient_source.h"
#include "app/commands/command.h"
#include "app/commands/piece_export.h"
#include "app/options/volume_option.h"
#include "app/procedure/ways_out.h"
#include "app/session/replay.h"
#include "app/session/session_folder.h"
#include "app/station/patient_list.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "assets/ct_volume.h"
#include "assets/patient/patient_folder.h"
#include "assets/scan/tooth_division.h"
#include "calibration/geometry/units.h"
#include "haptics/body/tooth_survey.h"

namespace app {
namespace {

struct PiecesOptions {
  VolumeOption volume;
  std::string source, case_name, out;
  std::optional<int> tooth;
  std::vector<double> exit_P;
  bool json = false, force = false;
};

/// A tooth on a grid: what it was before it was cut, and what is left of it.
struct CutTooth {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> before, now;
};

/// And what is around it.
struct Source {
  CutTooth tooth;
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> around, label, number;  ///< as AroundTooth
  WayUp up;
};

/// On the smallest grid that holds it; none: there is no tooth.
std::optional<CutTooth> cropped(const CutTooth& tooth) {
  glm::ivec3 low(tooth.grid.size), high(-1);
  assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth.before[v] == 0 && tooth.now[v] == 0) return;
    low = glm::min(low, ijk);
    high = glm::max(high, ijk);
  });
  if (high.x < 0) return std::nullopt;
  CutTooth part{{high - low + 1, tooth.grid.spacing_mm, tooth.grid.centre_P_mm(low)}, {}, {}};
  assets::forVoxels(low, high + 1, [&](glm::ivec3 ijk) {
    part.before.push_back(tooth.before[tooth.grid.index(ijk)]);
    part.now.push_back(tooth.now[tooth.grid.index(ijk)]);
  });
  return part;
}

/// The bytes of the tooth alone.
template <class Belongs>
std::vector<std::uint8_t> masked(const std::vector<std::uint8_t>& solid, const Belongs& belongs) {
  std::vector<std::uint8_t> of_tooth(solid.size(), 0);
  for (std::size_t v = 0; v < solid.size(); ++v)
    if (belongs(v)) of_tooth[v] = solid[v];
  return of_tooth;
}

/// All but the tooth.
template <class Belongs>
std::vector<std::uint8_t> without(const std::vector<std::uint8_t>& solid, const Belongs& belongs) {
  return masked(solid, [&](std::size_t v) { return !belongs(v); });
}

Source toothOfPatient(const PiecesOptions& options) {
  const assets::Patient patient = options.case_name.empty() ? assets::loadPatient(options.source)
                                                            : builtInPatient(caseNamed(options.case_name)->jaw);
  const std::string name = options.case_name.empty() ? options.source : "--case " + options.case_name;
  if (!options.tooth && !patient.site)
    throw UsageError(name + ": no third molar is labelled here, name a tooth with --tooth FDI");
  const int fdi = options.tooth.value_or(patient.operatedTooth());
  const std::vector<std::uint8_t>& number = patient.ct.tooth;
  const auto belongs = [&](std::size_t v) { return !number.empty() && number[v] == fdi; };
  const auto solid = masked(patient.ct.solid, belongs);
  const auto tooth = cropped({patient.ct.grid, solid, solid});
  if (!tooth) throw UsageError(fmt::format("{}: no voxel is labelled as tooth {}, see molar inspect", name, fdi));
  Source source{*tooth, patient.ct.grid, without(patient.ct.solid, belongs), patient.ct.label, number, {}};
  if (patient.site && patient.site->fdi == fdi) source.up = wayUp(patient);
  return source;
}

Source toothOfSession(const PiecesOptions& options) {
  if (options.tooth) throw UsageError("--tooth: a session keeps its tooth, leave it out");
  const std::string path = sessionNamed(options.source);
  const BoneAtTime bone = boneAtTime(path, std::nullopt);
  for (const std::string& remark : bone.remarks) printMessage(remark);
  // The tooth as the servo has it: it shares voxels with the bone, and what a bur takes there it takes of both alike.
  const assets::VolumeGrid& grid = bone.start.grid;
  const assets::ToothDivision divided =
      assets::divideByTooth(grid, bone.start.solid, bone.start.label, bone.start.is_tooth);
  const glm::ivec3 first = divided.first_brick * assets::kBrickVoxels;
  CutTooth whole{grid, std::vector<std::uint8_t>(grid.voxelCount(), 0),
                 std::vector<std::uint8_t>(grid.voxelCount(), 0)};
  std::vector<std::uint8_t> around = bone.solid;
  for (std::size_t t = 0; const std::uint8_t share : divided.tooth.solid) {
    const glm::ivec3 at = first + assets::elementAt(divided.tooth.grid.size, t++);
    if (share == 0 || !grid.contains(at)) continue;
    const std::size_t v = grid.index(at);
    const int before = bone.start.solid[v];
    whole.before[v] = share;
    whole.now[v] = static_cast<std::uint8_t>((share * bone.solid[v] + before / 2) / before);
    around[v] = static_cast<std::uint8_t>(around[v] - std::min(around[v], whole.now[v]));
  }
  const auto tooth = cropped(whole);
  if (!tooth)
    throw UsageError(path +
                     ": it keeps no tooth to be removed, write its bone with molar replay --to and use --volume");
  return {*tooth, grid, std::move(around), bone.start.label, {}, {}};
}

/// Fills up to kGap_mm of what is not solid between solid voxels along an axis.
void fillGaps(const CutTooth& tooth, std::vector<std::uint8_t>& before) {
  constexpr double kGap_mm = 4.0;
  const glm::ivec3 size = tooth.grid.size;
  const int most = static_cast<int>(kGap_mm / tooth.grid.spacing_mm);
  for (int axis = 0; axis < 3; ++axis) {
    glm::ivec3 starts = size;
    starts[axis] = 1;
    assets::forVoxels(glm::ivec3(0), starts, [&](glm::ivec3 at) {
      int last = -1;
      for (int n = 0; n < size[axis]; ++n) {
        at[axis] = n;
        if (tooth.now[tooth.grid.index(at)] < assets::kHalfSolid) continue;
        if (last >= 0 && n - last - 1 <= most)
          for (at[axis] = last + 1; at[axis] < n; ++at[axis]) before[tooth.grid.index(at)] = 255;
        last = n;
      }
    });
  }
}

/// Without a record of the cut. What lies among voxels of the tooth was solid before, by its labels; where they show no
/// cut, narrow gaps were.
Source toothOfVolume(const PiecesOptions& options) {
  const SolidVolume volume = options.volume.load();
  if (volume.label.empty()) throw UsageError("pieces --volume: give --labels too, they say which voxels are the tooth");
  const auto belongs = [&](std::size_t v) {
    return options.tooth ? volume.label[v] == *options.tooth : assets::isToothPart(volume.label[v]);
  };
  const auto is_hard_part = [&](glm::ivec3 ijk) {
    if (!volume.grid.contains(ijk)) return false;
    const std::size_t v = volume.grid.index(ijk);
    return belongs(v) && (options.tooth || assets::isHard(volume.label[v]));
  };
  CutTooth tooth{volume.grid, {}, masked(volume.solid, belongs)};
  tooth.before = tooth.now;
  bool is_cut = false;
  assets::forVoxels(volume.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth.now[v] >= assets::kHalfSolid || !is_hard_part(ijk)) return;
    bool is_inner = true;
    assets::forVoxels(ijk - 1, ijk + 2, [&](glm::ivec3 beside) { is_inner = is_inner && is_hard_part(beside); });
    if (!is_inner) return;
    tooth.before[v] = 255;
    is_cut = true;
  });
  const auto alone = cropped(tooth);
  if (!alone)
    throw UsageError(options.tooth
                         ? fmt::format("--tooth {}: no solid voxel has this label", *options.tooth)
                         : "--labels: no third molar is labelled (enamel 4, dentine 5, pulp 6), give --tooth");
  Source result{*alone, volume.grid, without(volume.solid, belongs), volume.label, {}, {}};
  if (!is_cut) {
    fillGaps(result.tooth, result.tooth.before);
    printMessage(
        "pieces: the labels show no cut in the tooth, so its gaps of up to 4 mm count as cut, those between "
        "roots too");
  }
  return result;
}

bool isSession(const PiecesOptions& options) {
  return !options.volume.given() && options.case_name.empty() &&
         !std::filesystem::is_directory(patientNamed(options.source));
}

Source toothOf(PiecesOptions options) {
  options.source = patientNamed(options.source);
  const int sources = !options.source.empty() + !options.case_name.empty() + options.volume.given();
  if (sources != 1) throw UsageError("pieces: give exactly one of SOURCE, --case NAME and --volume FILE");
  if (options.volume.given()) return toothOfVolume(options);
  return isSession(options) ? toothOfSession(options) : toothOfPatient(options);
}

struct Findings {
  haptics::ToothFindings tooth;
  std::vector<PieceWay> ways;
};

haptics::ToothSurvey surveyOf(const CutTooth& tooth) {
  haptics::ToothSurvey survey(tooth.grid, tooth.before);
  haptics::forBricks(tooth.grid.bricks(), [&](std::size_t, glm::ivec3 corner) {
    std::array<std::uint8_t, 512> bytes{};
    std::size_t n = 0;
    assets::forVoxels(corner, corner + assets::kBrickVoxels, [&](glm::ivec3 ijk) {
      bytes[n++] = tooth.grid.contains(ijk) ? tooth.now[tooth.grid.index(ijk)] : std::uint8_t{0};
    });
    survey.update(corner / assets::kBrickVoxels, bytes);
  });
  return survey;
}

Findings findingsOf(const Source& source, const std::optional<glm::dvec3>& exit_P) {
  const CutTooth& tooth = source.tooth;
  haptics::ToothSurvey survey = surveyOf(tooth);
  Findings found{survey.pieces(), {}};
  survey.findBridges(found.tooth, tooth.grid.spacing_mm);
  WayUp up = source.up;
  if (exit_P) up.direction_P = *exit_P;
  const AroundTooth around{source.grid, source.around, source.label, source.number};
  found.ways = waysOut(around, survey.components(), std::min(found.tooth.pieces, haptics::kMostPieces), up);
  return found;
}

nlohmann::json jsonOf(const std::vector<PieceWay>& ways) {
  using nlohmann::json;
  constexpr std::array<const char*, 4> kAnswers = {"free", "grazes", "blocked", "not-found"};
  json list = json::array();
  for (const PieceWay& piece : ways) {
    const haptics::WayOut& way = piece.way;
    json where = json::array();
    for (const InTheWay& one : piece.in_the_way)
      where.push_back({{"what", one.words},
                       {"volume_mm3", one.volume_mm3},
                       {"centre_P_mm", {one.centre_P_mm.x, one.centre_P_mm.y, one.centre_P_mm.z}}});
    const bool is_found = way.answer != haptics::WayOutAnswer::not_found;
    list.push_back({{"piece", piece.piece},
                    {"after", piece.after},
                    {"answer", kAnswers[static_cast<std::size_t>(way.answer)]},
                    {"blocked_mm3_by_label", piece.in_the_way_mm3_by_label},
                    {"in_the_way", where},
                    {"path_mm", is_found ? json(way.length_mm) : json()},
                    {"turned_deg", is_found ? json(calibration::degreesFromRad(way.turned_rad)) : json()},
                    {"poses", way.poses}});
  }
  return list;
}

/// Pieces are numbered from 0; the parts that bridges hold together go on from there.
nlohmann::json jsonOf(const Findings& findings) {
  const haptics::ToothFindings& found = findings.tooth;
  using nlohmann::json;
  const auto list = [](const glm::dvec3& v) { return json{v.x, v.y, v.z}; };
  const std::size_t listed = std::min(found.pieces, haptics::kMostPieces);
  json pieces = json::array(), bridges = json::array();
  std::size_t next_id = found.pieces;
  for (std::size_t n = 0; n < listed; ++n) {
    const haptics::ToothPiece& piece = found.piece[n];
    const haptics::ToothFindings::Held& held = found.held[n];
    json parts = json::array(), inertia = json::array();
    const std::size_t first_id = next_id;
    for (std::size_t part = 0; held.parts > 1 && part < held.parts; ++part)
      parts.push_back({{"id", next_id++},
                       {"volume_mm3", held.part[part].volume_mm3},
                       {"centroid_P_mm", list(held.part[part].centroid_mm)}});
    for (int row = 0; row < 3; ++row) inertia.push_back(list(piece.inertia_mm5[row]));
    pieces.push_back({{"id", n},
                      {"volume_mm3", piece.volume_mm3},
                      {"centroid_P_mm", list(piece.centroid_mm)},
                      {"inertia_mm5", inertia},
                      {"parts", parts}});
    for (std::size_t b = 0; b < held.bridges; ++b) {
      const haptics::Bridge& bridge = held.bridge[b];
      bridges.push_back({{"between", {first_id + bridge.between[0], first_id + bridge.between[1]}},
                         {"piece", n},
                         {"area_mm2", bridge.area_mm2},
                         {"thickness_mm", bridge.thickness_mm},
                         {"width_mm", bridge.width_mm},
                         {"normal_P", list(bridge.normal)},
                         {"width_axis_P", list(bridge.width_axis)},
                         {"centre_P_mm", list(bridge.centre_mm)}});
    }
  }
  return {{"pieces", pieces},
          {"bridges", bridges},
          {"piece_count", found.pieces},
          {"chips", {{"count", found.chips}, {"volume_mm3", found.chips_mm3}}},
          {"cut_mm3", found.cut_mm3},
          {"free", jsonOf(findings.ways)}};
}

std::string tableOf(const Findings& findings) {
  const haptics::ToothFindings& found = findings.tooth;
  std::string text = "piece   volume mm³   centroid mm (P)\n";
  const std::size_t listed = std::min(found.pieces, haptics::kMostPieces);
  for (std::size_t n = 0; n < listed; ++n) {
    const haptics::ToothPiece& piece = found.piece[n];
    text += fmt::format("{:5} {:12.1f}   ({:.1f}, {:.1f}, {:.1f})\n", n, piece.volume_mm3, piece.centroid_mm.x,
                        piece.centroid_mm.y, piece.centroid_mm.z);
    const haptics::ToothFindings::Held& held = found.held[n];
    for (std::size_t b = 0; b < held.bridges; ++b) {
      const haptics::Bridge& bridge = held.bridge[b];
      text += fmt::format("      bridge of {:.1f} mm², {:.1f} wide, {:.1f} mm thick, holds {:.1f} and {:.1f} mm³\n",
                          bridge.area_mm2, bridge.width_mm, bridge.thickness_mm,
                          held.part[bridge.between[0]].volume_mm3, held.part[bridge.between[1]].volume_mm3);
    }
    if (found.cut_mm3 > 0.0 && held.bridges == 0 && found.pieces == 1) text += "      not cut through to a bridge\n";
  }
  if (found.pieces > listed) text += fmt::format("and {} smaller pieces\n", found.pieces - listed);
  if (found.chips > 0) text += fmt::format("chips {:12.1f}   {} below 1 mm³\n", found.chips_mm3, found.chips);
  text += fmt::format("cut   {:12.1f}\n", found.cut_mm3);
  for (const PieceWay& piece : findings.ways) text += wordsOf(piece) + "\n";
  return text;
}

std::optional<glm::dvec3> exitOf(const PiecesOptions& options) {
  if (options.exit_P.empty()) return std::nullopt;
  const glm::dvec3 exit(options.exit_P[0], options.exit_P[1], options.exit_P[2]);
  const double length = glm::length(exit);
  if (!(length > 1e-6) || !std::isfinite(length))
    throw UsageError("pieces --exit: the direction has no length, give another");
  return exit / length;
}

/// Prints what was written.
int exportPieces(const PiecesOptions& options) {
  std::vector<ExportedPiece> pieces;
  if (isSession(options)) {
    if (options.tooth) throw UsageError("--tooth: a session keeps its tooth, leave it out");
    pieces = piecesOfSession(sessionNamed(options.source));
  } else {
    const Source source = toothOf(options);
    haptics::ToothSurvey survey = surveyOf(source.tooth);
    pieces = piecesOf(survey.components(), survey.pieces().pieces);
  }
  const std::vector<std::string> files = writePieces(pieces, options.out, options.force);
  nlohmann::json list = nlohmann::json::array();
  std::string table = "piece     volume mm³   place\n";
  for (const ExportedPiece& piece : pieces) {
    const std::string place(kPiecePlaces[static_cast<std::size_t>(piece.place)]);
    list.push_back({{"name", piece.name}, {"volume_mm3", piece.volume_mm3}, {"place", place}});
    table += fmt::format("{:8} {:11.1f}   {}\n", piece.name, piece.volume_mm3, place);
  }
  std::fputs((options.json ? nlohmann::json{{"pieces", list}, {"files", files}}.dump(2) + "\n" : table).c_str(),
             stdout);
  return 0;
}

int pieces(const PiecesOptions& options) {
  if (!options.out.empty() && !options.exit_P.empty())
    throw UsageError("--exit: surfaces are written as the pieces lie, leave out --exit or --out");
  if (options.out.empty() && options.force) throw UsageError("--force: nothing is written without --out, leave it out");
  if (!options.out.empty()) return exportPieces(options);
  const std::optional<glm::dvec3> exit_P = exitOf(options);
  const Findings found = findingsOf(toothOf(options), exit_P);
  if (found.tooth.pieces == 0)
    throw UsageError(fmt::format(
        "pieces: the tooth holds {:.3f} mm³ in all, no piece reaches 1 mm³: it was taken out or cut away, or "
        "its labels are wrong",
        found.tooth.chips_mm3));
  std::fputs((options.json ? jsonOf(found).dump(2) + "\n" : tableOf(found)).c_str(), stdout);
  return 0;
}

}  // namespace

void addPieces(CommandLine& molar) {
  auto options = std::make_shared<PiecesOptions>();
  CommandLine& command = molar.command("pieces", "What a tooth has come apart into, and the bridges that hold it");
  command.option("SOURCE", options->source, "Patient folder, session file, or last: at the session's end");
  command.option("--case", options->case_name, "A case of the built-in patient, see molar rehearse --cases")
      .oneOf(caseNames());
  options->volume.addTo(command);
  command
      .option("--tooth", options->tooth,
              "Patient: FDI number (default: the operated tooth). Volume: label of the tooth (default: 4, 5 and 6)")
      .wholeFrom(1, 255);
  command
      .option(
          "--exit", options->exit_P,
          "Which way is out, X,Y,Z in frame P (default: up and to the cheek of a patient's operated tooth, else up)")
      .numbers(3);
  command
      .option("--out", options->out,
              "Write the pieces as surfaces: a folder with one STL each, or FILE.stl, FILE.glb; of a session, as they "
              "are at its end, those that were taken out too")
      .valueNamed("FOLDER|FILE");
  command.flag("--force", options->force, "Replace the output if it exists");
  command.flag("--json", options->json, "All of it as JSON");
  command.footer(
      "A bridge is the least area that holds two parts of a piece, looked for around the cut: what was solid before. "
      "In a volume that is what its labels say inside the tooth. Parts below 5 mm³ count for no bridge, pieces below 1 "
      "mm³ are chips.\n"
      "Each piece is then moved out by 12 mm, the others in their places until they are out. What is in the way is "
      "enough to take away, not always the least; below 2 mm³ a piece comes out tightly.\n"
      "JSON: pieces [{id, volume_mm3, centroid_P_mm, inertia_mm5, parts}], bridges [{between (ids of parts), piece, "
      "area_mm2, thickness_mm, width_mm, normal_P, width_axis_P, centre_P_mm}], chips, cut_mm3, free [{piece, after, "
      "answer (free, grazes, blocked, not-found), blocked_mm3_by_label, in_the_way, path_mm, turned_deg, poses}], "
      "first those that come out, in their order. With --out: pieces [{name, volume_mm3, place (in place, moved, "
      "out)}], "
      "files.");
  command.does([options] { return pieces(*options); });
}

}  // namespace app
