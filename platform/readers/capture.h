// SPDX-License-Identifier: Apache-2.0
// Whatever people have that can be refocused: a folder of views in one of several layouts, or a
// photograph with a depth map. Which it is, is told by what is there.
#ifndef STARFOCUS_PLATFORM_READERS_CAPTURE_H_
#define STARFOCUS_PLATFORM_READERS_CAPTURE_H_

#include <string>
#include <vector>

#include "platform/light_field.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// What a map of this format wants before it is used.
enum class MapCare { kNone, kFill, kRepair };

struct CaptureOptions {
  std::string depth;       // a depth picture for a photograph; empty: what is in or beside it
  DepthOptions map;        // how that picture is read
  bool small_map = false;  // the map of a photo keeps its own size until LoadCapture
};

struct Capture {
  std::string path, format;
  bool photo = false;           // one file and one view
  std::vector<ViewFile> files;  // of the views, the centre first
  std::string map_path;         // where the map is, for errors too; empty: there is none
  std::string coverage_path;    // where the coverage is; empty: there is none
  double map_scale = 1;         // what the numbers of the map's file are multiplied by
  MapCare care = MapCare::kNone;
  double widest = 0;  // f-stop of an aperture of radius 1; 0: nobody knows
  double f_stop = 0;  // to be used where no other is asked for; 0: the widest
  bool has_focus = false;
  int focus_x = 0, focus_y = 0;  // the pixel that the format says is in focus
  bool has_subject = false;
  int subject_x = 0, subject_y = 0;  // the pixel of the subject that EXIF names
  double focus = NAN;                // or the disparity
  Metadata metadata;
  Facts facts;
  std::vector<std::string> notes;
  LightField light_field;  // of a photo or a pair in one file from the beginning
};

// Finds out what `path` is; "-" is a photograph on standard input. Of a photograph everything is
// read, of a folder its list of files and what lies beside the pictures. The error says what was
// found and what is missing.
Result<Capture> OpenCapture(const std::string& path, const CaptureOptions& options);

// Reads the views at the positions wanted, or all if none are, and the map and the coverage if
// there are any. Views are decoded several at a time on `runner`; null: one after the other.
Error LoadCapture(const Positions& wanted, Capture* capture, ThreadRunner* runner = nullptr);

// Every file that is read for it, as far as it is open.
std::vector<std::string> CaptureFiles(const Capture& capture);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_CAPTURE_H_
