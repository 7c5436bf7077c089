// SPDX-License-Identifier: Apache-2.0
// Prints notes about inputs on stderr, such as assumptions of the program that options override.
#ifndef STARFOCUS_EXAMPLES_CLI_INPUT_NOTES_H_
#define STARFOCUS_EXAMPLES_CLI_INPUT_NOTES_H_

#include <string>

namespace starfocus {

// Prints "<input>: <note>", unless this run of the program has already printed a note for another
// input that differs only in its numbers. A note of a folder with a thousand photos, or of the
// frames of a clip, is therefore one line. Thread-safe.
void TellNote(const std::string& input, const std::string& note);

// Prints to how many other inputs notes like the printed ones apply. Called at the end of a batch.
void TellOtherInputs();

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_INPUT_NOTES_H_
