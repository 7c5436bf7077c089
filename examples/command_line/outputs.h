// The files that a command is about to write, looked at together before any work.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_OUTPUTS_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_OUTPUTS_H_

#include <string>
#include <vector>

namespace starfocus {

struct Output {
  std::string option, path;
};

// Whether each is a file of its own and belongs to no light field in `folders`. Returns an error
// line, empty for success.
std::string CheckApart(const std::vector<Output>& outputs, const std::vector<std::string>& folders);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_OUTPUTS_H_
