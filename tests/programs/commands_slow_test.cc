// SPDX-License-Identifier: Apache-2.0
// Runs the commands of the documents. A command is a line of a code block without a language, a
// script that is a whole code block, or inline code that calls a program with arguments.
// unrun_commands.txt lists the commands that are not run. The commands of each code block run in a
// copy of a folder that contains small inputs with the names that the documents use.
#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/programs/session.h"
#include "tests/support/photo_files.h"

namespace commands_slow_test {
namespace {

namespace fs = std::filesystem;

using starfocus::Outcome;
using starfocus::TempFolder;
using Commands = std::vector<std::string>;

constexpr std::array<const char*, 9> kDocuments = {
    "README.md",     "CONTRIBUTING.md",  "docs/program.md", "docs/formats.md", "docs/developing.md",
    "docs/depth.md", "docs/bindings.md", "docs/boards.md",  "docs/library.md"};

std::string ReadSource(const std::string& path) {
  return starfocus::Text(STARFOCUS_SOURCE_DIR "/" + path);
}

// Returns the commands of a code block, which begins with the name of its language.
Commands CommandsOfBlock(const std::string& block) {
  if (block.empty() || block[0] != '\n') return {};
  if (block.rfind("\n#!", 0) == 0) return {block.substr(1)};
  Commands commands;
  std::istringstream lines(block);
  bool continued = false;
  for (std::string line; std::getline(lines, line);) {
    const bool continues = !line.empty() && line.back() == '\\';
    if (continued) {
      commands.back() += "\n" + line;
    } else if (!line.empty() && line[0] != '#') {
      commands.push_back(line);
    }
    continued = continues;
  }
  return commands;
}

// Returns the command of inline code, or nothing if the code calls no program with arguments.
Commands CommandsOfSpan(std::string span) {
  std::replace(span.begin(), span.end(), '\n', ' ');
  std::istringstream words(span);
  std::string program, command, argument;
  words >> program >> command >> argument;
  const std::set<std::string> programs = {"starfocus", "starfocus-lab", "./starfocus",
                                          "./starfocus-lab"};
  if (programs.count(program) == 1 ? argument.empty() : program != "./do" || command.empty()) {
    return {};
  }
  return {span};
}

// Returns the commands of a document, one list for each code block and each inline code.
std::vector<Commands> CommandsOf(const std::string& text) {
  std::vector<Commands> found;
  for (size_t at = text.find('`'); at != std::string::npos; at = text.find('`', at)) {
    const bool is_block = text.compare(at, 3, "```") == 0;
    const std::string fence = is_block ? "```" : "`";
    const size_t begin = at + fence.size(), end = text.find(fence, begin);
    REQUIRE(end != std::string::npos);
    const std::string code = text.substr(begin, end - begin);
    found.push_back(is_block ? CommandsOfBlock(code) : CommandsOfSpan(code));
    at = end + fence.size();
  }
  return found;
}

// Commands that are not run: the beginning of a command, the reason, and whether a document
// contains such a command.
struct Unrun {
  std::string beginning, reason;
  bool is_used = false;
};

std::vector<Unrun> ReadUnrun() {
  std::vector<Unrun> unrun;
  std::istringstream lines(ReadSource("tests/programs/unrun_commands.txt"));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    const size_t arrow = line.find(" -> ");
    REQUIRE_MESSAGE(arrow != std::string::npos, line);
    unrun.push_back({line.substr(0, arrow), line.substr(arrow + 4)});
  }
  return unrun;
}

// Runs a script of bash in the folder, whose programs come first in the search path.
Outcome RunScript(const std::string& folder, const std::string& script) {
  TempFolder logs;
  starfocus::photos::Write(logs.file("script"), script);
  return starfocus::RunLogged("cd '" + folder +
                              "' && PATH=\"$PWD:$PATH\" exec bash -euo pipefail '" +
                              logs.file("script") + "' </dev/null");
}

// Makes inputs with the names that documents use. starfocus-lab renders scenes of 80x60 pixels,
// whatever the size in the command. CMD, python3 and rembg stand for programs that compute depth or
// mattes, and srun for the command of Slurm.
constexpr char kInputs[] = R"(
ln -s "$PROGRAM" starfocus
cat >starfocus-lab <<'SCRIPT'
#!/bin/bash
[ "$1" != scene ] || set -- "${@/#[0-9]*x[0-9]*/80x60}"
case "$* " in 'scene '*' --size '*) ;; 'scene '*) set -- "$@" --size 80x60 ;; esac
exec "$PROGRAM-lab" "$@"
SCRIPT
printf '#!/bin/sh\ncp MAP.png "$2"\n' >CMD
printf '#!/bin/sh\ncp MAP.png "$3"\n' >python3
printf '#!/bin/sh\nfor last; do :; done\ncp MATTE.png "$last"\n' >rembg
printf '#!/bin/sh\nexec "$@"\n' >srun
chmod +x starfocus-lab CMD python3 rembg srun
"$PROGRAM-lab" scene DIR --size 480x432 --views 5
starfocus-lab scene field
starfocus-lab scene lf --views 5
cp -r lf A
cp -r lf B
cp -r lf VIEWS
rm VIEWS/disparity.pfm
mkdir FOLDER out
starfocus refocus DIR --focus 0 --depth-photo -o photo.jpg
cp photo.jpg PHOTO.jpg
cp photo.jpg SRC
cp -r lf photo.jpg FOLDER
cp "$SOURCES/tests/fuzz/corpus/heif/depth.heic" PHOTO.heic
starfocus refocus DIR --strength 0 -o IMG.jpg
starfocus disparity DIR --repair -o MAP.pfm
starfocus refocus lf -o a.png
starfocus refocus lf -o b.png --focus 1
starfocus-lab calibrate --light-field lf --check lf -o timing.json
printf 'photo.jpg\nlf\n' >inputs.txt
mkdir clip in d
cp photo.jpg clip/1.jpg
cp IMG.jpg in/00001.jpg
cp MAP.png d/00001.png
mkdir photos
cp IMG.jpg photos
cp IMG.jpg portrait.jpg
cp MAP.png MATTE.png
cp MAP.png cutout.png
)";

void MakeInputs(const TempFolder& folder) {
  constexpr int kWidth = 120, kHeight = 108;  // a quarter of the size of DIR
  std::vector<uint16_t> millimetres(size_t(kWidth) * kHeight);
  for (size_t i = 0; i < millimetres.size(); ++i)
    millimetres[i] = uint16_t(500 + 20 * (i % kWidth));
  starfocus::photos::Write(folder.file("MM.png"),
                           starfocus::photos::Png16(kWidth, kHeight, millimetres));
  const Outcome made = RunScript(folder.path(), kInputs);
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
}

// Runs the commands of a code block that are not in `unrun`, and returns their number.
int RunBlock(const std::string& document, const Commands& block, const TempFolder& inputs,
             std::vector<Unrun>* unrun) {
  TempFolder folder;
  int count = 0;
  for (const std::string& command : block) {
    const auto listed = std::find_if(unrun->begin(), unrun->end(), [&](const Unrun& one) {
      return command.rfind(one.beginning, 0) == 0;
    });
    if (listed != unrun->end()) {
      listed->is_used = true;
      continue;
    }
    if (count++ == 0) {
      fs::copy(inputs.path(), folder.path(),
               fs::copy_options::recursive | fs::copy_options::copy_symlinks);
    }
    const Outcome outcome = RunScript(folder.path(), command);
    CHECK_MESSAGE(outcome.code == 0, document << ": exit code " << outcome.code << ": " << command
                                              << "\n"
                                              << outcome.err);
  }
  return count;
}

TEST_CASE("commands: all commands of documents run, except commands with a reason") {
  setenv("PROGRAM", STARFOCUS_PROGRAM, 1);
  setenv("SOURCES", STARFOCUS_SOURCE_DIR, 1);
  setenv("SLURM_ARRAY_TASK_ID", "1", 1);
  TempFolder inputs;
  MakeInputs(inputs);
  std::vector<Unrun> unrun = ReadUnrun();
  int count = 0;
  for (const char* document : kDocuments) {
    std::set<Commands> done;
    for (const Commands& block : CommandsOf(ReadSource(document))) {
      if (done.insert(block).second) count += RunBlock(document, block, inputs, &unrun);
    }
  }
  for (const Unrun& one : unrun) {
    std::printf("not run: %s (%s)\n", one.beginning.c_str(), one.reason.c_str());
    CHECK_MESSAGE(one.is_used, "unrun_commands.txt: no document contains " << one.beginning);
  }
  std::printf("commands run: %d\n", count);
  CHECK(count >= 50);
}

TEST_CASE("commands: blocks, scripts and inline code are found") {
  const std::string text =
      "`./do x`, `starfocus refocus`, `starfocus info\nA`\n```\n# c\na \\\n  b # d\n\ne\n```\n"
      "```c\nint a;\n```\n```\n#!/bin/sh\nf\n```\n";
  Commands found;
  for (const Commands& block : CommandsOf(text)) {
    found.insert(found.end(), block.begin(), block.end());
  }
  CHECK(found == Commands{"./do x", "starfocus info A", "a \\\n  b # d", "e", "#!/bin/sh\nf\n"});
}

}  // namespace
}  // namespace commands_slow_test
