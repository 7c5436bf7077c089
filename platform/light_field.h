// SPDX-License-Identifier: Apache-2.0
// A light-field folder: view_<u>_<v>.png (or .ppm, .jpg) with u, v printed %+.1f, and
// disparity.pfm with the disparity of the centre view.
#ifndef STARFOCUS_PLATFORM_LIGHT_FIELD_H_
#define STARFOCUS_PLATFORM_LIGHT_FIELD_H_

#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/pfm.h"
#include "platform/runner.h"

namespace starfocus {

struct LightField {
  std::vector<Image> views;  // 1, 5, 9 or 17, in the order of sf_view_position
  FloatMap disparity;

  int width() const { return disparity.width; }
  int height() const { return disparity.height; }
};

// The sizes a star-shaped set may have, smallest first.
inline constexpr int kStarSets[] = {1, 5, 9, 17};
bool IsStarSet(int views);

// "view_-0.5_+1.0" for captured view `index`.
std::string ViewName(int index);

std::string DisparityPath(const std::string& folder);

// Every file that `folder` holds of a light field.
std::vector<std::string> LightFieldFiles(const std::string& folder);

// Whether the file of that name, in a folder, is taken for a part of its light field.
bool IsLightFieldFile(const std::string& name);

// The largest complete star set in `folder`. A set that is only partly there is an error that
// names a missing file.
std::string CountViews(const std::string& folder, int* views);

std::string ReadDisparity(const std::string& folder, FloatMap* map);

// Whether the folder has a disparity map; it may be a bad one.
bool HasDisparity(const std::string& folder);

// Loads the views of the largest complete set, or only the first `views` ones when views is not 0.
// All sizes must agree.
std::string LoadCaptured(const std::string& folder, int views, std::vector<Image>* captured);

// Loads these views and the disparity map, of the same size.
std::string LoadLightField(const std::string& folder, int views, LightField* light_field);

// Makes the folder if needed and writes PNG views, several at a time on `runner`, and the disparity
// map.
std::string SaveLightField(const std::string& folder, const LightField& light_field,
                           ThreadRunner* runner);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_LIGHT_FIELD_H_
