#include "calibration/yaml_writer.h"

#include <opencv2/core.hpp>

namespace calibration {
namespace {

void writeValue(cv::FileStorage& file, const std::string& key, const auto& scalar) { cv::write(file, key, scalar); }

template <class Number>
void writeValue(cv::FileStorage& file, const std::string& key, const std::vector<Number>& list) {
  file.startWriteStruct(key, cv::FileNode::SEQ | cv::FileNode::FLOW);
  for (const Number value : list) cv::write(file, {}, value);
  file.endWriteStruct();
}

}  // namespace

struct YamlWriter::Storage {
  cv::FileStorage file{"out.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML};
};

YamlWriter::YamlWriter() : storage_(std::make_unique<Storage>()) {}
YamlWriter::~YamlWriter() = default;

void YamlWriter::put(const std::string& key, const Value& value) {
  std::visit([&](const auto& data) { writeValue(storage_->file, key, data); }, value.data);
}

void YamlWriter::put(Fields fields) {
  for (const Field& field : fields) put(field.key, field.value);
}

void YamlWriter::matrix(const std::string& key, const glm::dmat4& m) {
  cv::Mat rows(4, 4, CV_64F);
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) rows.at<double>(r, c) = m[c][r];
  cv::write(storage_->file, key, rows);
}

void YamlWriter::map(const std::string& key, Fields fields) {
  openMap(key);
  put(fields);
  close();
}

void YamlWriter::openMap(const std::string& key) { storage_->file.startWriteStruct(key, cv::FileNode::MAP); }
void YamlWriter::openList(const std::string& key) { storage_->file.startWriteStruct(key, cv::FileNode::SEQ); }
void YamlWriter::close() { storage_->file.endWriteStruct(); }

void YamlWriter::entry(Fields fields) {
  storage_->file.startWriteStruct({}, cv::FileNode::MAP | cv::FileNode::FLOW);
  put(fields);
  close();
}

std::string YamlWriter::text() { return storage_->file.releaseAndGetString(); }

}  // namespace calibration
