// SPDX-License-Identifier: Apache-2.0
// One command on many inputs, of which bad ones do not stop the others.
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

// Whether these inputs and this output mean a picture each in a folder: there are several inputs,
// or the output is a folder, there already or by its last "/".
bool IsBatch(const std::vector<std::string>& inputs, const std::string& out);

// Names the output of each input, which keeps its name: in its own format where that is .jpg, .png,
// .ppm or .webp; .jpg of other files and .png of light fields. In place of a folder that is no
// light field stand the photographs and light fields in it. Refuses outputs of one name and those
// that are inputs, then makes the folder.
Result<std::vector<BatchItem>> PlanBatch(const std::vector<std::string>& inputs,
                                         const std::string& folder);

// Runs all of them, `jobs` at a time, with a progress line. The error of each is told on stderr
// where it happens; the one that is returned names the inputs that failed.
Error RunBatch(const std::vector<BatchItem>& items, int jobs,
               const std::function<Error(const BatchItem&)>& run);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_BATCH_H_
