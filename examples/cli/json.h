// SPDX-License-Identifier: Apache-2.0
// Writes JSON values, and reads objects of numbers. Only the source file includes nlohmann-json,
// which takes seconds to compile.
#ifndef STARFOCUS_EXAMPLES_CLI_JSON_H_
#define STARFOCUS_EXAMPLES_CLI_JSON_H_

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

namespace starfocus {

class Json {
 public:
  // Creates a null value. Set turns the value into an object, and Add turns the value into an
  // array.
  Json();
  // NOLINTBEGIN: members and elements are written as plain values
  Json(std::nullptr_t);
  Json(double value);
  Json(int value);
  Json(int64_t value);
  Json(uint32_t value);
  Json(uint64_t value);
  Json(const char* value);
  Json(const std::string& value);
  // NOLINTEND
  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(const Json& other) = delete;
  Json& operator=(Json&& other) noexcept;
  ~Json();

  static Json Array(std::initializer_list<Json> elements = {});

  // Adds a member to an object after the existing members.
  void Set(const std::string& name, Json value);
  // Adds an element to an array.
  void Add(Json value);

  // Formats the value on one line, or indented by `indent` spaces. Bytes that are not UTF-8 are
  // replaced.
  std::string Text(int indent = -1) const;

 private:
  struct Value;
  std::unique_ptr<Value> value_;
};

// A member of an object that was read.
struct JsonMember {
  std::string name;
  std::string text;       // The value as JSON in ASCII.
  bool is_whole = false;  // True if the value is an integer >= 0.
  uint64_t whole = 0;
};

struct JsonObject {
  bool is_json = false;   // True if the text is valid JSON.
  bool is_there = false;  // True if the text contains the object.
  std::vector<JsonMember> members;
};

// Reads the object that is the member `name` of the top-level object of a JSON text.
JsonObject ReadJsonObject(const std::vector<uint8_t>& text, const std::string& name);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_JSON_H_
