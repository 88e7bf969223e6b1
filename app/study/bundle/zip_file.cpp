#include "app/study/bundle/zip_file.h"

#include <zip.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <span>

#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "calibration/record/sha256.h"

namespace app {
namespace {

constexpr std::string_view kSealMark = "molar bundle sha256:";
constexpr std::size_t kDigits = 64, kPieceBytes = std::size_t{1} << 16U;
constexpr zip_uint16_t kFirstDay = (1U << 5U) | 1U;  // 1980-01-01, as DOS counts
constexpr zip_uint32_t kPlainFile = 0100644U << 16U;

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, Discard>;

std::string errorText(int code) {
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

/// Of all bytes but the digits at the end; none: too short, or no mark before them.
struct Sealed {
  std::string stated, found;
};
std::optional<Sealed> sealOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::int64_t>(file.tellg());
  const auto digits_at = size - static_cast<std::int64_t>(kDigits),
             mark_at = digits_at - static_cast<std::int64_t>(kSealMark.size());
  if (!file || mark_at < 0) return {};
  Sealed seal{std::string(kDigits, '\0'), ""};
  std::string mark(kSealMark.size(), '\0');
  file.seekg(mark_at);
  file.read(mark.data(), static_cast<std::streamsize>(mark.size()));
  file.read(seal.stated.data(), kDigits);
  if (!file || mark != kSealMark) return {};
  file.seekg(0);
  calibration::Sha256 hash;
  std::vector<char> piece(kPieceBytes);
  for (std::int64_t left = digits_at; left > 0;) {
    const auto count = std::min<std::int64_t>(left, static_cast<std::int64_t>(piece.size()));
    if (!file.read(piece.data(), count)) return {};
    hash.add({reinterpret_cast<const std::uint8_t*>(piece.data()), static_cast<std::size_t>(count)});
    left -= count;
  }
  constexpr std::string_view kHex = "0123456789abcdef";
  for (const std::uint8_t byte : hash.finish()) seal.found += kHex[byte >> 4U], seal.found += kHex[byte & 15U];
  return seal;
}

void addEntry(zip_t* archive, const ZipEntry& entry) {
  zip_source_t* const source = entry.path.empty()
                                   ? zip_source_buffer(archive, entry.bytes.data(), entry.bytes.size(), 0)
                                   : zip_source_file(archive, entry.path.c_str(), 0, -1);
  const zip_int64_t at = source == nullptr ? -1 : zip_file_add(archive, entry.name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (at < 0) {
    if (source != nullptr) zip_source_free(source);
    throw UsageError(entry.name + ": cannot be put into the bundle (" + zip_strerror(archive) + ")");
  }
  const auto index = static_cast<zip_uint64_t>(at);
  constexpr zip_uint32_t kTightest = 9;
  zip_set_file_compression(archive, index, entry.path.empty() ? ZIP_CM_DEFLATE : ZIP_CM_STORE, kTightest);
  zip_file_set_dostime(archive, index, 0, kFirstDay, 0);
  zip_file_set_external_attributes(archive, index, 0, ZIP_OPSYS_UNIX, kPlainFile);
}

}  // namespace

void writeZip(const std::string& path, std::vector<ZipEntry> entries) {
  std::ranges::sort(entries, {}, &ZipEntry::name);
  int code = 0;
  Archive archive(zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
  if (!archive) throw UsageError(path + ": cannot be written (" + errorText(code) + ")");
  for (const ZipEntry& entry : entries) addEntry(archive.get(), entry);
  const std::string comment = std::string(kSealMark) + std::string(kDigits, '0');
  zip_set_archive_comment(archive.get(), comment.data(), static_cast<zip_uint16_t>(comment.size()));
  if (zip_close(archive.get()) != 0)
    throw UsageError(path + ": cannot be written (" + zip_strerror(archive.get()) + ")");
  archive.release();
  const auto seal = sealOf(path);
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  if (seal && file.seekp(-static_cast<std::int64_t>(kDigits), std::ios::end)) file << seal->found;
  file.close();
  if (!seal || !file) throw UsageError(path + ": its seal cannot be written, make room on the disk");
}

ZipSeal zipSeal(const std::string& path) {
  const auto seal = sealOf(path);
  return !seal ? ZipSeal::none : seal->stated == seal->found ? ZipSeal::intact : ZipSeal::broken;
}

struct ZipReader::Impl {
  std::unique_ptr<zip_t, void (*)(zip_t*)> archive{nullptr, &zip_discard};
};

ZipReader::ZipReader(const std::string& path) : impl_(std::make_unique<Impl>()) {
  int code = 0;
  impl_->archive.reset(zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &code));
  if (!impl_->archive) throw assets::LoadError(path + ": cannot be read as a ZIP file (" + errorText(code) + ")");
  if (zip_get_num_entries(impl_->archive.get(), 0) > static_cast<zip_int64_t>(kMostEntries))
    throw assets::LoadError(path + ": it holds more than " + std::to_string(kMostEntries) + " files");
}

ZipReader::~ZipReader() = default;

std::vector<std::string> ZipReader::names() const {
  std::vector<std::string> all;
  const zip_int64_t count = zip_get_num_entries(impl_->archive.get(), 0);
  for (zip_int64_t n = 0; n < count; ++n) {
    const char* const name = zip_get_name(impl_->archive.get(), static_cast<zip_uint64_t>(n), 0);
    all.emplace_back(name == nullptr ? "" : name);
  }
  return all;
}

bool ZipReader::read(const std::string& name, std::uint64_t most,
                     const std::function<void(std::string_view)>& take) const {
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen(impl_->archive.get(), name.c_str(), 0),
                                                               &zip_fclose);
  if (!file) return false;
  std::vector<char> piece(kPieceBytes);
  for (std::uint64_t taken = 0;;) {
    const zip_int64_t count = zip_fread(file.get(), piece.data(), piece.size());
    if (count < 0) return false;
    if (count == 0) return true;
    taken += static_cast<std::uint64_t>(count);
    if (taken > most) return false;
    take({piece.data(), static_cast<std::size_t>(count)});
  }
}

std::optional<std::string> ZipReader::text(const std::string& name, std::uint64_t most) const {
  std::string whole;
  return read(name, most, [&](std::string_view piece) { whole += piece; }) ? std::optional(whole) : std::nullopt;
}

}  // namespace app
