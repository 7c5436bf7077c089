// SPDX-License-Identifier: Apache-2.0
// Reads stereo pairs: the two pictures of 3D cameras in one file (.mpo, the Multi-Picture Format of
// CIPA DC-007), the two pictures of a spatial photo (HEIF), or two files.
#ifndef STARFOCUS_PLATFORM_READERS_STEREO_PAIR_H_
#define STARFOCUS_PLATFORM_READERS_STEREO_PAIR_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Reads the right picture of a stereo pair into photo->right. The caller must have stored the first
// picture of the file in photo->picture, and a HEIF file may replace this picture by its left
// picture. In a JPEG file, a stereo pair has a multi-picture index or the extension .mpo, and its
// second picture has the size of the first picture. Returns false if the file is not a stereo pair.
bool ReadStereoPair(const std::string& path, Span file, DepthPhoto* photo);

// Returns true if a JPEG file contains a picture that ReadStereoPair accepts as the right picture,
// if its size is that of the first picture. Decodes no picture.
bool MayBeStereoPair(const std::string& path, Span file);

// Reads a stereo pair from two files. The pictures are turned upright, and must then have the same
// size. Depth maps in the files are ignored.
Result<DepthPhoto> ReadPictureFiles(const std::string& left, const std::string& right);

// Measures how the heights of points differ in the two pictures of a pair, and moves the points of
// photo->right accordingly. Adds a note about a movement, or if the heights cannot be measured
// because the pictures consist of a repeated pattern. Returns an error if the pictures show
// different scenes or differ by more than small movements and rotations.
Error AlignPair(const std::string& where, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_STEREO_PAIR_H_
