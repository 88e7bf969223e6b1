#include "calibration/record/rig_file.h"

#include <opencv2/core.hpp>

#include "calibration/checked_yaml.h"
#include "calibration/record/rig_block_reader.h"
#include "calibration/record/sha256.h"

namespace calibration {
namespace {

/// The hash; empty for a hand-written file. Throws for a broken or missing seal.
std::string sealOf(const CheckedYaml& yaml) {
  const cv::FileNode root = yaml.root();
  if (!yaml.has(root, "sha256")) {
    if (yaml.has(root, "sealed")) yaml.refuse("its end with the hash is missing", "restore it or calibrate again");
    return {};
  }
  const std::string hash = yaml.text(root, "sha256");
  const std::string last_line = "sha256: \"" + hash + "\"\n";
  const std::string& bytes = yaml.bytes();
  if (!bytes.ends_with(last_line) || sha256Of({bytes.data(), bytes.size() - last_line.size()}) != hash)
    yaml.refuse("it was edited after it was measured (its hash does not fit)", "restore it or calibrate again");
  return hash;
}

}  // namespace

RigRecord readRigRecord(const std::string& path) {
  const CheckedYaml yaml("rig file", path);
  yaml.checkKind("molar_rig");
  RigRecord record;
  record.hash = sealOf(yaml);
  const double tolerance = record.hash.empty() ? kTypedRotationTolerance : kMeasuredRotationTolerance;
  record.rig = rigIn(yaml, tolerance);
  readMetadata(yaml, tolerance, record);
  return record;
}

Rig readRig(const std::string& path) { return readRigRecord(path).rig; }

}  // namespace calibration
