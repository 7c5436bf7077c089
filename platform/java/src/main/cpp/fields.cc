// SPDX-License-Identifier: Apache-2.0
#include "platform/java/src/main/cpp/fields.h"

#include <cstring>

namespace starfocus {
namespace {

const char* SignatureOf(FieldType type) {
  switch (type) {
    case FieldType::kFloat:
      return "F";
    case FieldType::kDouble:
      return "D";
    default:
      return "I";
  }
}

jfieldID Find(JNIEnv* env, jobject object, const char* name, const char* signature) {
  const jclass kind = env->GetObjectClass(object);
  const jfieldID id = env->GetFieldID(kind, name, signature);
  env->DeleteLocalRef(kind);
  return id;
}

template <class T>
void Store(void* to, T value) {
  std::memcpy(to, &value, sizeof value);
}

template <class T>
T Load(const void* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

}  // namespace

bool ReadFields(JNIEnv* env, jobject object, const Field* fields, size_t count, void* structure) {
  for (size_t i = 0; i < count; ++i) {
    const jfieldID id = Find(env, object, fields[i].name, SignatureOf(fields[i].type));
    if (id == nullptr) return false;
    char* const to = static_cast<char*>(structure) + fields[i].offset;
    switch (fields[i].type) {
      case FieldType::kInt32:
        Store(to, static_cast<int32_t>(env->GetIntField(object, id)));
        break;
      case FieldType::kFloat:
        Store(to, env->GetFloatField(object, id));
        break;
      case FieldType::kDouble:
        Store(to, env->GetDoubleField(object, id));
        break;
    }
  }
  return true;
}

bool WriteFields(JNIEnv* env, const void* structure, const Field* fields, size_t count,
                 jobject object) {
  for (size_t i = 0; i < count; ++i) {
    const jfieldID id = Find(env, object, fields[i].name, SignatureOf(fields[i].type));
    if (id == nullptr) return false;
    const char* const from = static_cast<const char*>(structure) + fields[i].offset;
    switch (fields[i].type) {
      case FieldType::kInt32:
        env->SetIntField(object, id, Load<int32_t>(from));
        break;
      case FieldType::kFloat:
        env->SetFloatField(object, id, Load<float>(from));
        break;
      case FieldType::kDouble:
        env->SetDoubleField(object, id, Load<double>(from));
        break;
    }
  }
  return true;
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
