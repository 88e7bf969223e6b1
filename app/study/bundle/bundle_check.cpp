#include "app/study/bundle/bundle_check.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <nlohmann/json.hpp>

#include "app/text/version.h"
#include "assets/json_depth.h"
#include "assets/load_error.h"
#include "calibration/record/sha256.h"

namespace app {
namespace {

using nlohmann::ordered_json;

constexpr char kManifest[] = "manifest.json", kSignature[] = "manifest.sig", kBundleKind[] = "molar study bundle";
constexpr std::uint64_t kMostManifest = std::uint64_t{16} << 20U, kMostSignature = 200;
constexpr std::size_t kLongestName = 300, kPiece = std::size_t{1} << 16U;

std::string hexOf(const calibration::Digest& digest) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : digest) text += kHex[byte >> 4U], text += kHex[byte & 15U];
  return text;
}

void addTo(calibration::Sha256& hash, std::string_view bytes) {
  hash.add({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

ordered_json fileLine(const ZipEntry& entry) {
  calibration::Sha256 hash;
  std::uint64_t bytes = entry.bytes.size();
  if (entry.path.empty()) {
    addTo(hash, entry.bytes);
  } else {
    std::ifstream file(entry.path, std::ios::binary);
    if (!file) throw assets::LoadError(entry.path + ": cannot be read, check the name");
    std::string piece(kPiece, '\0');
    while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0) {
      const auto count = static_cast<std::size_t>(file.gcount());
      addTo(hash, {piece.data(), count});
      bytes += count;
    }
  }
  return {{"name", entry.name}, {"bytes", bytes}, {"sha256", hexOf(hash.finish())}};
}

/// On one line of a terminal.
std::string shown(const std::string& name) {
  std::string plain;
  for (const char letter : name.substr(0, kLongestName))
    plain += static_cast<unsigned char>(letter) < ' ' ? '?' : letter;
  return plain.empty() ? "(a file without a name)" : plain;
}

/// The public keys that a manifest names; none: none, or changed.
std::optional<PublicStudyKeys> keysIn(const ordered_json& manifest) {
  if (!manifest.contains("study_key") || !manifest["study_key"].is_object()) return {};
  try {
    return publicKeysFrom(manifest["study_key"].dump(-1, ' ', false, ordered_json::error_handler_t::replace),
                          kManifest);
  } catch (const assets::LoadError&) {
    return {};
  }
}

/// What the manifest says of each file against the file.
class FileCheck {
 public:
  FileCheck(const ZipReader& zip, BundleCheck& check) : zip_(zip), check_(check) {
    for (std::string& name : zip.names()) {
      if (!there_.insert(name).second) wrong(name, "is there twice");
    }
    there_.erase(kManifest), there_.erase(kSignature);
  }

  void against(const ordered_json& files) {
    for (const ordered_json& line : files) {
      const bool is_line = line.is_object() && line.contains("name") && line["name"].is_string() &&
                           line.contains("bytes") && line["bytes"].is_number_unsigned() && line.contains("sha256") &&
                           line["sha256"].is_string();
      if (!is_line) {
        wrong(kManifest, "was changed");
        continue;
      }
      ++check_.files;
      one(line["name"], line["bytes"].get<std::uint64_t>(), line["sha256"]);
    }
    for (const std::string& name : there_) wrong(name, "was added");
  }

 private:
  void one(const std::string& name, std::uint64_t bytes, const std::string& sha256) {
    if (there_.erase(name) == 0) return wrong(name, "is missing");
    calibration::Sha256 hash;
    std::uint64_t count = 0;
    const bool is_read = zip_.read(name, bytes, [&](std::string_view piece) {
      addTo(hash, piece);
      count += piece.size();
    });
    if (!is_read || count != bytes || hexOf(hash.finish()) != sha256) wrong(name, "was changed");
  }
  void wrong(const std::string& name, const char* what) { check_.wrong.push_back(shown(name) + " " + what); }

  const ZipReader& zip_;
  BundleCheck& check_;
  std::set<std::string> there_;
};

void checkSignature(const ZipReader& zip, const std::string& text, const ordered_json& manifest,
                    const std::optional<PublicStudyKeys>& known, BundleCheck& check) {
  const auto stated = keysIn(manifest);
  const auto signature = zip.text(kSignature, kMostSignature);
  if (!signature) {
    if (stated || known) check.wrong.push_back(std::string(kSignature) + " is missing");
    return;
  }
  check.signed_by = known ? known : stated;
  const auto bytes = fromBase64(std::string_view(*signature).substr(0, signature->find('\n')));
  if (!check.signed_by || !bytes || !isSignedBy(*check.signed_by, text, *bytes))
    check.wrong.push_back(known && stated && *known != *stated
                              ? std::string(kManifest) + " is signed by another key"
                              : std::string(kManifest) + " does not fit its signature");
}

}  // namespace

std::vector<ZipEntry> withManifest(std::vector<ZipEntry> entries, const std::vector<std::string>& sessions,
                                   const PrivateStudyKeys* owner) {
  std::ranges::sort(entries, {}, &ZipEntry::name);
  ordered_json files = ordered_json::array();
  for (const ZipEntry& entry : entries) files.push_back(fileLine(entry));
  ordered_json manifest{
      {"kind", kBundleKind},  {"version", 1},         {"program", "molar " + std::string(programVersion())},
      {"sessions", sessions}, {"study_key", nullptr}, {"files", files}};
  if (owner != nullptr) manifest["study_key"] = ordered_json::parse(textOf(owner->publicKeys()));
  const std::string text = manifest.dump(2) + "\n";
  entries.push_back({kManifest, text, ""});
  if (owner != nullptr) entries.push_back({kSignature, base64Of(owner->signatureOf(text)) + "\n", ""});
  return entries;
}

BundleCheck checkBundle(const std::string& path, const std::optional<PublicStudyKeys>& known) {
  if (!std::ifstream(path)) throw assets::LoadError(path + ": cannot be read, check the name");
  const ZipSeal seal = zipSeal(path);
  if (seal == ZipSeal::none) throw assets::LoadError(path + ": is no bundle of a study, or its end is cut off");
  BundleCheck check;
  std::optional<ZipReader> zip;
  try {
    zip.emplace(path);
  } catch (const assets::LoadError&) {
    check.wrong.emplace_back("the directory of the file was changed");
    return check;
  }
  const auto text = zip->text(kManifest, kMostManifest);
  ordered_json manifest;
  if (text && !assets::isNestedTooDeep(*text)) manifest = ordered_json::parse(*text, nullptr, false);
  const bool is_manifest = manifest.is_object() && manifest.contains("kind") && manifest["kind"] == kBundleKind &&
                           manifest.contains("files") && manifest["files"].is_array();
  if (!is_manifest) {
    check.wrong.push_back(std::string(kManifest) + (text ? " was changed" : " is missing, or was changed"));
    return check;
  }
  FileCheck(*zip, check).against(manifest["files"]);
  checkSignature(*zip, *text, manifest, known, check);
  if (manifest.contains("sessions") && manifest["sessions"].is_array())
    for (const ordered_json& one : manifest["sessions"])
      if (one.is_string()) check.sessions.push_back(shown(one));
  if (check.wrong.empty() && seal == ZipSeal::broken) check.wrong.emplace_back("bytes between the files were changed");
  return check;
}

}  // namespace app
