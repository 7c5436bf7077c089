// SPDX-License-Identifier: Apache-2.0
// Detects sanitizers that replace the heap. Programs with such sanitizers are slow and reserve
// large address ranges. gcc and clang report sanitizers in different ways.
#ifndef STARFOCUS_TESTS_SUPPORT_SANITIZERS_H_
#define STARFOCUS_TESTS_SUPPORT_SANITIZERS_H_

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define STARFOCUS_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || \
    __has_feature(thread_sanitizer)
#define STARFOCUS_SANITIZED
#endif
#endif

namespace test {

#ifdef STARFOCUS_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_SANITIZERS_H_
