// SPDX-License-Identifier: Apache-2.0
// Finds the files of captured views in a folder. The files are named view_<u>_<v>.png (or .ppm,
// .jpg), with u and v as signed decimal numbers. A stereo pair may have the names im0.png and
// im1.png instead, as in the Middlebury data sets.
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

// Returns the first `views` positions of starfocus_view_position.
Positions StarPositions(int views);

// Returns true if a star, the default arrangement of views, can have `views` views: 1, 5, 9 or 17.
bool IsStarSet(int views);

// Returns true if the positions equal the first positions of starfocus_view_position, in order.
bool AreStar(const Positions& positions);

// Rounds a position to the four decimals that file names have.
starfocus_position RoundedPosition(double u, double v);

// Returns true if the positions are equal after rounding to the precision of file names.
bool SamePosition(const starfocus_position& a, const starfocus_position& b);

// Returns the file name of a view without its extension, for example "view_-0.5_+1.0", with one to
// four decimals.
std::string ViewName(const starfocus_position& position);

// Returns true if `name` is the file name of a captured view.
bool IsViewFile(const std::string& name);

// Finds all files of captured views in a folder. The view files are sorted: first the centre view,
// then the positions of starfocus_view_position in order, then all other positions by u and v. If
// files differ only in the extension, the first of .png, .ppm and .jpg is used. Returns an error if
// the folder or the centre view is missing, or there are more than STARFOCUS_MAX_VIEWS views.
// Returns an error if a coordinate is outside [-1, 1], or two view files have the same position.
Result<std::vector<ViewFile>> FindViewFiles(const std::string& folder);

// Returns the view files at the positions `wanted`, in the order of `wanted`, or all files if
// `wanted` is empty. Error messages start with `where`.
Result<std::vector<ViewFile>> SelectViewFiles(const std::string& where,
                                              const std::vector<ViewFile>& files,
                                              const Positions& wanted);

// Returns the view files of a folder at the positions `wanted`, or all view files if `wanted` is
// empty.
Result<std::vector<ViewFile>> ChooseViewFiles(const std::string& folder, const Positions& wanted);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_VIEW_FILES_H_
