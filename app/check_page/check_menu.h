// The check page as a state machine: what was found as a list with lights, the tool in hand, clicks, edits to undo and
// redo, questions and messages. What is clicked becomes the same clicks as those of `molar import --clicks`. Knows
// neither pictures nor windows. Frame P, mm. Plain values; any one thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/check_page/check_edits.h"
#include "assets/segment/jaw_segmentation.h"
#include "render/display/window.h"

namespace app {

enum class CheckTool : std::uint8_t {
  look,
  third_molar,
  number,
  same_tooth,
  two_teeth,
  no_tooth,
  root_tip,
  canal,
  brush,
  cut
};
struct CheckToolName {
  CheckTool tool;
  char key;
  const char* name;
  const char* about;
};
inline constexpr std::array<CheckToolName, 10> kCheckTools{{
    {CheckTool::look, 'l', "Look", "a click moves the slices to a place"},
    {CheckTool::third_molar, '8', "Third molar", "click the tooth that is 48 or 38"},
    {CheckTool::number, 'n', "Number", "type a number, then click its tooth"},
    {CheckTool::same_tooth, '=', "Same tooth", "click two pieces that are one tooth"},
    {CheckTool::two_teeth, '/', "Two teeth", "click two places of one piece that are two teeth"},
    {CheckTool::no_tooth, '-', "No tooth", "click a piece that is none"},
    {CheckTool::root_tip, 'r', "Root tip", "click the tip of a root that was not found"},
    {CheckTool::canal, 'c', "Canal",
     "click both ends; drag a point, or the line for one more; Delete over one removes it"},
    {CheckTool::brush, 'b', "Brush", "draw in a slice"},
    {CheckTool::cut, 'x', "Cut", "click both ends of a line in a slice, then what is to go beyond it"},
}};

enum class Light : std::uint8_t { open, confirmed, refused };

/// A line of the list.
struct CheckRow {
  enum class Kind : std::uint8_t { tooth, canal } kind = Kind::tooth;
  std::string words, beside;
  Light light = Light::open;
  int fdi = 0;             ///< of a tooth; 0: a piece without a number
  bool is_right = true;    ///< of a canal
  double length_mm = 0.0;  ///< of a canal
  bool is_there = true;    ///< refused and gone otherwise
  glm::dvec3 at_P_mm{0.0};
};

/// The buttons that are no tools.
enum class CheckAction : std::uint8_t { confirm, refuse, undo, redo, save, reviewed };
inline constexpr std::array<const char*, 6> kCheckActions{"Confirm", "Refuse", "Undo",
                                                          "Redo",    "Save",   "Pictures reviewed"};

/// What the brush does.
struct BrushChoice {
  double radius_mm = 1.5;
  std::uint8_t as = 0;         ///< FDI number, kPaintBone or kPaintNothing
  bool only_like_here = true;  ///< voxels as grey as where the stroke begins
};
std::string paintName(std::uint8_t as);

class CheckMenu {
 public:
  enum class Answer : std::uint8_t { none, save, reviewed, leave, discard };

  /// `may_edit`: the program found the jaw; else it came with its labels and is only looked at. `saved`: what the
  /// patient was made with.
  CheckMenu(CheckEdits edits, bool may_edit, const CheckEdits& saved);

  Answer take(const render::KeyPressed& key);
  void type(char32_t letter);
  void choose(CheckTool tool);
  void select(std::size_t row);
  /// The row of that tooth, where there is one; the place that is looked at stays.
  void selectTooth(int fdi);
  Answer act(CheckAction action);
  /// A click into the scan; `is_right`: of the patient.
  void clickAt(const glm::dvec3& p_P_mm, bool is_right);
  /// A stroke that was drawn. False: it cannot be one more.
  bool addStroke(assets::BrushStroke stroke) { return add(std::move(stroke)); }
  /// A canal whose points were moved, inserted or removed; words on fewer than two.
  void addCanal(CanalClicks canal);

  /// What there is now. The selection stays on the same tooth or canal.
  void showRows(std::vector<CheckRow> rows);
  /// The last edit did not fit: it is taken back.
  void refuseLast(const std::string& why);
  /// As saved.
  void saved();
  void say(const std::string& message, bool is_trouble) { message_ = message, is_trouble_ = is_trouble; }
  void setBusy(bool busy) { is_busy_ = busy; }

  const CheckEdits& edits() const { return edits_; }
  bool mayEdit() const { return may_edit_; }
  bool isChanged() const { return !edits_.isLike(saved_); }
  /// It was left with Esc and is to be asked about.
  bool asks() const { return asks_; }
  CheckTool tool() const { return tool_; }
  int number() const { return number_; }
  const BrushChoice& brush() const { return brush_; }
  const std::vector<glm::dvec3>& pending() const { return pending_; }
  const std::vector<CheckRow>& rows() const { return rows_; }
  std::size_t selected() const { return selected_; }
  glm::dvec3 cursor_P_mm() const { return cursor_P_mm_; }
  void moveCursor(const glm::dvec3& p_P_mm) { cursor_P_mm_ = p_P_mm; }
  /// The side of the patient that is looked at: that of a brush's teeth.
  void setSide(bool is_right) { is_cursor_right_ = is_right; }
  const std::string& message() const { return message_; }
  bool isTrouble() const { return is_trouble_; }
  /// What is asked for or can be done with the tool.
  std::string hint() const;

 private:
  bool add(CheckEdit edit);
  bool isSaid(const CheckEdit& edit) const;
  void sayOnce(CheckEdit edit);
  void setBrush(char letter);
  void clickCanal(const glm::dvec3& p_P_mm, bool is_right);
  void confirm(const CheckRow& row);
  void refuse(const CheckRow& row);
  void moveSelection(int by);

  CheckEdits edits_;
  bool may_edit_ = true;
  CheckEdits saved_;
  CheckTool tool_ = CheckTool::look;
  int number_ = 0;
  BrushChoice brush_;
  std::vector<glm::dvec3> pending_;
  bool begins_canal_ = true;
  std::vector<CheckRow> rows_;
  std::size_t selected_ = 0;
  glm::dvec3 cursor_P_mm_{0.0};
  std::string message_;
  bool is_trouble_ = false, asks_ = false, asks_review_ = false, is_busy_ = false, is_cursor_right_ = true;
};

/// Of what was found. Teeth from the right to the left, pieces without a number, what was refused, canals.
std::vector<CheckRow> checkRows(const assets::JawSegmentation& jaw, const CheckEdits& edits, int operated_fdi);

double lineLength_mm(const std::vector<glm::dvec3>& line);

}  // namespace app
