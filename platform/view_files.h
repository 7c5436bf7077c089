// SPDX-License-Identifier: Apache-2.0
// The files of captured views in a folder: view_<u>_<v>.png (or .ppm, .jpg) with u and v as decimal
// numbers with a sign; or im0.png and im1.png of a stereo pair, as the Middlebury data sets have
// it.
#ifndef STARFOCUS_PLATFORM_VIEW_FILES_H_
#define STARFOCUS_PLATFORM_VIEW_FILES_H_

#include <string>
#include <vector>

#include "platform/result.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Positions of captured views, the centre (0, 0) first.
using Positions = std::vector<starfocus_position>;

struct ViewFile {
  starfocus_position position;
  std::string path;
};

// The first `views` of starfocus_view_position.
Positions StarPositions(int views);

// Whether the star has that many views: 1, 5, 9 or 17.
bool IsStarSet(int views);

// Whether these are the first ones of starfocus_view_position, in their order.
bool AreStar(const Positions& positions);

// A position as names of files tell it: of four decimals.
starfocus_position RoundedPosition(double u, double v);

// Whether the two are one view's, up to what names of files tell.
bool SamePosition(const starfocus_position& a, const starfocus_position& b);

// "view_-0.5_+1.0": one to four decimals.
std::string ViewName(const starfocus_position& position);

// Whether a file of that name, in a folder, is taken for a captured view.
bool IsViewFile(const std::string& name);

// All files of captured views in a folder, the centre first, then those of starfocus_view_position
// in their order, then the others by u and v. Of one name the first of .png, .ppm and .jpg counts.
// Errors: no folder, no centre view, more than STARFOCUS_MAX_VIEWS, a position beyond 1, two files
// of one.
Result<std::vector<ViewFile>> FindViewFiles(const std::string& folder);

// Those of `files` at the positions wanted, in their order, or all of them if none are. Errors are
// about `where`.
Result<std::vector<ViewFile>> SelectViewFiles(const std::string& where,
                                              const std::vector<ViewFile>& files,
                                              const Positions& wanted);

// The same of all files of a folder.
Result<std::vector<ViewFile>> ChooseViewFiles(const std::string& folder, const Positions& wanted);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_VIEW_FILES_H_
