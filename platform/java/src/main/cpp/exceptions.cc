// SPDX-License-Identifier: Apache-2.0
#include "platform/java/src/main/cpp/exceptions.h"

#include <cstdarg>
#include <cstdio>

#include "platform/problem.h"

namespace starfocus {
namespace {

void ThrowNew(JNIEnv* env, const char* name, const char* text) {
  const jclass kind = env->FindClass(name);
  if (kind != nullptr) env->ThrowNew(kind, text);
}

}  // namespace

void ThrowArgument(JNIEnv* env, const char* format, ...) {
  char text[200];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  ThrowNew(env, "java/lang/IllegalArgumentException", text);
}

void ThrowStatus(JNIEnv* env, starfocus_status status, const starfocus_problem* problem) {
  if (status == STARFOCUS_OK) return;
  const ProblemText described = Describe(status, problem);
  const char* const text = described.text;
  if (status == STARFOCUS_ERROR_MEMORY || status == STARFOCUS_ERROR_TOO_LARGE) {
    ThrowNew(env, "java/lang/OutOfMemoryError", text);
    return;
  }
  const jclass kind = env->FindClass("dev/starfocus/StarfocusException");
  if (kind == nullptr) return;
  const jmethodID make = env->GetMethodID(kind, "<init>", "(ILjava/lang/String;)V");
  const jstring message = env->NewStringUTF(text);
  if (make == nullptr || message == nullptr) return;
  const jobject thrown = env->NewObject(kind, make, jint(status), message);
  if (thrown != nullptr) env->Throw(static_cast<jthrowable>(thrown));
}

}  // namespace starfocus
