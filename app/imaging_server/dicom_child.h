// The part of dicom_network that speaks DICOM, for a confined child process alone (assets/scan/confined_child.h): what
// it finds goes into shared memory, what it receives into the kept descriptor. The only user of DCMTK. A timer ends the
// process after ReceiveLimits::idle_s without anything new.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "app/imaging_server/multipart_reader.h"
#include "app/imaging_server/server_address.h"
#include "app/imaging_server/server_settings.h"
#include "app/imaging_server/study_query.h"

namespace app {

enum class DicomOutcome : std::uint8_t {
  broken,
  done,
  unreachable,
  unwelcome,   ///< it rejects the association
  no_service,  ///< it does not offer find or move
  port_taken,
  not_sent,
  too_much,
};

/// Shared between program and child; nothing in it is believed beyond its bounds.
struct DicomTalk {
  std::atomic<DicomOutcome> outcome{DicomOutcome::broken};
  std::atomic<std::uint32_t> files{0};
  std::atomic<std::uint64_t> bytes{0};
  std::array<std::uint64_t, 20'000> file_bytes{};
  std::atomic<std::uint32_t> text_size{0};
  std::array<char, 1 << 18>
      text{};  ///< a study a line: identifier, date, description, modalities, images, between tabs
};

void findStudiesInChild(const ServerAddress& address, const ServerSettings& settings, const ReceiveLimits& limits,
                        const std::vector<QueryKey>& keys, DicomTalk& talk);
void moveStudyInChild(const ServerAddress& address, const ServerSettings& settings, const ReceiveLimits& limits,
                      const std::string& study_uid, DicomTalk& talk);

}  // namespace app
