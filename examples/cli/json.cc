// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/json.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace starfocus {

struct Json::Value {
  nlohmann::ordered_json json;
};

Json::Json() : Json(nullptr) {}
Json::Json(std::nullptr_t) : value_(new Value{nullptr}) {}
Json::Json(double value) : value_(new Value{value}) {}
Json::Json(int value) : value_(new Value{value}) {}
Json::Json(int64_t value) : value_(new Value{value}) {}
Json::Json(uint32_t value) : value_(new Value{value}) {}
Json::Json(uint64_t value) : value_(new Value{value}) {}
Json::Json(const char* value) : value_(new Value{value}) {}
Json::Json(const std::string& value) : value_(new Value{value}) {}
Json::Json(const Json& other) : value_(new Value(*other.value_)) {}
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(Json&& other) noexcept = default;
Json::~Json() = default;

Json Json::Array(std::initializer_list<Json> elements) {
  Json array;
  array.value_->json = nlohmann::ordered_json::array();
  for (const Json& element : elements) array.Add(element);
  return array;
}

void Json::Set(const std::string& name, Json value) {
  value_->json[name] = std::move(value.value_->json);
}

void Json::Add(Json value) { value_->json.push_back(std::move(value.value_->json)); }

std::string Json::Text(int indent) const {
  const std::string text =
      value_->json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string safe;
  for (size_t i = 0; i < text.size(); ++i) {
    // JSON allows U+007F to U+009F in strings, but terminals interpret these characters.
    const bool pair = text[i] == '\xc2' && static_cast<unsigned char>(text[i + 1]) < 0xa0;
    if (!pair && text[i] != '\x7f') {
      safe += text[i];
      continue;
    }
    const auto code = static_cast<unsigned char>(text[pair ? ++i : i]);
    constexpr char kDigits[] = "0123456789abcdef";
    safe += std::string("\\u00") + kDigits[code / 16] + kDigits[code % 16];
  }
  return safe;
}

JsonObject ReadJsonObject(const std::vector<uint8_t>& text, const std::string& name) {
  using nlohmann::ordered_json;
  JsonObject object;
  const ordered_json json = ordered_json::parse(text.begin(), text.end(), nullptr, false);
  object.is_json = !json.is_discarded();
  const auto found = json.is_object() ? json.find(name) : json.end();
  object.is_there = found != json.end() && found->is_object();
  if (!object.is_there) return object;
  for (const auto& [key, value] : found->items()) {
    JsonMember member = {key, value.dump(-1, ' ', true), value.is_number_unsigned()};
    if (member.is_whole) member.whole = value.get<uint64_t>();
    object.members.push_back(member);
  }
  return object;
}

}  // namespace starfocus
