// SPDX-License-Identifier: Apache-2.0
// Copies fields between Java objects and C structures. Tables list the name, type and offset of
// each field to copy. Used by refocuser.cc and pictures.cc.
#ifndef STARFOCUS_PLATFORM_JAVA_FIELDS_H_
#define STARFOCUS_PLATFORM_JAVA_FIELDS_H_

#include <jni.h>

#include <cstddef>
#include <cstdint>

namespace starfocus {

// Type of a field in C (int32_t, float, double) and in Java (int, float, double).
enum class FieldType { kInt32, kFloat, kDouble };

struct Field {
  const char* name;  // name in Java
  FieldType type;
  size_t offset;  // offset of the field in the C structure, in bytes
};

// ReadFields copies the fields of a table with `count` entries from the object to the structure.
// WriteFields copies the fields from the structure to the object. Both functions return false, with
// an exception pending, if the object lacks a field.
bool ReadFields(JNIEnv* env, jobject object, const Field* fields, size_t count, void* structure);
bool WriteFields(JNIEnv* env, const void* structure, const Field* fields, size_t count,
                 jobject object);

// Return the value of a field of an object. If the object lacks the field, return 0 or null with an
// exception pending.
int32_t ReadInt(JNIEnv* env, jobject object, const char* name);
jobject ReadObject(JNIEnv* env, jobject object, const char* name, const char* signature);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_JAVA_FIELDS_H_
