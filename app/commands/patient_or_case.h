// The patient that a command reads: PATIENT, a folder or its name, or --case, of the built-in patient. Start-up only.
#pragma once

#include <optional>
#include <string>

#include "assets/patient.h"
#include "assets/synthetic/jaw.h"

namespace app {

class CommandLine;

class PatientOrCase {
 public:
  void addTo(CommandLine& command);
  /// Throws UsageError unless exactly one was given; `command` begins its line.
  void refuseUnlessOne(const std::string& command) const;
  bool isGiven() const { return !patient_.empty() || !case_name_.empty(); }
  /// As given, for messages: "--case usual".
  std::string name() const;
  /// What the built-in patient is made from; none: a patient of a folder.
  std::optional<assets::JawParameters> builtInJaw() const;
  /// Some seconds where the built-in patient has to be made. Throws UsageError, assets::LoadError.
  assets::Patient load() const;

 private:
  std::string patient_, case_name_;
};

}  // namespace app
