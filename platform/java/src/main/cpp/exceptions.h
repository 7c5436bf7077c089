// SPDX-License-Identifier: Apache-2.0
// Java exceptions thrown from native code. After one is thrown the native method returns to Java,
// where it takes effect.
#ifndef STARFOCUS_PLATFORM_JAVA_EXCEPTIONS_H_
#define STARFOCUS_PLATFORM_JAVA_EXCEPTIONS_H_

#include <jni.h>

#include "starfocus/status.h"

namespace starfocus {

// IllegalArgumentException; the text is made as by printf.
void ThrowArgument(JNIEnv* env, const char* format, ...) __attribute__((format(printf, 2, 3)));

// OutOfMemoryError or StarfocusException, whichever the status is; STARFOCUS_OK throws nothing.
// `problem` (null: none) is what the call refused.
void ThrowStatus(JNIEnv* env, starfocus_status status, const starfocus_problem* problem = nullptr);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_JAVA_EXCEPTIONS_H_
