// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/analyze/table.h"

#include <cstdio>

namespace starfocus {

Table& Table::Add(double value, const char* format) {
  char text[40];
  std::snprintf(text, sizeof(text), format, value);
  rows_.back().push_back(text);
  return *this;
}

Table& Table::Add(const std::string& text) {
  rows_.back().push_back(text);
  return *this;
}

std::string Table::Text(const char* separator, const char* quote) const {
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (const std::string& cell : cells) {
      const bool quoted = cell.find_first_of(" ,") != std::string::npos || cell.empty();
      const std::string mark = quoted ? quote : "";
      text += (text.empty() ? "" : separator) + mark + cell + mark;
    }
    return text + "\n";
  };
  std::string text = line(columns_);
  for (const auto& row : rows_) text += line(row);
  return text;
}

std::string Table::Csv() const { return Text(",", "\""); }

std::string Table::DataBlock() const {
  return "$" + name_ + " << END_OF_DATA\n" + Text(" ", "\"") + "END_OF_DATA\n";
}

std::string Figure::Script() const {
  std::string script =
      "set terminal svg size " + std::to_string(width) + "," + std::to_string(height) +
      " noenhanced font 'sans-serif,13' background '#ffffff'\n"
      "set encoding utf8\nset key noautotitle samplen 2\n"
      "set grid lc rgb '#dddddd' lt 1\nset border lc rgb '#444444'\n"
      "set linetype 1 lc rgb '#1f6fb4' lw 2\nset linetype 2 lc rgb '#d9541e' lw 2\n"
      "set linetype 3 lc rgb '#2a9d4a' lw 2\nset linetype 4 lc rgb '#8a4fb0' lw 2\n"
      "set linetype 5 lc rgb '#b8860b' lw 2\nset linetype 6 lc rgb '#555555' lw 2\n";
  for (const Table& table : tables) script += table.DataBlock();
  return script + commands;
}

}  // namespace starfocus
