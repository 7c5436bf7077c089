// SPDX-License-Identifier: Apache-2.0
// Opens the input of a command, which is a folder of views or a depth photo, and obtains the best
// available map.
#ifndef STARFOCUS_EXAMPLES_CLI_INPUT_INPUT_H_
#define STARFOCUS_EXAMPLES_CLI_INPUT_INPUT_H_

#include <string>
#include <vector>

#include "examples/cli/input/input_options.h"
#include "platform/readers/capture.h"
#include "platform/result.h"

namespace starfocus {

// Opens the input (OpenCapture). If the input is a photo without depth, runs the depth command. The
// map of a photo is not resized before LoadInput.
Result<Capture> ReadInput(const InputOptions& options);

// Prints notes about the input to stderr.
void TellNotes(const Capture& capture);

// Calls ReadInput and TellNotes.
Result<Capture> OpenInput(const InputOptions& options);

// Reads the map, and the views at the positions `views`, or all views if `views` is empty. A
// missing map is estimated from the loaded views, with a message on stderr.
Error LoadInput(const Positions& views, int threads, Capture* capture);

// Returns true if CareForMap will repair the map, which takes seconds per megapixel.
bool WillRepair(const MapOptions& options, const Capture& capture);

// Repairs the map or fills its holes, as the options or the format of the map require. Does not
// change an estimated map. Then makes the coverage from the matte, unless the input has coverage.
Error CareForMap(const MapOptions& options, int threads, Capture* capture);

// Replaces unknown values of a map by the nearest known values. Error messages start with `where`.
Error FillHoles(const std::string& where, FloatMap* map);

// Returns the folder of the input if the names of its views are not starfocus names. In such a
// folder, every picture is treated as a view.
std::vector<std::string> GridsOf(const InputOptions& options, const Capture& capture);

// Returns the name of the map for error messages.
std::string MapName(const Capture& capture);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_INPUT_INPUT_H_
