#include "assets/patient/statement_file.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/load_error.h"
#include "assets/toml_reader.h"
#include "calibration/output_file.h"
#include "calibration/record/machine_key.h"
#include "calibration/record/sha256.h"

namespace assets {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSealTable = "\n[signature]\n", kNotReviewed = "\nreviewed = false\n",
                           kReviewed = "\nreviewed = true\n";
constexpr std::string_view kDigestKey = "volume_sha256 = ";
constexpr std::string_view kReviewedByNobody = "Done by software, reviewed by\n# nobody.",
                           kReviewedByAPerson = "Done by software; a person\n# has looked at the pictures.";

std::string pathIn(const std::string& folder, const char* name) { return (fs::path(folder) / name).string(); }

std::string valueOf(std::string_view text, const std::string& key) {
  const std::string line = "\n" + key + " = ";
  const std::size_t at = text.find(line);
  if (at == std::string_view::npos) return {};
  std::string_view value = text.substr(at + line.size());
  value = value.substr(0, std::min(value.find('\n'), value.size()));
  if (value.size() < 2) return {};
  return std::string(value.substr(1, value.size() - 2));  // without its quotes
}

void replace(std::string& text, std::string_view from, std::string_view to) {
  if (const std::size_t at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
}

std::string sealTable(const calibration::TextSignature& signature) {
  return std::string(kSealTable) + "public_key = " + quotedToml(signature.public_key) +
         "\ned25519 = " + quotedToml(signature.signature) + '\n';
}

Seal sealOf(const std::string& text) {
  const std::size_t at = text.rfind(kSealTable);
  if (at == std::string::npos) return Seal::none;
  const std::string_view rest = std::string_view(text).substr(at);
  const calibration::TextSignature signature{valueOf(rest, "public_key"), valueOf(rest, "ed25519")};
  // Nothing but the signature stands behind what it signs.
  if (rest != sealTable(signature)) return Seal::broken;
  if (!calibration::isSignatureOf(std::string_view(text).substr(0, at), signature)) return Seal::broken;
  return calibration::isOfThisMachine(signature) ? Seal::of_this_machine : Seal::of_another_machine;
}

}  // namespace

bool isWhole(const StatementFacts& facts) {
  // A machine that can sign has signed what it made: there the signature was taken away.
  const bool was_taken_away = facts.seal == Seal::none && calibration::signedByMachine({});
  return facts.seal != Seal::broken && facts.is_of_volume && !was_taken_away;
}

std::string digestOfFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  calibration::Sha256 hash;
  std::vector<char> block(1 << 20);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    hash.add({reinterpret_cast<const std::uint8_t*>(block.data()), static_cast<std::size_t>(file.gcount())});
  std::string digits;
  for (const std::uint8_t byte : hash.finish())
    for (const int nibble : {byte >> 4, byte & 15}) digits += "0123456789abcdef"[nibble];
  return digits;
}

std::string sealedStatement(std::string text) {
  if (const std::size_t at = text.rfind(kSealTable); at != std::string::npos) text.erase(at);
  const auto signature = calibration::signedByMachine(text);
  if (!signature) return text;
  return text + sealTable(*signature);
}

std::string statementAfterEdits(std::string text, const std::string& volume_sha256) {
  const std::string line = "\n" + std::string(kDigestKey);
  if (const std::size_t at = text.find(line); at != std::string::npos)
    text.replace(at, text.find('\n', at + 1) - at, line + quotedToml(volume_sha256));
  replace(text, kReviewed, kNotReviewed);
  replace(text, kReviewedByAPerson, kReviewedByNobody);
  return sealedStatement(std::move(text));
}

std::optional<StatementFacts> statementIn(const std::string& folder) {
  std::error_code error;
  if (!fs::exists(pathIn(folder, "deidentified.toml"), error)) return std::nullopt;
  const std::string text = readSmallFile(pathIn(folder, "deidentified.toml"));
  StatementFacts facts;
  facts.seal = sealOf(text);
  facts.is_of_volume = valueOf(text, "volume_sha256") == digestOfFile(pathIn(folder, "volume.vdb"));
  facts.is_reviewed = text.find(kReviewed) != std::string::npos && isWhole(facts);
  return facts;
}

void reviewStatement(const std::string& folder) {
  const std::optional<StatementFacts> facts = statementIn(folder);
  if (!facts)
    throw LoadError(folder +
                    ": it has no deidentified.toml, as a patient of DICOM files has; there is nothing to review");
  if (!isWhole(*facts) && facts->seal == Seal::none && facts->is_of_volume)
    throw LoadError(folder + ": its deidentified.toml carries no signature; import the scan again");
  if (!isWhole(*facts))
    throw LoadError(folder + ": its deidentified.toml was changed, or is of another volume; import the scan again");
  if (facts->is_reviewed) return;
  std::string text = readSmallFile(pathIn(folder, "deidentified.toml"));
  replace(text, kNotReviewed, kReviewed);
  replace(text, kReviewedByNobody, kReviewedByAPerson);
  calibration::OutputFile(pathIn(folder, "deidentified.toml"), true).commit(sealedStatement(std::move(text)));
}

}  // namespace assets
