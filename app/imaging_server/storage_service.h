// The storage service (PS3.4 annex B) that a server sends a C-MOVE's files to, in the child of dicom_network: listens
// on one address, takes associations of that server's AE title to ours, CT storage in every packing that is read, and
// files that name our move as their origin; each is written as it comes, unread, to the kept descriptor. One thread of
// its own, one association at a time.
#pragma once

#include <atomic>
#include <functional>

#include "app/imaging_server/dicom_child.h"

struct T_ASC_Association;
struct T_ASC_Network;
struct T_DIMSE_C_StoreRQ;

namespace app {

class StorageService {
 public:
  /// `alive` is called for everything new.
  StorageService(const ServerAddress& address, const ServerSettings& settings, const ReceiveLimits& limits,
                 DicomTalk& talk, std::function<void()> alive);
  ~StorageService();
  StorageService(const StorageService&) = delete;
  StorageService& operator=(const StorageService&) = delete;

  bool isOpen() const { return listening_ >= 0; }
  /// Until finish().
  void run();
  /// Once the association that is open has ended.
  void finish() { is_finished_.store(true, std::memory_order_release); }

 private:
  void serve(int connection);
  void hurry() const;
  bool isWelcome(T_ASC_Association& association) const;
  void answerAll(T_ASC_Association& association);
  bool take(T_ASC_Association& association, unsigned char context, T_DIMSE_C_StoreRQ& request);
  static void progressed(void* service, unsigned long bytes);

  const ServerAddress& address_;
  const ServerSettings& settings_;
  const ReceiveLimits& limits_;
  DicomTalk& talk_;
  std::function<void()> alive_;
  std::atomic<bool> is_finished_{false};
  int listening_ = -1, connection_ = -1;
  int file_ = -1;  ///< one file, in memory, before it is appended
  T_ASC_Network* network_ = nullptr;
};

}  // namespace app
