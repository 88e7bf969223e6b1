// The calling interface of 3D Systems' OpenHaptics HDAPI as far as Molar uses it: sizes, constants, function types.
// Facts of the interface (reference/devices 2), no text of the vendor. SysV x86-64, plain C calls; mm, mm/s, rad, N.
#pragma once

#include <cstdint>

namespace haptics::hd {

using DeviceId = std::uint32_t;
using Enum = std::uint32_t;
using Boolean = std::uint8_t;
using ScheduleId = unsigned long;
/// Runs on the vendor's scheduler; returns whether it is called again.
using Callback = unsigned (*)(void* data);

/// One error of the library's stack; returned by value in two registers.
struct ErrorInfo {
  std::uint32_t code;
  std::int32_t internal_code;
  DeviceId device;
};
static_assert(sizeof(ErrorInfo) == 12 && alignof(ErrorInfo) == 4);
static_assert(sizeof(int) == 4 && sizeof(ScheduleId) == 8 && sizeof(void*) == 8, "the interface is that of x86-64");

inline constexpr DeviceId kNoDevice = 0xFFFFFFFF;
inline constexpr unsigned kCallbackDone = 0, kCallbackContinues = 1;
inline constexpr unsigned short kFirstOfATick = 65535;  ///< the highest priority

// Properties of a frame.
inline constexpr Enum kCurrentButtons = 0x2000;        ///< int; bits 1, 2, 4, 8
inline constexpr Enum kCurrentSafetySwitch = 0x2001;   ///< boolean
inline constexpr Enum kCurrentInkwellSwitch = 0x2002;  ///< boolean; its polarity depends on the device
inline constexpr Enum kCurrentPosition = 0x2050;       ///< 3 doubles, mm
inline constexpr Enum kCurrentVelocity = 0x2051;       ///< 3 doubles, mm/s
inline constexpr Enum kCurrentTransform = 0x2052;      ///< 16 doubles, column-major, translation in mm at 12..14
inline constexpr Enum kCurrentJointAngles = 0x2100;   ///< 3 doubles, rad; turret left +, thigh up +, absolute shin up +
inline constexpr Enum kCurrentGimbalAngles = 0x2150;  ///< 3 doubles, rad; right +, up -, clockwise +
inline constexpr Enum kCurrentForce = 0x2700;         ///< 3 doubles, N; zeroed when a frame begins

// Properties of the device.
inline constexpr Enum kVersion = 0x2500;                    ///< string
inline constexpr Enum kModel = 0x2501;                      ///< string
inline constexpr Enum kDriverVersion = 0x2502;              ///< string
inline constexpr Enum kSerialNumber = 0x2504;               ///< string
inline constexpr Enum kFirmwareVersion = 0x2505;            ///< string
inline constexpr Enum kMaxWorkspace = 0x2550;               ///< 6 doubles, mm: least x y z, most x y z
inline constexpr Enum kUsableWorkspace = 0x2551;            ///< the same
inline constexpr Enum kInputDof = 0x2553;                   ///< int; 3 or 6
inline constexpr Enum kOutputDof = 0x2554;                  ///< int; 3 or 6
inline constexpr Enum kCalibrationStyle = 0x2555;           ///< int, bits of CalibrationStyle
inline constexpr Enum kUpdateRate = 0x2600;                 ///< int, Hz
inline constexpr Enum kInstantaneousUpdateRate = 0x2601;    ///< int, Hz
inline constexpr Enum kNominalMaxStiffness = 0x2602;        ///< double
inline constexpr Enum kNominalMaxForce = 0x2603;            ///< double, N
inline constexpr Enum kNominalMaxContinuousForce = 0x2604;  ///< double, N
inline constexpr Enum kMotorTemperature = 0x2605;           ///< 3 or 6 doubles, 0 cold .. 1 warmest
inline constexpr Enum kNominalMaxDamping = 0x2609;          ///< double

// What can be switched on and off.
inline constexpr Enum kForceOutput = 0x4000;
inline constexpr Enum kMaxForceClamping = 0x4001, kForceRamping = 0x4002, kSoftwareForceLimit = 0x4003;
inline constexpr Enum kSoftwareVelocityLimit = 0x2606, kSoftwareForceImpulseLimit = 0x2607;

// Calibration: states, and styles as bits.
inline constexpr Enum kCalibrationOk = 0x5000, kCalibrationNeedsUpdate = 0x5001, kCalibrationNeedsManualInput = 0x5002;
inline constexpr Enum kEncoderReset = 1, kAutoCalibration = 2, kInkwellCalibration = 4;

// Errors; hd_error has their meaning.
inline constexpr std::uint32_t kSuccess = 0x0000;
inline constexpr std::uint32_t kWarmMotors = 0x0200;
inline constexpr std::uint32_t kCommunicationError = 0x0302;

}  // namespace haptics::hd
