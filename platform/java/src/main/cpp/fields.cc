// SPDX-License-Identifier: Apache-2.0
#include "platform/java/src/main/cpp/fields.h"

#include <cstring>

#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// A number of a structure. `offset` is -1 if the structure has no such number.
struct Number {
  ptrdiff_t offset;
  bool is_double;  // double in C and Java; otherwise int32_t and int
};

// Finds a number by its name in C, where "_" stands before the names of fields of nested
// structures.
Number FindNumber(const char* structure, const char* name) {
  const starfocus_field* field = nullptr;
  int32_t count = 0;
  starfocus_fields(structure, &field, &count);
  for (const starfocus_field* const end = field + count; field != end; ++field) {
    const size_t length = std::strlen(field->name);
    if (std::strncmp(field->name, name, length) != 0) continue;
    if (name[length] == 0) {
      const bool is_double = field->type == STARFOCUS_FIELD_DOUBLE;
      const bool is_number = is_double || field->type == STARFOCUS_FIELD_INT32;
      return {is_number ? ptrdiff_t(field->offset) : -1, is_double};
    }
    if (name[length] != '_' || field->type != STARFOCUS_FIELD_STRUCTURE) continue;
    Number inner = FindNumber(field->structure, name + length + 1);
    if (inner.offset >= 0) inner.offset += field->offset;
    return inner;
  }
  return {-1, false};
}

// Finds a number by its name in Java.
Number FindJavaNumber(const char* structure, const char* name) {
  char text[64] = {};  // the name in C
  for (size_t k = 0; *name != 0 && k + 2 < sizeof text; ++name) {
    const bool is_capital = *name >= 'A' && *name <= 'Z';
    if (is_capital) text[k++] = '_';
    text[k++] = is_capital ? static_cast<char>(*name - 'A' + 'a') : *name;
  }
  return FindNumber(structure, text);
}

jfieldID Find(JNIEnv* env, jobject object, const char* name, const char* signature) {
  const jclass kind = env->GetObjectClass(object);
  const jfieldID id = env->GetFieldID(kind, name, signature);
  env->DeleteLocalRef(kind);
  return id;
}

// Calls copy(number, id) for each field. Returns false, with an exception pending, if the object or
// the structure lacks a field.
template <class Copy>
bool ForFields(JNIEnv* env, jobject object, const Fields& fields, const Copy& copy) {
  for (size_t i = 0; i < fields.count; ++i) {
    const Number number = FindJavaNumber(fields.structure, fields.names[i]);
    const char* const signature = number.offset < 0 ? "" : number.is_double ? "D" : "I";
    const jfieldID id = Find(env, object, fields.names[i], signature);
    if (id == nullptr) return false;
    copy(number, id);
  }
  return true;
}

}  // namespace

bool ReadFields(JNIEnv* env, jobject object, const Fields& fields, void* structure) {
  return ForFields(env, object, fields, [&](const Number& number, jfieldID id) {
    char* const to = static_cast<char*>(structure) + number.offset;
    if (number.is_double) {
      const double value = env->GetDoubleField(object, id);
      std::memcpy(to, &value, sizeof value);
    } else {
      const int32_t value = env->GetIntField(object, id);
      std::memcpy(to, &value, sizeof value);
    }
  });
}

bool WriteFields(JNIEnv* env, const void* structure, const Fields& fields, jobject object) {
  return ForFields(env, object, fields, [&](const Number& number, jfieldID id) {
    const char* const from = static_cast<const char*>(structure) + number.offset;
    if (number.is_double) {
      double value;
      std::memcpy(&value, from, sizeof value);
      env->SetDoubleField(object, id, value);
    } else {
      int32_t value;
      std::memcpy(&value, from, sizeof value);
      env->SetIntField(object, id, value);
    }
  });
}

int32_t ReadInt(JNIEnv* env, jobject object, const char* name) {
  const jfieldID id = Find(env, object, name, "I");
  return id == nullptr ? 0 : env->GetIntField(object, id);
}

jobject ReadObject(JNIEnv* env, jobject object, const char* name, const char* signature) {
  const jfieldID id = Find(env, object, name, signature);
  return id == nullptr ? nullptr : env->GetObjectField(object, id);
}

}  // namespace starfocus
