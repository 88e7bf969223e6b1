// The frames of the workstation, as tag types for Pose, Point and Vector. Right-handed, mm.
// A letter in a name (`X_WT`, `p_P_mm`, `F_W_N`) stands for one of these.
#pragma once

namespace calibration {

struct World {};        ///< W: display frame; centre of the virtual screen, x right, y up, z to the viewer
struct Device {};       ///< D: base of the haptic device
struct Handle {};       ///< H: the stylus in the hand
struct Tool {};         ///< T: centre of the cutting head, +z along the shaft away from the tip
struct OtherTool {};    ///< O: the second hand's instrument, in its mesh's axes; +z along its handle
struct Patient {};      ///< P: LPS as the scan; x to the patient's left, y posterior, z superior
struct Piece {};        ///< Q: a tooth or a piece of it, in the patient's axes as they were before it moved
struct Screen {};       ///< S: the physical panel
struct ScreenImage {};  ///< I: the panel's mirror image, the virtual screen
struct Camera {};       ///< C: a webcam
struct Board {};        ///< B: calibration board or jig
struct Face {};         ///< F: glTF axes of a face model, in mm; x to the patient's left, y up, z forward

}  // namespace calibration
