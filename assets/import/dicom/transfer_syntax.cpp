#include "assets/import/dicom/transfer_syntax.h"

namespace assets {

std::string unreadSyntaxName(std::string_view uid) {
  struct Named {
    std::string_view uid, name;
  };
  static constexpr std::array<Named, 12> kUnread = {{
      {"1.2.840.10008.1.2.8.1", "Deflated Image Frame"},
      {"1.2.840.10008.1.2.4.92", "JPEG 2000 multi-component lossless"},
      {"1.2.840.10008.1.2.4.93", "JPEG 2000 multi-component"},
      {"1.2.840.10008.1.2.4.94", "JPIP referenced"},
      {"1.2.840.10008.1.2.4.95", "JPIP referenced, deflated"},
      {"1.2.840.10008.1.2.4.100", "MPEG-2 video"},
      {"1.2.840.10008.1.2.4.102", "MPEG-4 video"},
      {"1.2.840.10008.1.2.4.107", "HEVC video"},
      {"1.2.840.10008.1.2.4.110", "JPEG XL lossless"},
      {"1.2.840.10008.1.2.4.201", "High-throughput JPEG 2000 lossless"},
      {"1.2.840.10008.1.2.4.202", "High-throughput JPEG 2000 lossless, by resolution"},
      {"1.2.840.10008.1.2.4.203", "High-throughput JPEG 2000"},
  }};
  for (const Named& known : kUnread)
    if (known.uid == uid) return std::string(known.name);
  return "a packing of its own";
}

}  // namespace assets
