// SPDX-License-Identifier: Apache-2.0
// Drawings through the program gnuplot.
#ifndef STARFOCUS_PLATFORM_GNUPLOT_H_
#define STARFOCUS_PLATFORM_GNUPLOT_H_

#include <string>

#include "platform/file.h"
#include "platform/result.h"

namespace starfocus {

// Whether a gnuplot that draws SVG can be run.
bool HasGnuplot();

// Runs gnuplot on `script`, whose data are inline and whose output goes to stdout, into *picture.
// No shell and no file name is involved. Errors name `what`.
Result<Bytes> RunGnuplot(const std::string& what, const std::string& script);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_GNUPLOT_H_
