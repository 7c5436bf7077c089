// SPDX-License-Identifier: Apache-2.0
// Shows pictures on the terminal, with the kitty graphics protocol
// (https://sw.kovidgoyal.net/kitty/graphics-protocol/) or as sixels.
#ifndef STARFOCUS_PLATFORM_TERMINAL_GRAPHICS_H_
#define STARFOCUS_PLATFORM_TERMINAL_GRAPHICS_H_

#include <string>

#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

// Abilities that a terminal states in its answers to kTerminalQuery.
struct TerminalAnswers {
  bool done = false;          // True if the terminal has answered the last part of the query.
  bool kitty = false;         // True if the terminal supports the kitty graphics protocol.
  bool sixel = false;         // True if the terminal supports sixels.
  std::string attributes;     // Primary device attributes, such as "62;4;22".
  int width = 0, height = 0;  // Size of the terminal in pixels; 0: unknown.
  int sixel_width = 0, sixel_height = 0;  // Limit on the size of sixels; 0: unknown.
};

// Asks for the kitty protocol, the size in pixels (XTWINOPS 14), the limit on the size of sixels
// (XTSMGRAPHICS), and the primary device attributes. Every terminal answers the last part, so that
// its answer ends the wait for the other answers. The last characters clear the line, because old
// terminals print parts of the query.
inline constexpr char kTerminalQuery[] =
    "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[14t\x1b[?2;1;0S\x1b[c\r\x1b[K";

// Interprets the text that a terminal has sent so far. Ignores unknown parts, such as typed keys.
TerminalAnswers ReadTerminalAnswers(const std::string& text);

// A terminal that can show pictures.
struct GraphicsTerminal {
  bool kitty = false;         // True: kitty graphics protocol; false: sixels.
  int width = 0, height = 0;  // Largest size in pixels of a picture that leaves a line free.
};

// Queries the terminal of standard input and standard output. Waits at most one second for its
// answers. Returns an error of the option `option` if standard input or output is not a terminal,
// or if the terminal does not support graphics.
Result<GraphicsTerminal> FindGraphicsTerminal(const std::string& option);

// Writes a picture to standard output, which must be the terminal `terminal`. The picture must fit
// the size of the terminal. Error messages start with `option`.
Error ShowOnTerminal(const std::string& option, const GraphicsTerminal& terminal,
                     const Image& image);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_TERMINAL_GRAPHICS_H_
