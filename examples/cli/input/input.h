// SPDX-License-Identifier: Apache-2.0
// What commands refocus or look at: a folder of views or a depth photo, with its map as good as it
// can be had.
#ifndef STARFOCUS_EXAMPLES_CLI_INPUT_INPUT_H_
#define STARFOCUS_EXAMPLES_CLI_INPUT_INPUT_H_

#include <string>
#include <vector>

#include "examples/command_line/command.h"
#include "platform/readers/capture.h"
#include "platform/result.h"

namespace starfocus {

struct InputOptions {
  std::string path, depth, coverage;
  DepthOptions map = {};
};

// What is typed of a map's care: nothing is what the format needs.
struct MapOptions {
  bool repair = false, no_repair = false, fill = false;
};

// `several`: paths of which each is an input, in place of the one of `options`; or null.
void AddInputOptions(Command* command, InputOptions* options,
                     std::vector<std::string>* several = nullptr);
void AddMapOptions(Command* command, MapOptions* options);

// Finds out what it is (OpenCapture); what was guessed goes to stderr. The map of a photo keeps its
// own size until LoadInput.
Result<Capture> OpenInput(const InputOptions& options);

// Reads the views wanted, or all if none are, and the map; one that is not there is estimated from
// these views, and a line on stderr says so.
Error LoadInput(const Positions& views, int threads, Capture* capture);

// Whether CareForMap repairs the map, which takes seconds for each megapixel.
bool WillRepair(const MapOptions& options, const Capture& capture);

// Repairs the map or fills its holes, as asked for or as its format needs; one that was estimated
// stays.
Error CareForMap(const MapOptions& options, int threads, Capture* capture);

// Replaces what a map does not know by its nearest neighbour. Errors are about `where`.
Error FillHoles(const std::string& where, FloatMap* map);

// The folder of the input where its views have other names than ours: every picture in it is taken
// for a view.
std::vector<std::string> GridsOf(const InputOptions& options, const Capture& capture);

// What errors about the map name.
std::string MapName(const Capture& capture);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_INPUT_INPUT_H_
