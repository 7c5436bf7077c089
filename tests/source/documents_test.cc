// SPDX-License-Identifier: Apache-2.0
// Checks that linked files, cited files, identifiers, commands and options in the documents exist.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "starfocus/version.h"
#include "tests/source/tree.h"

namespace documents_test {
namespace {

namespace fs = std::filesystem;

using tree::kRoot;
using tree::Read;

std::vector<fs::path> Documents() {
  std::vector<fs::path> found = {kRoot / "README.md", kRoot / "CONTRIBUTING.md",
                                 kRoot / "CHANGELOG.md", kRoot / "SECURITY.md",
                                 kRoot / "toolchains/site/gallery.md"};
  for (const fs::directory_entry& entry : fs::directory_iterator(kRoot / "docs")) {
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  }
  return found;
}

// Returns the text of a document without its code blocks.
std::string Prose(const fs::path& path) {
  return std::regex_replace(Read(path), std::regex("```[^`]*```"), "");
}

// Returns all strings in `text` that match the first group of `pattern`.
std::set<std::string> Find(const std::string& text, const std::string& pattern) {
  std::set<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at) {
    found.insert((*at)[1]);
  }
  return found;
}

// Returns the code blocks of a document.
std::string Code(const fs::path& path) {
  std::string code;
  for (const std::string& block : Find(Read(path), "(```[^`]*```)")) code += block;
  return code;
}

// Returns the text of all files with one of the extensions, in the folders and their subfolders.
std::string ReadAll(const std::vector<std::string>& folders,
                    const std::set<std::string>& extensions) {
  std::string text;
  for (const fs::path& path : tree::Files(folders, extensions)) {
    if (path.filename() != "documents_test.cc") text += Read(path);
  }
  return text;
}

// Returns all identifiers in the sources of the project. Regular expressions would take seconds.
std::set<std::string> WordsOfCode() {
  std::set<std::string> words;
  std::string word;
  for (const char c : ReadAll({"lib", "simd", "platform", "examples", "tests"},
                              {".h", ".cc", ".hpp", ".c", ".py", ".java", ".js", ".mjs", ".ts",
                               ".txt", ".cmake"}) +
                          Read(kRoot / "CMakeLists.txt") + "\n") {
    const bool is_digit = c >= '0' && c <= '9';
    if ((c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' ||
        (is_digit && !word.empty())) {
      word += c;
    } else if (!word.empty()) {
      words.insert(word);
      word.clear();
    }
  }
  return words;
}

TEST_CASE("documents: README.md has at most 110 lines") {
  const std::string text = Read(kRoot / "README.md");
  CHECK(std::count(text.begin(), text.end(), '\n') <= 110);
  CHECK(text.size() > 1000);
}

TEST_CASE("documents: docs has at most 9 pages with at most 36,000 words") {
  size_t pages = 0, words = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(kRoot / "docs")) {
    if (entry.path().extension() != ".md") continue;
    std::istringstream text(Read(entry.path()));
    words += static_cast<size_t>(std::distance(std::istream_iterator<std::string>(text), {}));
    ++pages;
  }
  CHECK(pages <= 9);
  CHECK(pages > 1);
  CHECK(words <= 36000);
}

TEST_CASE("documents: pages begin with what readers type or look for, not with their purpose") {
  for (const fs::path& document : Documents()) {
    const std::string text = Read(document);
    const bool is_about_itself = text.find("page is for") != std::string::npos ||
                                 text.find("After reading this page") != std::string::npos;
    CHECK_MESSAGE(!is_about_itself, document.filename().string());
  }
}

TEST_CASE("documents: files that name the version of the library name the right one") {
  const std::string version = STARFOCUS_VERSION_STRING;
  const std::string abi = std::to_string(STARFOCUS_ABI);
  const fs::path packaging = kRoot / "toolchains" / "packaging";
  const auto only = [](const fs::path& file, const std::string& pattern) {
    const std::set<std::string> found = Find(Read(file), pattern);
    return found.size() == 1 ? *found.begin() : "none, or several";
  };
  CHECK(only(kRoot / "CITATION.cff", "\nversion: (.+)\n") == version);
  CHECK(Find(Read(kRoot / "CHANGELOG.md"), "\n## \\[([^\\]]+)\\]").count(version) == 1);
  CHECK(only(kRoot / "platform/web/package/package.json", "\"version\": \"(.+)\"") == version);
  // The newest version of the Debian packages is on the first line. The name of the library's
  // package ends with the version of the ABI.
  const std::string changelog = Read(packaging / "debian/changelog");
  CHECK(changelog.substr(0, changelog.find(')') + 1) == "starfocus (" + version + ")");
  CHECK(only(packaging / "debian/control", "\nPackage: libstarfocus([0-9]+)\n") == abi);
  CHECK(fs::exists(packaging / "debian" / ("libstarfocus" + abi + ".symbols")));
}

TEST_CASE("documents: the targets of all links in documents exist") {
  size_t links = 0;
  for (const fs::path& document : Documents()) {
    for (const std::string& link : Find(Read(document), "\\]\\(([^)#: ]+)[^): ]*\\)")) {
      CHECK_MESSAGE(fs::exists(document.parent_path() / link), document.filename().string()
                                                                   << " links to " << link);
      ++links;
    }
  }
  CHECK(links > 20);
}

TEST_CASE("documents: all files that documents name exist") {
  // The pattern matches names such as `lib/base/fixed.h`, but not names with * or <name>.
  size_t files = 0;
  for (const fs::path& document : Documents()) {
    const std::string pattern =
        "`((?:lib|simd|platform|examples|tests|toolchains|docs)/[^`*<> ]*)`";
    for (const std::string& file : Find(Prose(document), pattern)) {
      CHECK_MESSAGE(fs::exists(kRoot / file), document.filename().string()
                                                  << " names a file that does not exist: " << file);
      ++files;
    }
  }
  CHECK(files > 20);
}

TEST_CASE("documents: all identifiers that documents name exist in the code") {
  const std::set<std::string> words = WordsOfCode();
  size_t names = 0;
  for (const fs::path& document : Documents()) {
    std::set<std::string> found =
        Find(Prose(document), "`((?:k[A-Z]|[A-Z][a-z]+[A-Z])[A-Za-z_0-9]*)[^`]*`");
    found.merge(Find(Read(document), "\\b((?:starfocus|STARFOCUS)_[A-Za-z_0-9]+)"));
    for (const std::string& name : found) {
      if (name.back() == '_') continue;  // a prefix of names, such as starfocus_stream_*
      CHECK_MESSAGE(words.count(name) == 1, document.filename().string()
                                                << " names an unknown identifier: " << name);
      ++names;
    }
  }
  CHECK(names > 80);
}

TEST_CASE("documents: all commands and options that documents name exist") {
  const std::string sources = ReadAll({"examples", "tests"}, {".cc", ".h"});
  const std::string scripts = Read(kRoot / "do") + ReadAll({"toolchains"}, {"", ".sh", ".cmake"});
  const std::set<std::string> of_others = {
      "--preset", "--build",   "--install",      "--prefix",  "--target",        "--libs",
      "--cflags", "--static",  "--sshloginfile", "--workdir", "--cpus-per-task", "--mem",
      "--time",   "--requeue", "--array",        "--state",   "--format",        "--scheduler"};
  for (const fs::path& document : Documents()) {
    const std::string text = Read(document);
    for (const std::string& command : Find(Code(document), "\nstarfocus ([a-z]+) ")) {
      CHECK_MESSAGE(sources.find("\"" + command + "\"") != std::string::npos,
                    document.filename().string() << " calls starfocus " << command);
    }
    for (const std::string& option : Find(text, "[ `(](--[a-z][a-z-]*)")) {
      const bool known = of_others.count(option) == 1 ||
                         sources.find(option) != std::string::npos ||
                         scripts.find(option) != std::string::npos;
      CHECK_MESSAGE(known, document.filename().string() << " names an unknown option: " << option);
    }
    for (const std::string script :
         {"./do", "toolchains/board/board", "toolchains/site/web", "tests/bindings/run.sh"}) {
      const std::string help = Read(kRoot / script);
      for (const std::string& command : Find(text, script + " ([a-z][a-z0-9-]*)")) {
        CHECK_MESSAGE(help.find("\n#   " + command + " ") != std::string::npos,
                      document.filename().string()
                          << " names an unknown command: " << script << " " << command);
      }
    }
  }
}

}  // namespace
}  // namespace documents_test
