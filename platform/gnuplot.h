// SPDX-License-Identifier: Apache-2.0
// Draws graphs with the program gnuplot.
#ifndef STARFOCUS_PLATFORM_GNUPLOT_H_
#define STARFOCUS_PLATFORM_GNUPLOT_H_

#include <string>

#include "platform/file.h"
#include "platform/result.h"

namespace starfocus {

// Returns true if gnuplot is installed and can write SVG.
bool HasGnuplot();

// Runs gnuplot on `script` and returns the output. `script` must contain all data and write to
// stdout. RunGnuplot uses no shell and no file names. Error messages start with `what`.
Result<Bytes> RunGnuplot(const std::string& what, const std::string& script);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_GNUPLOT_H_
