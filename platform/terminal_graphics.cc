// SPDX-License-Identifier: Apache-2.0
#include "platform/terminal_graphics.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <regex>

#include "platform/base64.h"
#include "platform/clock.h"
#include "platform/file.h"
#include "platform/signal_cleanup.h"
#include "platform/writers/png.h"
#include "platform/writers/sixel.h"

namespace starfocus {
namespace {

constexpr double kPatience = 1;       // Longest wait for the answers of a terminal, in seconds.
constexpr size_t kMostAnswer = 4096;  // More bytes than terminals send as answers.
// Size of a character cell if the terminal does not state its size in pixels: the size of the
// cells of the DEC VT340, for which sixels were designed.
constexpr int kCellWidth = 10, kCellHeight = 20;
constexpr size_t kKittyChunk = 4096;  // Largest payload of one escape sequence of the protocol.

void SetTerminal(const void* mode) {
  tcsetattr(STDIN_FILENO, TCSANOW, static_cast<const termios*>(mode));
}

// Reads keys without echo and without waiting for the end of a line, until the object is destroyed
// or a signal ends the program.
class KeyMode {
 public:
  KeyMode() {
    if (tcgetattr(STDIN_FILENO, &old_) != 0) return;
    termios keys = old_;
    keys.c_lflag &= ~tcflag_t(ICANON | ECHO);
    keys.c_cc[VMIN] = 0;
    keys.c_cc[VTIME] = 0;
    const SignalCleanup::Turn turn;
    cleanup_.Add(turn, SetTerminal, &old_);
    SetTerminal(&keys);
  }
  ~KeyMode() {
    if (!cleanup_.is_listed()) return;
    const SignalCleanup::Turn turn;
    SetTerminal(&old_);
    cleanup_.Remove(turn);
  }
  KeyMode(const KeyMode&) = delete;
  KeyMode& operator=(const KeyMode&) = delete;

 private:
  termios old_ = {};
  SignalCleanup cleanup_;
};

TerminalAnswers AskTerminal() {
  const KeyMode mode;
  std::fputs(kTerminalQuery, stdout);
  std::fflush(stdout);
  std::string text;
  const double end = Seconds() + kPatience;
  TerminalAnswers answers;
  while (!answers.done && text.size() < kMostAnswer) {
    pollfd input = {STDIN_FILENO, POLLIN, 0};
    const double left = end - Seconds();
    if (left <= 0 || poll(&input, 1, static_cast<int>(1000 * left) + 1) <= 0) break;
    char buffer[256];
    const ssize_t got = read(STDIN_FILENO, buffer, sizeof(buffer));
    if (got <= 0) break;
    text.append(buffer, static_cast<size_t>(got));
    answers = ReadTerminalAnswers(text);
  }
  return answers;
}

// Sets the size in pixels without the last line of characters, which is for the prompt.
void FindSize(const TerminalAnswers& answers, GraphicsTerminal* terminal) {
  winsize size = {};
  ioctl(STDOUT_FILENO, TIOCGWINSZ, &size);
  const int columns = size.ws_col > 0 ? size.ws_col : 80, rows = size.ws_row > 0 ? size.ws_row : 24;
  const auto choose = [](int stated, int answered, int guessed) {
    return stated > 0 ? stated : answered > 0 ? answered : guessed;
  };
  terminal->width = choose(size.ws_xpixel, answers.width, columns * kCellWidth);
  const int height = choose(size.ws_ypixel, answers.height, rows * kCellHeight);
  terminal->height = std::max(1, height - height / rows);
  if (terminal->kitty) return;
  // xterm shows no part of a larger picture.
  if (answers.sixel_width > 0) terminal->width = std::min(terminal->width, answers.sixel_width);
  if (answers.sixel_height > 0) terminal->height = std::min(terminal->height, answers.sixel_height);
}

// Describes a terminal without graphics.
std::string Describe(const TerminalAnswers& answers) {
  const char* const name = std::getenv("TERM");
  const std::string term = std::string("a terminal (TERM=") + (name == nullptr ? "" : name) + ")";
  if (!answers.done) return term + " that did not answer within a second";
  return term + " that did not confirm the kitty query and whose device attributes " +
         answers.attributes + " lack 4 for sixels";
}

// Returns the escape sequences of the kitty protocol that show a picture.
Result<std::string> EncodeKitty(const std::string& where, const Image& image) {
  const Result<Bytes> png = EncodePng(where, image, {}, PngSize::kQuick);
  if (!png) return png.error();
  const std::string data = EncodeBase64(*png);
  std::string text;
  for (size_t at = 0; at < data.size(); at += kKittyChunk) {
    // a=T transmits and shows the picture, f=100 means PNG, and q=2 suppresses answers.
    text += at == 0 ? "\x1b_Ga=T,f=100,q=2," : "\x1b_G";
    text += at + kKittyChunk < data.size() ? "m=1;" : "m=0;";
    text += data.substr(at, kKittyChunk) + "\x1b\\";
  }
  return text;
}

}  // namespace

TerminalAnswers ReadTerminalAnswers(const std::string& text) {
  TerminalAnswers answers;
  std::smatch match;
  answers.kitty = text.find("\x1b_Gi=31;OK\x1b\\") != std::string::npos;
  if (std::regex_search(text, match, std::regex("\x1b\\[4;([0-9]{1,5});([0-9]{1,5})t"))) {
    answers.height = std::stoi(match[1]);
    answers.width = std::stoi(match[2]);
  }
  if (std::regex_search(text, match, std::regex("\x1b\\[\\?2;0;([0-9]{1,5});([0-9]{1,5})S"))) {
    answers.sixel_width = std::stoi(match[1]);
    answers.sixel_height = std::stoi(match[2]);
  }
  if (std::regex_search(text, match, std::regex("\x1b\\[\\?([0-9;]*)c"))) {
    answers.done = true;
    answers.attributes = match[1];
    answers.sixel = (";" + answers.attributes + ";").find(";4;") != std::string::npos;
  }
  return answers;
}

Result<GraphicsTerminal> FindGraphicsTerminal(const std::string& option) {
  for (const auto& [handle, name] : {std::pair{STDOUT_FILENO, "output"}, {STDIN_FILENO, "input"}}) {
    if (isatty(handle) == 1) continue;
    return Error::Usage(option, "a terminal on standard input and output",
                        std::string("another kind of file on standard ") + name);
  }
  const TerminalAnswers answers = AskTerminal();
  if (!answers.kitty && !answers.sixel) {
    return Error::Usage(option, "a terminal with kitty or sixel graphics", Describe(answers));
  }
  GraphicsTerminal terminal;
  terminal.kitty = answers.kitty;
  FindSize(answers, &terminal);
  // Reports a build without libsixel before the picture is computed.
  const Error error = terminal.kitty ? Error() : EncodeSixel(option, Image(1, 1)).error();
  if (error) return error;
  return terminal;
}

Error ShowOnTerminal(const std::string& option, const GraphicsTerminal& terminal,
                     const Image& image) {
  const Result<std::string> text =
      terminal.kitty ? EncodeKitty(option, image) : EncodeSixel(option, image);
  return text ? WriteText("-", *text + "\n") : text.error();
}

}  // namespace starfocus
