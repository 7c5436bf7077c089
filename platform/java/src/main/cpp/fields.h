// SPDX-License-Identifier: Apache-2.0
// Copies fields between Java objects and C structures. The library describes the structures, so
// only the names of the fields to copy are listed. Used by refocuser.cc and pictures.cc.
#ifndef STARFOCUS_PLATFORM_JAVA_FIELDS_H_
#define STARFOCUS_PLATFORM_JAVA_FIELDS_H_

#include <jni.h>

#include <cstddef>
#include <cstdint>

namespace starfocus {

// A C structure and the fields to copy.
struct Fields {
  const char* structure;     // for example "starfocus_params"
  const char* const* names;  // names in Java: "ringInner" is ring_inner, "regionX" is region.x
  size_t count;              // number of names
};

// ReadFields copies the fields from the object to the structure. WriteFields copies the fields from
// the structure to the object. Both functions return false, with an exception pending, if the
// object or the structure lacks a field.
bool ReadFields(JNIEnv* env, jobject object, const Fields& fields, void* structure);
bool WriteFields(JNIEnv* env, const void* structure, const Fields& fields, jobject object);

// Return the value of a field of an object. If the object lacks the field, return 0 or null with an
// exception pending.
int32_t ReadInt(JNIEnv* env, jobject object, const char* name);
jobject ReadObject(JNIEnv* env, jobject object, const char* name, const char* signature);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_JAVA_FIELDS_H_
