// SPDX-License-Identifier: Apache-2.0
// Checks that functions have at most six parameters. Functions that require more values take a
// structure instead.
#include <doctest/doctest.h>

#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/rooms/tree.h"

namespace parameters_test {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostParameters = 8;

struct Token {
  std::string text;
  bool after_space;
};

bool IsIdentifier(const Token& token) {
  static const std::set<std::string> kOperators = {"new", "delete", "sizeof", "return", "operator"};
  const auto first = static_cast<unsigned char>(token.text[0]);
  return (std::isalpha(first) != 0 || first == '_') && kOperators.count(token.text) == 0;
}

// Splits C, C++ or Java code into tokens, which are words and single characters. Omits comments,
// string literals and preprocessor lines.
std::vector<Token> Tokens(std::string code) {
  static const std::regex kComment("//[^\n]*|/\\*[^*]*\\*+([^/*][^*]*\\*+)*/");
  static const std::regex kMacro("(^|\n)[ \t]*#([^\n]*\\\\\n)*[^\n]*");
  static const std::regex kText("\"(\\\\.|[^\"\\\\\n])*\"|'(\\\\.|[^'\\\\\n])*'");
  for (const std::regex* dropped : {&kComment, &kMacro, &kText}) {
    code = std::regex_replace(code, *dropped, " 0 ");
  }
  std::vector<Token> tokens;
  bool space = false, word = false;
  for (const char letter : code) {
    const auto c = static_cast<unsigned char>(letter);
    if (std::isspace(c) != 0) {
      space = true;
      continue;
    }
    const bool in_word = std::isalnum(c) != 0 || c == '_';
    if (in_word && word && !space) {
      tokens.back().text += letter;
    } else {
      tokens.push_back({std::string(1, letter), space});
    }
    word = in_word;
    space = false;
  }
  return tokens;
}

// Returns true if the tokens declare a parameter: a type and, in most cases, a name. In the layout
// of clang-format, `*` and `&` follow a type without a space, and operators follow with a space.
bool IsDeclaration(const std::vector<Token>& tokens) {
  static const std::regex kPlain("int|float|double|bool|char|.*_t");
  if (tokens.size() == 1) return std::regex_match(tokens[0].text, kPlain);
  for (size_t k = 1; k < tokens.size(); ++k) {
    const Token &before = tokens[k - 1], &here = tokens[k];
    const bool member = k > 1 && before.text == ">" && tokens[k - 2].text == "-";
    const bool ends_type = IsIdentifier(before) || (before.text == ">" && !member);
    if (ends_type && IsIdentifier(here)) return true;
    const bool refers = here.text == "*" || here.text == "&";
    if ((ends_type || before.text == "*") && refers && !here.after_space) return true;
  }
  return false;
}

// Returns the parameters or arguments of the list whose opening parenthesis is token `open`. The
// contents of nested brackets are omitted.
std::vector<std::vector<Token>> ListAt(const std::vector<Token>& tokens, size_t open) {
  std::vector<std::vector<Token>> list(1);
  int brackets = 0, angles = 0;
  for (size_t k = open + 1; k < tokens.size(); ++k) {
    const std::string& text = tokens[k].text;
    if (brackets == 0 && text == ")") break;
    if (text == "(" || text == "[" || text == "{") ++brackets;
    if (text == ")" || text == "]" || text == "}") --brackets;
    if (brackets != 0) continue;
    if (text == "<" && !tokens[k].after_space && IsIdentifier(tokens[k - 1])) ++angles;
    if (text == "," && angles == 0) {
      list.emplace_back();
    } else if (angles == 0 || (text == ">" && --angles == 0)) {
      list.back().push_back(tokens[k]);
    }
  }
  return list;
}

// Returns the names of functions that are declared or defined with more than `limit` parameters.
std::vector<std::string> FindWide(const std::string& code, size_t limit) {
  const std::vector<Token> tokens = Tokens(code);
  std::vector<std::string> found;
  for (size_t k = 1; k < tokens.size(); ++k) {
    if (tokens[k].text != "(") continue;
    const std::vector<std::vector<Token>> list = ListAt(tokens, k);
    if (list.size() > limit && IsDeclaration(list[0])) {
      found.push_back(tokens[k - 1].text);
    }
  }
  return found;
}

}  // namespace

TEST_CASE("parameters: no function has more than eight parameters") {
  for (const fs::path& path :
       tree::Files({"lib", "simd", "platform", "examples"}, {".h", ".hpp", ".c", ".cc", ".java"})) {
    for (const std::string& name : FindWide(tree::Read(path), kMostParameters)) {
      FAIL_CHECK(path.string(), ": ", name);
    }
  }
}

TEST_CASE("parameters: FindWide counts parameters of declarations and ignores calls") {
  const auto count = [](const std::string& code) { return FindWide(code, 2).size(); };
  CHECK(count("int Sum(int a, int b, int c);") == 1);
  CHECK(count("int Sum(int a, int b);") == 0);
  CHECK(count("int Sum(int, int, int);") == 1);
  CHECK(count("Sum::Sum(const T* a, T& b, std::array<int, 3> c) : a_(a) {}") == 1);
  CHECK(count("void Sum(T* a, std::map<int, std::set<int>> b);") == 0);
  CHECK(count("template <class T> void Sum(const Map<T, 3>& a, T* b, T c) {") == 1);
  CHECK(count("void (*sum)(void* self, int (*of)(int, int), int c);") == 1);
  CHECK(count("const auto sum = [&](int a, int b, int c) { return a; };") == 1);
  CHECK(count("return Sum(a * b, c & d, e);") == 0);
  CHECK(count("return Sum(a->b, c.d, -e);") == 0);
  CHECK(count("Sum(new T(a), b, c); Sum(sizeof(a), b, c); Sum({1, 2}, b, c);") == 0);
  CHECK(count("Sum([&](int a, int b) { return a; }, b, c);") == 0);
  CHECK(count("// int Sum(int a, int b, int c);\n#define SUM(int a, int b, int c)\n") == 0);
}

}  // namespace parameters_test
