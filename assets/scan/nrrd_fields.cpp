#include "assets/scan/nrrd_fields.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "assets/scan/header_text.h"
#include "assets/scan/voxel_files.h"

namespace assets {

namespace {

std::string fieldName(std::string_view text) {
  std::string name = lowerCase(std::string(text));
  std::erase(name, ' ');
  return name;
}

bool isField(const std::string& name) {
  static const std::set<std::string_view> kNames = {
      "content",         "number",     "type",        "dimension",       "space",
      "spacedimension",  "sizes",      "spacings",    "thicknesses",     "axismins",
      "axismaxs",        "centers",    "centerings",  "kinds",           "labels",
      "units",           "min",        "max",         "oldmin",          "oldmax",
      "blocksize",       "endian",     "encoding",    "lineskip",        "byteskip",
      "sampleunits",     "spaceunits", "spaceorigin", "spacedirections", "datafile",
      "measurementframe"};
  return kNames.contains(name);
}

std::vector<std::string> remainingLines(HeaderText& text) {
  std::vector<std::string> files;
  while (const auto line = text.line())
    if (const std::string name = trimmed(*line); !name.empty()) files.push_back(name);
  return files;
}

std::vector<std::string> itemsOf(const std::string& text) {
  std::vector<std::string> items;
  for (std::size_t at = text.find_first_not_of(" \t"); at != std::string::npos;
       at = at < text.size() ? text.find_first_not_of(" \t", at) : std::string::npos) {
    const char end = text[at] == '(' ? ')' : text[at] == '"' ? '"' : ' ';
    std::size_t last = text.find(end, at + 1);
    if (end != ' ' && last != std::string::npos) ++last;
    last = std::min(last, text.size());
    items.push_back(trimmed(std::string_view(text).substr(at, last - at)));
    at = last;
  }
  return items;
}

}  // namespace

NrrdFields::NrrdFields(const RegularFile& file) : path_(file.path()) {
  HeaderText text(file);
  const std::string magic = text.line().value_or("");
  if (magic.size() != 8 || !magic.starts_with("NRRD000") || magic[7] < '1' || magic[7] > '5')
    refuseScan(path_, "it is not an NRRD file; export it as NRRD");

  while (const auto line = text.line()) {
    if (line->empty()) break;
    if (line->starts_with('#')) continue;
    const std::size_t colon = line->find(": ");
    if (line->find(":=") < colon) continue;
    const std::string name = colon == std::string::npos ? "" : fieldName(line->substr(0, colon));
    if (!isField(name))
      refuse("line " + std::to_string(text.lineNumber()) +
             " is not a field of an NRRD header, or the blank line before the voxels is missing");
    const auto [field, is_new] = value_.emplace(name, trimmed(line->substr(colon + 2)));
    if (!is_new) refuse("its header has '" + name + "' twice");
    if (name == "datafile" && isList(field->second)) {
      listed_files_ = remainingLines(text);
      break;
    }
  }
  end_byte_ = text.nextByte();
}

std::string NrrdFields::operator[](const std::string& name) const {
  const auto found = value_.find(name);
  return found == value_.end() ? std::string() : found->second;
}

std::string NrrdFields::required(const std::string& name) const {
  if (!has(name)) refuse("its header has no '" + name + "'");
  return (*this)[name];
}

std::vector<std::string> NrrdFields::items(const std::string& name) const { return itemsOf((*this)[name]); }

std::vector<std::string> NrrdFields::items(const std::string& name, std::size_t count) const {
  std::vector<std::string> found = items(name);
  if (has(name) && found.size() != count) refuseField(name);
  return found;
}

void NrrdFields::refuseField(const std::string& name) const {
  refuse("its '" + name + "' " + printableExcerpt((*this)[name]) + " is not valid");
}

void NrrdFields::refuse(const std::string& reason) const { refuseScan(path_, reason + "; export the volume again"); }

}  // namespace assets
