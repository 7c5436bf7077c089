// SPDX-License-Identifier: Apache-2.0
// Finds the light fields and photos in a folder, opens an input, which is a folder of views or a
// depth photo, and obtains the best available map. Describes inputs as JSON, and prints notes about
// them on stderr, such as assumptions of the program that options override.
#ifndef STARFOCUS_EXAMPLES_CLI_INPUT_H_
#define STARFOCUS_EXAMPLES_CLI_INPUT_H_

#include <string>
#include <vector>

#include "examples/cli/input_options.h"
#include "examples/cli/json.h"
#include "platform/readers/capture.h"
#include "platform/result.h"

namespace starfocus {

// A file or folder that is not an input, and the reason.
struct SkippedPath {
  std::string path, reason;
};

struct FoundInputs {
  std::vector<std::string> paths;    // in natural order (natural_order.h)
  std::vector<SkippedPath> skipped;  // in natural order of the paths; without hidden files
};

// Returns the inputs that `path` stands for. If `path` is a folder but not a light field, these are
// the photos and light fields in the folder, without the folder `out`. Otherwise the only input is
// `path`. A PNG, WebP, PPM, TIFF or OpenEXR file is a photo if it has a depth picture next to it,
// or if `has_command` is true, which means that a command computes the depth or the matte of
// photos. A row of pictures with numbers in their names is a light field unless one of the pictures
// has depth or `has_command` is true. If a folder contains several stereo pairs in the folders
// `left` and `right`, the inputs are the left pictures. Returns an error if the folder contains no
// input.
Result<FoundInputs> FindInputs(const std::string& path, bool has_command, const std::string& out);

// Returns the name of an input without folders, and without extension if the input is a file.
// Output pictures get this name.
std::string NameOfInput(const std::string& input);

// Prints the skipped paths to stderr.
void TellSkipped(const std::vector<SkippedPath>& skipped);

// Returns an error if --near contradicts --depth-unit.
Error CheckNear(const DepthOptions& options);

// Opens the input (OpenCapture). If the input is a photo without depth, runs the depth command. The
// map of a photo is not resized before LoadInput.
Result<Capture> ReadInput(const InputOptions& options);

// Prints notes about the input to stderr.
void TellNotes(const Capture& capture);

// Prints notes about what pictures of 8 bits lose.
void TellLost(const Capture& capture);

// Calls ReadInput, TellNotes and TellLost.
Result<Capture> OpenInput(const InputOptions& options);

// Returns an error of the option --views unless the input has views at these positions.
Error CheckViews(const Positions& views, const Capture& capture);

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

// Returns the facts in the files of an input whose views are loaded, and those about their light.
Facts FactsOf(const Capture& capture);

// Returns the format of an input whose views are loaded, its facts, and the size, number and
// positions of its views.
Json Describe(const Capture& capture);

// Prints "<input>: <note>", unless this run of the program has already printed a note for another
// input that differs only in its numbers. A note of a folder with a thousand photos, or of the
// frames of a clip, is therefore one line. Thread-safe.
void TellNote(const std::string& input, const std::string& note);

// Prints to how many other inputs notes like the printed ones apply. Called at the end of a batch.
void TellOtherInputs();

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_INPUT_H_
