// SPDX-License-Identifier: Apache-2.0
// Keeps the light of an input in the output: pictures of more than 8 bits, alpha, and light beyond
// white, which gain maps describe in JPEG files.
#ifndef STARFOCUS_EXAMPLES_CLI_DEEP_OUTPUT_H_
#define STARFOCUS_EXAMPLES_CLI_DEEP_OUTPUT_H_

#include <string>

#include "examples/cli/engine_run.h"
#include "examples/cli/refocus_output.h"
#include "platform/gain_map.h"
#include "platform/image.h"
#include "platform/readers/capture.h"
#include "platform/result.h"
#include "platform/writers/picture.h"

namespace starfocus {

// Prints notes about what a picture of 8 bits loses.
void TellLostBits(const Capture& capture);

// Returns true if pictures with the name `path` have all bits of the input.
bool KeepsBits(const std::string& path);

// Returns an error if the picture `path` stores light, and --highlights makes light up.
Error CheckHighlights(const std::string& path, double highlights);

// Chooses whether the engine reads and writes more than 8 bits for the picture output.out, which
// may be empty. Pictures of 8 bits are dithered if an option asks
// for it, or if the views are deep. `single` is false
// for a sweep, whose pictures have 8 bits. Changes the task and the deep views of the capture, and
// prints notes about light that is lost. Returns an error if the format of the picture cannot
// describe the light.
Error ChooseBits(const OutputOptions& output, bool single, Capture* capture, EngineTask* task);

// Returns true if a single picture is written as WebP with the alpha of the input.
bool WritesWebpAlpha(const OutputOptions& output, const Capture& capture);

// Writes the picture of a result as WebP, with the alpha of its deep picture.
Error WriteWebpAlpha(const std::string& path, const PictureOptions& how,
                     const EngineResult& result);

// Writes the deep picture of a result.
Error WriteDeepResult(const std::string& path, const PictureOptions& how, const Capture& capture,
                      const EngineResult& result);

// Returns true if a single picture is written as Ultra HDR JPEG: the capture has a gain map.
bool WritesGainMap(const OutputOptions& output, const Capture& capture);

// Refocuses the light of the capture beyond white, and writes it as a gain map of the refocused
// picture.
Error WriteUltraHdr(const std::string& path, const PictureOptions& how, const Capture& capture,
                    const EngineTask& task, const Image& picture);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_DEEP_OUTPUT_H_
