// A bundle: report, tables and recordings of a study in one ZIP file, with manifest.json (each file's length and
// SHA-256) and, where the owner's key was there, manifest.sig (Ed25519 over the manifest, base64). Whatever the bytes
// of a file, checking it gives lines or throws LoadError. Main thread; as fast as the disk.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/study/bundle/zip_file.h"
#include "app/study/privacy/study_keys.h"

namespace app {

/// The manifest of these entries, and its signature where `owner` signs, added to them.
std::vector<ZipEntry> withManifest(std::vector<ZipEntry> entries, const std::vector<std::string>& sessions,
                                   const PrivateStudyKeys* owner);

struct BundleCheck {
  std::vector<std::string> wrong;            ///< one line each, the file's name first; empty: nothing was changed
  std::optional<PublicStudyKeys> signed_by;  ///< the key that the signature was checked with
  std::vector<std::string> sessions;
  std::size_t files = 0;
};

/// `known`: the key that it should be signed by; none: whatever it says, which proves that it is whole, not whose it
/// is. Throws LoadError: no such file, or no bundle.
BundleCheck checkBundle(const std::string& path, const std::optional<PublicStudyKeys>& known = {});

}  // namespace app
