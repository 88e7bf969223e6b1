// DICOM files that come over a network, one after the other, kept where no name, folder or other program sees them: in
// one file without a name, or in memory where the disk has none such. It is gone when the program ends, however it
// ends. Written by one thread; once closed, any thread may read. A system call for each piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace assets {

class ReceivedFiles {
 public:
  /// Throws LoadError: there is no place for them.
  ReceivedFiles();
  ~ReceivedFiles();
  ReceivedFiles(ReceivedFiles&&) noexcept;
  ReceivedFiles& operator=(ReceivedFiles&&) = delete;

  /// To the file that is being received. Throws LoadError: the disk is full.
  void append(std::span<const char> bytes);
  /// It is whole; the next begins.
  void endFile();
  /// Another process wrote a whole file of so many bytes to descriptor().
  void takeWritten(std::uint64_t bytes);

  std::size_t count() const { return begins_.size() - 1; }
  /// Of whole files.
  std::uint64_t bytes() const { return begins_.back(); }
  int descriptor() const { return descriptor_; }

  /// No more come. Throws LoadError.
  void close();
  /// Of a closed one; as long as this lives.
  std::span<const char> file(std::size_t n) const;

 private:
  int descriptor_ = -1;
  std::uint64_t written_ = 0;
  std::vector<std::uint64_t> begins_{0};
  const char* mapped_ = nullptr;
  std::uint64_t mapped_bytes_ = 0;
};

}  // namespace assets
