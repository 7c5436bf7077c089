// SPDX-License-Identifier: Apache-2.0
#include "platform/gnuplot.h"

#include <spawn.h>
#include <sys/wait.h>

#include <cstdio>
#include <memory>

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

}  // namespace

bool HasGnuplot() { return bool(RunGnuplot("gnuplot", "set terminal svg\n")); }

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

}  // namespace starfocus
