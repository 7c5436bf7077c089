// SPDX-License-Identifier: Apache-2.0
// Runs a command on many inputs, and continues after errors.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_BATCH_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_BATCH_H_

#include <functional>
#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

struct BatchItem {
  std::string input, output;
};

// Returns true if the command writes pictures to a folder. The output is a folder if there are
// several inputs, or if `out` is an existing folder or ends with "/".
bool IsBatch(const std::vector<std::string>& inputs, const std::string& out);

// Chooses the output file of each input. An output file has the name of its input. Inputs of the
// formats .jpg, .png, .ppm and .webp keep their format. Inputs of other file formats get the output
// format .jpg, and light fields get the output format .png. A folder that is not a light field is
// replaced by the photographs and light fields in it. Returns an error if outputs coincide with
// each other or with inputs. If all outputs are valid, creates the output folder.
Result<std::vector<BatchItem>> PlanBatch(const std::vector<std::string>& inputs,
                                         const std::string& folder);

// Runs all items, `jobs` at a time, and shows progress. Each error is printed to stderr
// immediately. The returned error lists the inputs that failed.
Error RunBatch(const std::vector<BatchItem>& items, int jobs,
               const std::function<Error(const BatchItem&)>& run);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_BATCH_H_
