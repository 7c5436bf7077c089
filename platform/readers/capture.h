// SPDX-License-Identifier: Apache-2.0
// Opens any input that can be refocused: a folder of views in one of several layouts, or a
// photograph with a depth map or a matte. OpenCapture detects the type of an input from its
// content.
#ifndef STARFOCUS_PLATFORM_READERS_CAPTURE_H_
#define STARFOCUS_PLATFORM_READERS_CAPTURE_H_

#include <optional>
#include <string>
#include <vector>

#include "platform/light_field.h"
#include "platform/readers/matte.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Processing that a disparity map of the format requires before refocusing.
enum class MapCare { kNone, kFill, kRepair };

struct CaptureOptions {
  std::string depth;       // Path of the depth picture; empty: in the photo's file or next to it.
  DepthOptions map;        // Interpretation of the depth picture.
  bool small_map = false;  // True: LoadCapture, not OpenCapture, resizes the map of a photo.
  std::string right = {};  // Path of the right picture of a stereo pair; empty: no second file.
  std::string matte = {};  // Path of the matte; empty: in the photo's file.
};

struct Capture {
  std::string path, format;
  bool photo = false;  // True if the input is one file with one view.
  // Paths of all pictures if the views are chosen from one row or column of pictures with numbers
  // in their names, otherwise empty. Such pictures may instead be separate photos.
  std::vector<std::string> row;
  std::vector<ViewFile> files;  // Files of the views, the centre first.
  std::string map_path;         // File of the map, for reading and for errors; empty: no map.
  std::string coverage_path;    // File of the coverage; empty: no coverage.
  // Matte of a photo; empty: no matte. A photo without a map is a light field of two surfaces with
  // coverage. For a photo with a map, CoverByMatte makes the coverage when the map is final.
  Matte matte;
  bool covers_by_matte = true;  // False: the coverage of `matte` is not used.
  double subject = NAN;  // Disparity of the subject if the map comes from the matte, otherwise NaN.
  MapSurvey survey;      // Figures of the map of a photo.
  double map_scale = 1;  // Factor that converts values in the file of the map to disparities.
  MapCare care = MapCare::kNone;
  double widest = 0;  // The f-stop of an aperture of radius 1; 0: unknown.
  double f_stop = 0;  // Default f-stop; 0: the widest f-stop.
  bool has_focus = false;
  int focus_x = 0, focus_y = 0;  // Pixel in focus as stated by the file.
  bool has_subject = false;
  int subject_x = 0, subject_y = 0;  // Pixel of the subject as stated by EXIF.
  double focus = NAN;                // Disparity in focus; NaN: unknown.
  Metadata metadata;
  GainMap gain_map;  // Light of a photo beyond white; no levels: no gain map.
  Facts facts;
  std::vector<std::string> notes;
  std::vector<std::string> lost;  // Notes on what pictures of 8 bits lose.
  LightField light_field;  // Filled by OpenCapture for one-file inputs, otherwise by LoadCapture.
};

// Opens `path`. The path "-" means a photograph on standard input. OpenCapture reads a photograph
// completely. For a folder, OpenCapture reads only the list of files and the calibration, but no
// pictures. An error message describes the content that was found and the content that is missing.
Result<Capture> OpenCapture(const std::string& path, const CaptureOptions& options);

// Makes the capture of a photo of one view that has been read: converts its map to disparities.
// `path` is the name of the photo, and of its map unless the map has a file of its own.
Result<Capture> TakePhoto(const std::string& path, const CaptureOptions& options, DepthPhoto photo);

// Reads the views at the positions `wanted`, or all views if `wanted` is empty. Reads the disparity
// map and the coverage if they exist. `runner` decodes several views at a time; if `runner` is
// null, the calling thread decodes all views.
Error LoadCapture(const Positions& wanted, Capture* capture, ThreadRunner* runner = nullptr);

// Returns the paths of all input files that `capture` names.
std::vector<std::string> CaptureFiles(const Capture& capture);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_CAPTURE_H_
