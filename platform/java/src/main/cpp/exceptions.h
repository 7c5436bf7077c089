// SPDX-License-Identifier: Apache-2.0
// Throws Java exceptions from native code. Each function makes an exception pending. The exception
// takes effect when the native method returns to Java. The method must return without other JNI
// calls.
#ifndef STARFOCUS_PLATFORM_JAVA_EXCEPTIONS_H_
#define STARFOCUS_PLATFORM_JAVA_EXCEPTIONS_H_

#include <jni.h>

#include "starfocus/status.h"

namespace starfocus {

// Throws IllegalArgumentException. `format` and the arguments after `format` have the meaning of
// printf.
void ThrowArgument(JNIEnv* env, const char* format, ...) __attribute__((format(printf, 2, 3)));

// Throws OutOfMemoryError or StarfocusException, depending on the status. No-op for STARFOCUS_OK.
// `problem` is the cause that the call reported; may be null.
void ThrowStatus(JNIEnv* env, starfocus_status status, const starfocus_problem* problem = nullptr);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_JAVA_EXCEPTIONS_H_
