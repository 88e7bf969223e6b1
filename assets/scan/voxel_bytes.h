// The bytes of a volume's voxels, in the file's order and byte order, out of all its data files, unpacked. Exactly as
// many as the header promises: a file that holds fewer, or more (but for a line's end behind raw ones), a packed stream
// that is cut, or one whose checksum does not fit, is a LoadError of one line. Nothing is made up. Any thread; 1 MB of
// memory; about 300 MB/s from a gzip stream, 40 MB/s from text, else the disk's speed.
#pragma once

#include <functional>
#include <span>

#include "assets/scan/image_header.h"

namespace assets {

/// Throws if the files can not hold what the header promises; cheap, so ask before memory is taken for the voxels.
void requireDataLength(const ImageHeader& header);

/// Hands out blocks of whole voxels; those of text are in the machine's byte order.
void forEachVoxelBlock(const ImageHeader& header, const std::function<void(std::span<const char>)>& take);

}  // namespace assets
