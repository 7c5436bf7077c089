// SPDX-License-Identifier: Apache-2.0
// Runs a command on many inputs, and continues after errors.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_BATCH_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_BATCH_H_

#include <functional>
#include <string>
#include <vector>

#include "examples/cli/input/find_inputs.h"
#include "platform/result.h"

namespace starfocus {

struct BatchItem {
  std::string input, output;
};

struct Batch {
  std::vector<BatchItem> items;
  std::vector<SkippedPath> skipped;
};

// Returns true if the command writes pictures to a folder. The output is a folder if there are
// several inputs, or if `out` is an existing folder or ends with "/". `estimates_depth` is true if
// a depth command estimates missing depth (find_inputs.h).
bool IsBatch(const std::vector<std::string>& inputs, const std::string& out, bool estimates_depth);

// Chooses the output file of each input. An output file has the name of its input. Inputs of the
// formats .jpg, .png, .ppm and .webp keep their format. Inputs of other file formats get the output
// format .jpg, and light fields get the output format .png. A folder that is not a light field is
// replaced by the photographs and light fields in it. Returns an error if outputs coincide with
// each other or with inputs. If all outputs are valid, creates the output folder.
Result<Batch> PlanBatch(const std::vector<std::string>& inputs, const std::string& folder,
                        bool estimates_depth);

// Runs all items, `jobs` at a time, and shows progress. Prints the skipped paths, each error
// immediately, and finally the numbers of finished, skipped and failed inputs to stderr. The
// returned error lists the inputs that failed.
Error RunBatch(const Batch& batch, int jobs, const std::function<Error(const BatchItem&)>& run);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_BATCH_H_
