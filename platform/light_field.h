// SPDX-License-Identifier: Apache-2.0
// A light-field folder: captured views (view_files.h), disparity.pfm, or disp0.pfm or disp0GT.pfm
// of a stereo pair, with the disparity of the centre view, and perhaps its coverage, coverage.png.
#ifndef STARFOCUS_PLATFORM_LIGHT_FIELD_H_
#define STARFOCUS_PLATFORM_LIGHT_FIELD_H_

#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/pfm.h"
#include "platform/result.h"
#include "platform/runner.h"
#include "platform/view_files.h"

namespace starfocus {

struct LightField {
  std::vector<Image> views;
  Positions positions;  // of the views; empty: those of starfocus_view_position
  FloatMap disparity;
  std::vector<uint8_t> coverage;  // as starfocus_light_field.coverage, packed rows; empty: none

  int width() const { return disparity.width; }
  int height() const { return disparity.height; }
};

// Tells a configuration the views of a light field and where they lie.
void ConfigureViews(const LightField& light_field, starfocus_config* config);

// Measures a map; all is 0 of an empty one.
starfocus_disparity_stats MeasureDisparity(const FloatMap& map);

// The light field as the engine takes it, from row `first` on.
starfocus_light_field EngineRows(const LightField& light_field, int first = 0);

// The file of its map, there or not.
std::string DisparityPath(const std::string& folder);

// Every file that `folder` holds of a light field.
std::vector<std::string> LightFieldFiles(const std::string& folder);

// Whether the file of that name, in a folder, is taken for a part of its light field.
bool IsLightFieldFile(const std::string& name);

Result<FloatMap> ReadDisparity(const std::string& folder);

// Whether the folder has a disparity map; it may be a bad one.
bool HasDisparity(const std::string& folder);

// Loads the views at these positions, or all of the folder's if there are none, without the map.
// All sizes must agree. Here and below views are decoded several at a time on `runner`; null: one
// after the other.
Result<LightField> LoadCaptured(const std::string& folder, const Positions& wanted,
                                ThreadRunner* runner = nullptr);

// Loads these views without a map. All sizes must agree.
Result<LightField> LoadViewFiles(const std::vector<ViewFile>& files,
                                 ThreadRunner* runner = nullptr);

// Loads the map of views that are there, of the same size.
Error LoadMap(const std::string& path, LightField* light_field);

// Takes a map that was read from `path` for views that are there, of the same size.
Error TakeMap(const std::string& path, FloatMap map, LightField* light_field);

// The file of its coverage; empty if there is none.
std::string CoveragePath(const std::string& folder);

// Loads the coverage of views that are there, of the same size: the alpha channel of a picture, or
// the grey levels of one without.
Error LoadCoverage(const std::string& path, LightField* light_field);

// Loads these views, the disparity map and the coverage, if there is some, of the same size.
Result<LightField> LoadLightField(const std::string& folder, const Positions& wanted,
                                  ThreadRunner* runner = nullptr);

// Makes the folder if needed and writes PNG views, several at a time on `runner`, and the coverage
// and the disparity map if there are any.
Error SaveLightField(const std::string& folder, const LightField& light_field,
                     ThreadRunner* runner);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_LIGHT_FIELD_H_
