// SPDX-License-Identifier: Apache-2.0
// A library that crash_test.sh preloads. The library makes libjpeg crash when it reads a file whose
// size in bytes is $CRASH_SIZE, or if libjpeg could connect to a network although $NO_NETWORK is
// set. The library makes a process crash that runs more than $MOST_THREADS threads beside its
// first.
#include <dlfcn.h>
#include <pthread.h>
#include <sys/socket.h>

#include <atomic>
#include <climits>
#include <cstdlib>

static std::atomic<long> threads{0};

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*run)(void*), void* data) {
  const char* most = std::getenv("MOST_THREADS");
  if (++threads > (most != nullptr ? std::strtol(most, nullptr, 10) : LONG_MAX)) std::abort();
  static const auto next =
      reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
  return next(thread, attributes, run, data);
}

extern "C" int pthread_join(pthread_t thread, void** result) {
  --threads;
  static const auto next =
      reinterpret_cast<decltype(&pthread_join)>(dlsym(RTLD_NEXT, "pthread_join"));
  return next(thread, result);
}

extern "C" void jpeg_mem_src(void* info, const unsigned char* bytes, unsigned long size);

extern "C" void jpeg_mem_src(void* info, const unsigned char* bytes, unsigned long size) {
  const char* crash = std::getenv("CRASH_SIZE");
  if (crash != nullptr && std::strtoul(crash, nullptr, 10) == size) std::abort();
  if (std::getenv("NO_NETWORK") != nullptr && socket(AF_INET, SOCK_STREAM, 0) >= 0) std::abort();
  using Function = void (*)(void*, const unsigned char*, unsigned long);
  const auto next = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "jpeg_mem_src"));
  next(info, bytes, size);
}
