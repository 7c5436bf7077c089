// SPDX-License-Identifier: Apache-2.0
// Reads a photograph and its depth picture from two files.
#ifndef STARFOCUS_PLATFORM_READERS_PAIR_H_
#define STARFOCUS_PLATFORM_READERS_PAIR_H_

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "platform/levels.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Returns true if `name` is the file name of a depth picture. Without its extension, the name of a
// depth picture ends in -depth, _depth or .depth, in upper or lower case.
bool IsDepthPictureName(const std::string& name);

// Returns true if `name` has an extension of depth pictures, which DepthPictures lists.
bool HasDepthExtension(const std::string& name);

// Finds the depth pictures of photographs among the files of a folder, or mattes with the ending
// "matte" instead of "depth". The depth picture of a photograph NAME.jpg or NAME-image.jpg is named
// NAME-depth, NAME_depth or NAME.depth, with .png, .pgm, .ppm, .webp, .pfm, .jpg, .jpeg, .tif,
// .tiff, .npy, .npz or .exr, in upper or lower case. Files in the format OpenEXR (.exr) are found
// so that their error states how to convert them.
class DepthPictures {
 public:
  DepthPictures() = default;
  explicit DepthPictures(std::string ending) : ending_(std::move(ending)) {}
  // Adds a file of the folder. Ignores files whose names are not names of depth pictures.
  void Add(const std::string& name);
  // Returns the names of the depth pictures of the photograph `name`, the best match first.
  std::vector<std::string> Of(const std::string& name) const;

 private:
  std::string ending_ = "depth";
  // Names of files by the name of the photograph in lower case, without extension.
  std::map<std::string, std::vector<std::string>> names_;
};

// Lists the depth pictures in a folder. Returns an error if the folder cannot be read.
Result<DepthPictures> ListDepthPictures(const std::string& folder);

// Finds the depth picture next to a photograph. Returns "" if no depth picture is found. If the
// folder has several depth pictures of the photograph, a note names the depth picture that is used.
Result<std::string> FindDepthPicture(const std::string& path, DepthPhoto* photo);

// Reads the samples of a depth picture or a matte (depth_file.h). Calls options.before_decoding.
Result<Samples> ReadSamples(const std::string& path, Alpha alpha, const DepthOptions& options);

// Reads the depth picture (depth_file.h). The caller must have set photo->picture. By default,
// larger values are nearer in PFM files, and the near end of other formats is guessed.
Error ReadDepthPicture(const std::string& path, const DepthOptions& options, DepthPhoto* photo);

// Interprets the samples of a depth picture as the map of the photo, like ReadDepthPicture. Error
// messages start with `where`.
Error TakeDepthPicture(const std::string& where, const DepthOptions& options, Samples samples,
                       DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PAIR_H_
