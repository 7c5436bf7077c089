// SPDX-License-Identifier: Apache-2.0
// starfocus-lab analyze: writes the tables and drawings of the paper's filter analysis.

#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "examples/command_line/options.h"
#include "examples/command_line/program.h"
#include "examples/lab/analysis/figures.h"
#include "examples/lab/commands.h"
#include "platform/file.h"
#include "platform/folder.h"

extern char** environ;

namespace starfocus {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using TempFile = std::unique_ptr<std::FILE, CloseFile>;

// Runs gnuplot with the given files as stdin, stdout and stderr. Returns the exit code, or -1 if
// gnuplot cannot be run.
int Spawn(std::FILE* in, std::FILE* out, std::FILE* err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(in), 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(out), 1);
  posix_spawn_file_actions_adddup2(&actions, fileno(err), 2);
  char name[] = "gnuplot";
  char* const arguments[] = {name, nullptr};
  pid_t child = 0;
  const int failure = posix_spawnp(&child, name, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return -1;
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

Bytes ReadAll(std::FILE* file) {
  Bytes bytes;
  std::rewind(file);
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) {
    bytes.push_back(static_cast<uint8_t>(c));
  }
  return bytes;
}

// Runs gnuplot on `script` and returns the output. `script` must contain all data and write to
// stdout. RunGnuplot uses no shell and no file names. Error messages start with `what`.
Result<Bytes> RunGnuplot(const std::string& what, const std::string& script) {
  const TempFile in(std::tmpfile()), out(std::tmpfile()), err(std::tmpfile());
  if (!in || !out || !err) return Expected(what, "room for temporary files", "none");
  const bool written = std::fwrite(script.data(), 1, script.size(), in.get()) == script.size();
  std::rewind(in.get());
  if (!written) return Expected(what, "room for temporary files", "none");
  const int code = Spawn(in.get(), out.get(), err.get());
  if (code != 0) {
    const Bytes words = ReadAll(err.get());
    return Expected(what, "gnuplot to draw the figure",
                    code < 0 ? "no such program" : std::string(words.begin(), words.end()));
  }
  return ReadAll(out.get());
}

// Returns true if gnuplot is installed and can write SVG.
bool HasGnuplot() { return bool(RunGnuplot("gnuplot", "set terminal svg\n")); }

}  // namespace

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

namespace {

// starfocus-lab analyze: repeats the paper's filter analysis, and compares the engine's PSFs with
// this analysis.

namespace fs = std::filesystem;

struct AnalyzeOptions {
  std::string folder;
  int max_blur = 40;
};

Error Write(const fs::path& folder, const Figure& figure, bool draw) {
  for (const Table& table : figure.tables) {
    const std::string path = (folder / (table.name() + ".csv")).string();
    if (Error error = WriteText(path, table.Csv())) return error;
  }
  if (!draw || figure.name.empty()) return {};
  const std::string name = figure.name + ".svg";
  return WriteFile((folder / name).string(), RunGnuplot(name, figure.Script()));
}

Error Run(const AnalyzeOptions& options) {
  OutputFolder made;
  if (!options.folder.empty()) {
    if (Error error = CheckFolderOutput({"--output", options.folder})) return error;
    if (Error error = made.Create(options.folder)) return error;
  }
  constexpr int kEngineBlur = 40;  // larger radii take hours
  std::vector<Figure> figures = {AnalyseTableOne(), AnalyseViewNumber(),
                                 AnalyseSubapertures(options.max_blur)};
  const Result<Figure> engine = AnalyseEngine(std::min(options.max_blur, kEngineBlur));
  if (!engine || options.folder.empty()) return engine.error();
  figures.push_back(*engine);
  figures.push_back(DrawViewPsfs());
  figures.push_back(DrawViewResponses());
  figures.push_back(DrawSubsampledBlurs());
  const bool draw = HasGnuplot();
  for (const Figure& figure : figures) {
    if (Error error = Write(options.folder, figure, draw)) return error;
  }
  std::printf("%s in %s\n", draw ? "CSV files and SVG drawings" : "CSV files",
              options.folder.c_str());
  if (!draw) std::printf("no drawings: gnuplot is missing (Debian: apt-get install gnuplot-nox)\n");
  return {};
}

}  // namespace

Command AnalyzeCommand() {
  const auto options = std::make_shared<AnalyzeOptions>();
  return {
      "analyze",
      "Compute the paper's filter analysis (section III) from its definitions: Table I, Fig. 6, "
      "rules (9) and (12), the rule for subapertures, and the PSFs of the running engine",
      {
          {"-o,--output", "DIR",
           "Folder for CSV files and, if gnuplot is installed, SVG drawings of Figs. 4, "
           "5, 6 and 8; default: print figures only",
           &options->folder},
          {"--max-blur", "N",
           "Largest blur radius in pixels, 1 to 128, of the rule for subapertures and, up "
           "to 40, of the engine's PSFs; 128 takes minutes",
           Whole(1, 128, &options->max_blur), Use::kDefault},
      },
      [options] { return Run(*options); },
      {"starfocus-lab analyze", "starfocus-lab analyze -o analysis --max-blur 20"},
      "",
      {},
      [options] { return !options->folder.empty(); }};
}

}  // namespace starfocus
