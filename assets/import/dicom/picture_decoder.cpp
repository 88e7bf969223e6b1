#include "assets/import/dicom/picture_decoder.h"

#include <gdcmByteValue.h>
#include <gdcmDataElement.h>
#include <gdcmFragment.h>
#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTransferSyntax.h>

#include <cstring>
#include <string>
#include <vector>

namespace assets {

bool decodePicture(std::string_view syntax_uid, const CodestreamFacts& facts, std::span<const char> stream,
                   std::span<std::uint16_t> out) noexcept {
  try {
    const auto bits = static_cast<unsigned short>(facts.bits);
    const unsigned short allocated = bits <= 8 ? 8 : 16;
    gdcm::Image picture;
    picture.SetNumberOfDimensions(2);
    picture.SetDimension(0, static_cast<unsigned>(facts.columns));
    picture.SetDimension(1, static_cast<unsigned>(facts.rows));
    picture.SetPixelFormat(
        gdcm::PixelFormat(1, allocated, bits, static_cast<unsigned short>(bits - 1), facts.is_signed ? 1 : 0));
    picture.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
    picture.SetTransferSyntax(gdcm::TransferSyntax::GetTSType(std::string(syntax_uid).c_str()));

    const gdcm::SmartPointer<gdcm::SequenceOfFragments> sequence = new gdcm::SequenceOfFragments;
    gdcm::Fragment fragment;
    fragment.SetByteValue(stream.data(), static_cast<std::uint32_t>(stream.size()));
    sequence->AddFragment(fragment);
    gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
    pixels.SetVR(gdcm::VR::OB);
    pixels.SetValue(*sequence);
    picture.SetDataElement(pixels);

    const std::size_t expected_bytes = out.size() * (allocated / 8U);
    if (picture.GetBufferLength() != expected_bytes) return false;
    std::vector<char> decoded(expected_bytes);
    if (!picture.GetBuffer(decoded.data())) return false;
    for (std::size_t n = 0; n < out.size(); ++n) {
      if (allocated == 8)
        out[n] = static_cast<unsigned char>(decoded[n]);
      else
        std::memcpy(&out[n], decoded.data() + 2 * n, 2);
    }
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace assets
