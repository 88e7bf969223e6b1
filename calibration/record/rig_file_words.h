// The words of a rig file for what is an enumeration in a RigRecord. They are part of the format: a word that is there
// keeps its meaning. Constants; any thread.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "calibration/fit/arm_fit.h"
#include "calibration/verification/verdict.h"

namespace calibration {

template <class Value>
struct FileWord {
  std::string_view word;
  Value value;
};

inline constexpr std::array<FileWord<ArmModel>, 3> kArmModelWords = {
    {{"rigid", ArmModel::rigid}, {"joints", ArmModel::joint_gains}, {"full", ArmModel::full}}};
inline constexpr std::array<FileWord<Verdict>, 3> kVerdictWords = {
    {{"green", Verdict::green}, {"amber", Verdict::amber}, {"red", Verdict::red}}};
inline constexpr std::array<FileWord<ProofKind>, 3> kProofKindWords = {
    {{"full", ProofKind::full}, {"by_eyes", ProofKind::by_eyes}, {"session_check", ProofKind::session_check}}};

/// How the arm is computed from its numbers; a file of another kind of arm has another word.
inline constexpr std::string_view kKinematicsWord = "phantom6_v1";

template <class Value, std::size_t n>
constexpr std::optional<Value> valueOf(const std::array<FileWord<Value>, n>& words, std::string_view word) {
  for (const FileWord<Value>& one : words)
    if (one.word == word) return one.value;
  return std::nullopt;
}

template <class Value, std::size_t n>
constexpr std::string_view wordOf(const std::array<FileWord<Value>, n>& words, Value value) {
  for (const FileWord<Value>& one : words)
    if (one.value == value) return one.word;
  return "";
}

}  // namespace calibration
