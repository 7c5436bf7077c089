// SPDX-License-Identifier: Apache-2.0
// Runs a command on many inputs, and continues after errors.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_BATCH_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_BATCH_H_

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "examples/cli/input/find_inputs.h"
#include "platform/folder.h"
#include "platform/result.h"

namespace starfocus {

struct BatchItem {
  std::string input, output;
};

struct Batch {
  std::string folder;  // of the outputs
  std::vector<BatchItem> items;
  std::vector<SkippedPath> skipped;
};

// Chooses the inputs and the output file of each input if the command writes pictures to the folder
// `out`. This is the case if there are several inputs, if `out` is an existing folder or ends with
// "/", or if the input is a folder of photographs and `out` has no extension. Otherwise returns
// nullopt. An output file has the name of its input. Inputs of the formats .jpg, .png, .ppm and
// .webp keep their format. Inputs of other file formats get the output format .jpg, and light
// fields get the output format .png. A folder that is not a light field is replaced by the
// photographs and light fields in it. `has_command` is true if a command computes the
// depth or the matte of photos (find_inputs.h).
Result<std::optional<Batch>> PlanBatch(const std::vector<std::string>& inputs,
                                       const std::string& out, bool has_command);

// Creates the output folder. Returns an error if outputs coincide with each other or with inputs.
Error MakeBatchFolder(const Batch& batch, OutputFolder* folder);

// Runs all items, `jobs` at a time, and shows progress. Prints the skipped paths, each error
// immediately, and finally the numbers of finished, skipped and failed inputs to stderr. The
// returned error lists the inputs that failed.
Error RunBatch(const Batch& batch, int jobs, const std::function<Error(const BatchItem&)>& run);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_BATCH_H_
