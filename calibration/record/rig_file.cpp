#include "calibration/record/rig_file.h"

#include <opencv2/core.hpp>

#include "calibration/checked_yaml.h"
#include "calibration/record/rig_block_reader.h"
#include "calibration/record/rig_metadata_reader.h"
#include "calibration/record/sha256.h"

namespace calibration {
namespace {

constexpr int kSchema = 1;

void checkKind(const CheckedYaml& yaml) {
  const cv::FileNode kind = yaml.root()["kind"];
  if (!kind.isString() || kind.string() != "molar_rig")
    yaml.refuse("it is not a rig file (kind: \"molar_rig\" missing)", "give the file that calibration wrote");
  const cv::FileNode schema = yaml.root()["schema"];
  if (schema.isInt() && static_cast<int>(schema) > kSchema)
    yaml.refuse("its schema " + std::to_string(static_cast<int>(schema)) + " is newer than this program's 1",
                "update the program");
  if (!schema.isInt() || static_cast<int>(schema) != kSchema) yaml.refuse("its schema is not 1", "write 'schema: 1'");
}

/// The hash at its end; empty for a file typed by hand. One that was sealed must still have its seal, unbroken.
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
  checkKind(yaml);
  RigRecord record;
  record.hash = sealOf(yaml);
  const double tolerance = record.hash.empty() ? kTypedRotationTolerance : kMeasuredRotationTolerance;
  record.rig = rigIn(yaml, tolerance);
  readMetadata(yaml, tolerance, record);
  return record;
}

Rig readRig(const std::string& path) { return readRigRecord(path).rig; }

}  // namespace calibration
