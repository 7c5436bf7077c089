// SPDX-License-Identifier: Apache-2.0
// Fields of Java objects that stand for those of C structures, by tables of their names.
#ifndef STARFOCUS_PLATFORM_JAVA_FIELDS_H_
#define STARFOCUS_PLATFORM_JAVA_FIELDS_H_

#include <jni.h>

#include <cstddef>
#include <cstdint>

namespace starfocus {

// What a field is in C and in Java.
enum class FieldType { kInt32, kFloat, kDouble };

struct Field {
  const char* name;  // in Java
  FieldType type;
  size_t offset;  // in the C structure
};

// Copies the fields of `count` entries of a table from the object into the structure, or back.
// False when the object has not got one of them: an exception is pending then.
bool ReadFields(JNIEnv* env, jobject object, const Field* fields, size_t count, void* structure);
bool WriteFields(JNIEnv* env, const void* structure, const Field* fields, size_t count,
                 jobject object);

// One field of an object; 0 or null with an exception pending when it has no such one.
int32_t ReadInt(JNIEnv* env, jobject object, const char* name);
jobject ReadObject(JNIEnv* env, jobject object, const char* name, const char* signature);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_JAVA_FIELDS_H_
