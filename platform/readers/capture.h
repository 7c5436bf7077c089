// SPDX-License-Identifier: Apache-2.0
// Opens any input that can be refocused: a folder of views in one of several layouts, or a
// photograph with a depth map. The type of the input is detected from its content.
#ifndef STARFOCUS_PLATFORM_READERS_CAPTURE_H_
#define STARFOCUS_PLATFORM_READERS_CAPTURE_H_

#include <string>
#include <vector>

#include "platform/light_field.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Processing that a map of this format requires before use.
enum class MapCare { kNone, kFill, kRepair };

struct CaptureOptions {
  std::string depth;       // depth picture of a photograph; empty: in the file or next to the file
  DepthOptions map;        // how to read the depth picture
  bool small_map = false;  // keep the map of a photo at its own size until LoadCapture
};

struct Capture {
  std::string path, format;
  bool photo = false;           // one file with one view
  std::vector<ViewFile> files;  // files of the views, the centre first
  std::string map_path;         // file of the map, for reading and for errors; empty: none
  std::string coverage_path;    // file of the coverage; empty: none
  double map_scale = 1;         // factor of the values in the map's file
  MapCare care = MapCare::kNone;
  double widest = 0;  // f-stop of an aperture of radius 1; 0: unknown
  double f_stop = 0;  // default f-stop; 0: the widest
  bool has_focus = false;
  int focus_x = 0, focus_y = 0;  // pixel in focus by the format
  bool has_subject = false;
  int subject_x = 0, subject_y = 0;  // pixel of the subject by EXIF
  double focus = NAN;                // disparity in focus; NaN: unknown
  Metadata metadata;
  Facts facts;
  std::vector<std::string> notes;
  LightField light_field;  // set by OpenCapture for a photo or a pair in one file
};

// Opens `path`. The path "-" means a photograph on standard input. A photograph is read completely.
// For a folder, only the list of files and the calibration are read, but no pictures. An error
// describes the content that was found and the content that is missing.
Result<Capture> OpenCapture(const std::string& path, const CaptureOptions& options);

// Reads the views at the positions `wanted`, or all views if `wanted` is empty. Also reads the map
// and the coverage if they exist. `runner` decodes several views at a time; if `runner` is null,
// the calling thread decodes all views.
Error LoadCapture(const Positions& wanted, Capture* capture, ThreadRunner* runner = nullptr);

// Returns the paths of all input files that are known so far.
std::vector<std::string> CaptureFiles(const Capture& capture);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_CAPTURE_H_
