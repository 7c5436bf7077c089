// SPDX-License-Identifier: Apache-2.0
#include "platform/console.h"

#include <locale.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <wchar.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "platform/text.h"

namespace starfocus {
namespace {

constexpr char kErase[] = "\r\x1b[K";
constexpr char kEllipsis[] = "...";  // in ASCII, because the terminal may not use UTF-8
constexpr int kEllipsisColumns = 3;
constexpr int kUsualColumns = 80;

std::mutex mutex;  // protects the variables below, stdout and stderr
bool is_shown = false;
std::string shown_label, shown_state;

// Width of the terminal of stderr. Users resize terminals, so the width is not stored.
int TerminalColumns() {
  winsize size = {};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  const char* const stated = std::getenv("COLUMNS");
  const int columns = stated == nullptr ? 0 : std::atoi(stated);
  return columns > 0 ? columns : kUsualColumns;
}

// Interprets characters as UTF-8 in the calling thread until the object is destroyed. The programs
// do not set a locale, because a locale would change how numbers are read and printed.
class Utf8 {
 public:
  Utf8() {
    static const locale_t locale = newlocale(LC_CTYPE_MASK, "C.UTF-8", locale_t());
    if (locale != locale_t()) before_ = uselocale(locale);
  }
  ~Utf8() {
    if (before_ != locale_t()) uselocale(before_);
  }
  Utf8(const Utf8&) = delete;
  Utf8& operator=(const Utf8&) = delete;

 private:
  locale_t before_ = locale_t();
};

struct Character {
  size_t bytes;
  int columns;
};

// Returns the first character of a text. Without a UTF-8 locale, each byte is one column.
Character FirstOf(const char* text, size_t bytes) {
  wchar_t wide = 0;
  mbstate_t state = {};
  const size_t used = mbrtowc(&wide, text, bytes, &state);
  if (used == 0 || used > bytes) return {1, 1};  // an invalid sequence
  return {used, std::max(0, wcwidth(wide))};
}

// Writes to stderr. A line and the progress line around it are one write, so that lines of child
// processes do not come between them.
void Write(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

std::string CurrentProgress() {
  // The last column stays empty, because some terminals begin a new line after it.
  return ProgressText(shown_label, shown_state, TerminalColumns() - 1);
}

}  // namespace

void TellLine(const std::string& line) {
  const std::lock_guard<std::mutex> lock(mutex);
  Write((is_shown ? kErase : "") + Printable(line) + "\n" + (is_shown ? CurrentProgress() : ""));
}

void PrintLine(const std::string& line) {
  const std::lock_guard<std::mutex> lock(mutex);
  const bool above = is_shown && isatty(STDOUT_FILENO) == 1;
  if (above) Write(kErase);
  std::printf("%s\n", Printable(line).c_str());
  if (!above) return;
  std::fflush(stdout);
  Write(CurrentProgress());
}

bool CanShowProgress() {
  const char* const name = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && (name == nullptr || std::strcmp(name, "dumb") != 0);
}

void ShowProgress(const std::string& label, const std::string& state) {
  const std::lock_guard<std::mutex> lock(mutex);
  is_shown = true;
  shown_label = Printable(label);
  shown_state = state;
  Write(kErase + CurrentProgress());
}

void EraseProgress() {
  const std::lock_guard<std::mutex> lock(mutex);
  if (is_shown) Write(kErase);
  is_shown = false;
}

std::string ProgressText(const std::string& label, const std::string& state, int columns) {
  const int rest = columns - static_cast<int>(state.size());
  return FitColumns(FitColumns(label, std::max(0, rest)) + state, columns);
}

std::string FitColumns(const std::string& text, int columns) {
  const Utf8 utf8;
  int width = 0;
  size_t cut = 0;  // bytes of the beginning that leaves space for the ellipsis
  for (size_t at = 0; at < text.size();) {
    const Character next = FirstOf(text.data() + at, text.size() - at);
    // Combining characters stay with the character before them. Without a UTF-8 locale, so do the
    // continuation bytes of a character.
    const bool begins = next.columns > 0 && (static_cast<unsigned char>(text[at]) & 0xc0) != 0x80;
    if (begins && width <= columns - kEllipsisColumns) cut = at;
    width += next.columns;
    if (width > columns) {
      const auto dots = static_cast<size_t>(std::clamp(columns, 0, kEllipsisColumns));
      return text.substr(0, cut) + std::string(kEllipsis, dots);
    }
    at += next.bytes;
  }
  return text;
}

}  // namespace starfocus
