// SPDX-License-Identifier: Apache-2.0
// Values of command-line options. The errors name the option.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_OPTIONS_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_OPTIONS_H_

#include <string>

#include "examples/command_line/command.h"
#include "platform/result.h"
#include "platform/view_files.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A finite number, all of `text`.
Error ParseNumber(const std::string& option, const std::string& text, double* value);

// A whole number in [low, high].
Error ParseWhole(const std::string& option, const std::string& text, int low, int high, int* value);

// Two whole numbers from 0 to 65535 with `separator` between them.
Error ParsePair(const std::string& option, const std::string& text, char separator, int* first,
                int* second);

// X,Y,W,H: a rectangle of whole numbers, neither side 0.
Error ParseRegion(const std::string& option, const std::string& text, sf_region* region);

// A radius above 0 and at most 1.
Error ParseAperture(const std::string& option, const std::string& text, double* value);

// A number from 0 to 100.
Error ParsePercentage(const std::string& option, const std::string& text, double* value);

// A factor from SF_MIN_N_SCALE to SF_MAX_N_SCALE.
Error ParseScale(const std::string& option, const std::string& text, double* value);

// 17, 9, 5 or 1: those of the star, or U,V:U,V and so on: views at those positions, the first one
// at 0,0, all within +-1, rounded to four decimals as names of files are.
Error ParseViews(const std::string& option, const std::string& text, Positions* positions);

// A factor from 1 to SF_MAX_HIGHLIGHTS.
Error ParseHighlights(const std::string& option, const std::string& text, double* value);

// srgb or none.
Error ParseTransfer(const std::string& option, const std::string& text, sf_transfer* value);
void AddTransferOption(Command* command, const char* help, std::string* text);

// `value` with %g.
std::string Short(double value);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_OPTIONS_H_
