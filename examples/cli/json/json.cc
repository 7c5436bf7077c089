// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/json/json.h"

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
  return value_->json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace starfocus
