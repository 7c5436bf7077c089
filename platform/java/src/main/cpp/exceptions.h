// SPDX-License-Identifier: Apache-2.0
// Throws Java exceptions from native code. Each function of this header makes an exception pending.
// A pending exception takes effect when the native method returns to Java. After an exception is
// pending, the native method must return without other JNI calls.
#ifndef STARFOCUS_PLATFORM_JAVA_EXCEPTIONS_H_
#define STARFOCUS_PLATFORM_JAVA_EXCEPTIONS_H_

#include <jni.h>

#include "starfocus/starfocus.h"

namespace starfocus {

// Throws IllegalArgumentException. Formats the message of the exception from `format` and the
// following arguments, as printf does.
void ThrowArgument(JNIEnv* env, const char* format, ...) __attribute__((format(printf, 2, 3)));

// Throws OutOfMemoryError or StarfocusException, depending on the status. No-op for STARFOCUS_OK.
// `problem` is the cause that the failed call of the engine reported, or null.
void ThrowStatus(JNIEnv* env, starfocus_status status, const starfocus_problem* problem = nullptr);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_JAVA_EXCEPTIONS_H_
