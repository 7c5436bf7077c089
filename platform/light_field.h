// SPDX-License-Identifier: Apache-2.0
// Reads and writes light-field folders. A folder contains captured views (view_files.h) and the
// disparity map of the centre view. The map is disparity.pfm, or disp0.pfm or disp0GT.pfm of a
// stereo pair. A light-field folder may contain the coverage of the map as coverage.png.
#ifndef STARFOCUS_PLATFORM_LIGHT_FIELD_H_
#define STARFOCUS_PLATFORM_LIGHT_FIELD_H_

#include <string>
#include <vector>

#include "platform/colour_description.h"
#include "platform/image.h"
#include "platform/pfm.h"
#include "platform/result.h"
#include "platform/runner.h"
#include "platform/view_files.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

struct LightField {
  std::vector<Image> views;
  // The same views, if their files have more than 8 bits or alpha; otherwise empty. Codes of
  // integers have one transfer.
  std::vector<DeepImage> deep;
  // The only view in YUV, a frame of a video; views[0] then has a size, but no pixels. Without
  // samples, `views` has all pixels.
  PlanarImage planar;
  ColourDescription deep_colours;  // Colours of `deep`, as the file of the centre view states them.
  Positions positions;  // positions of the views; empty: positions of starfocus_view_position
  FloatMap disparity;
  // starfocus_light_field.coverage in rows without padding; empty: no coverage
  std::vector<uint8_t> coverage;
  bool is_linear = false;  // true if the codes of the views are proportional to light

  int width() const { return disparity.width; }
  int height() const { return disparity.height; }
};

// Sets the number and the positions of views in a configuration.
void ConfigureViews(const LightField& light_field, starfocus_config* config);

// Returns a starfocus_depth_map that points to the values of a map.
starfocus_depth_map EngineMap(const FloatMap& map);

// Measures a map. All fields of the result are 0 if the map is empty.
starfocus_disparity_stats MeasureDisparity(const FloatMap& map);

// Returns a starfocus_image that points to the rows of a picture from `first` on.
starfocus_image EngineImage(const DeepImage& deep, int first = 0);

// Returns a starfocus_image that points to the planes of a picture.
starfocus_image EngineImage(const PlanarImage& planar);

// Returns a starfocus_light_field that points to the rows from `first` on, for a call of the
// engine. With `deep`, the views are light_field.deep. For a view in YUV, `first` must be 0.
starfocus_light_field EngineRows(const LightField& light_field, int first = 0, bool deep = false);

// Returns the path of the folder's disparity map, whether or not the file exists.
std::string DisparityPath(const std::string& folder);

// Returns the paths of all light-field files in the folder.
std::vector<std::string> LightFieldFiles(const std::string& folder);

// Returns true if light-field folders may contain a view, a map or coverage with the file name
// `name`.
bool IsLightFieldFile(const std::string& name);

Result<FloatMap> ReadDisparity(const std::string& folder);

// Returns true if the folder has a disparity map, which may be invalid.
bool HasDisparity(const std::string& folder);

// Loads the views in `files`, but no disparity map. All views must have the same size. In all
// functions of this header, `runner` decodes several views at a time; if `runner` is null, the
// calling thread decodes all views.
Result<LightField> LoadViewFiles(const std::vector<ViewFile>& files,
                                 ThreadRunner* runner = nullptr);

// Adds the disparity map in the file `path` to a light field. The map must have the size of the
// views, which must already be loaded.
Error LoadMap(const std::string& path, LightField* light_field);

// Adds a disparity map to a light field whose views are loaded. The map must have the size of the
// views. `path` appears only in error messages.
Error TakeMap(const std::string& path, FloatMap map, LightField* light_field);

// Returns the path of the coverage file in the folder, or an empty string if the file does not
// exist.
std::string CoveragePath(const std::string& folder);

// Adds the coverage in the picture `path` to a light field whose views are loaded. Coverage is the
// alpha channel of the picture, or its grey levels if it has no alpha channel. The picture must
// have the size of the views.
Error LoadCoverage(const std::string& path, LightField* light_field);

// Loads the views at the positions `wanted`, the disparity map, and the coverage if the folder
// contains coverage. The views, the map and the coverage must have the same size.
Result<LightField> LoadLightField(const std::string& folder, const Positions& wanted,
                                  ThreadRunner* runner = nullptr);

// Creates the folder of a light field if necessary. Writes the views, or their deep pictures with
// deep_colours if there are any, as PNG or, for half floats, OpenEXR, several at a time on
// `runner`. Writes the
// coverage and the disparity map of the light field unless they are empty.
Error SaveLightField(const std::string& folder, const LightField& light_field,
                     ThreadRunner* runner);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_LIGHT_FIELD_H_
