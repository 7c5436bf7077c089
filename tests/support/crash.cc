// SPDX-License-Identifier: Apache-2.0
// A library that crash_test.sh preloads. The library makes libjpeg crash when it reads a file whose
// size in bytes is $CRASH_SIZE, or if libjpeg could connect to a network although $NO_NETWORK is
// set.
#include <dlfcn.h>
#include <sys/socket.h>

#include <cstdlib>

extern "C" void jpeg_mem_src(void* info, const unsigned char* bytes, unsigned long size);

extern "C" void jpeg_mem_src(void* info, const unsigned char* bytes, unsigned long size) {
  const char* crash = std::getenv("CRASH_SIZE");
  if (crash != nullptr && std::strtoul(crash, nullptr, 10) == size) std::abort();
  if (std::getenv("NO_NETWORK") != nullptr && socket(AF_INET, SOCK_STREAM, 0) >= 0) std::abort();
  using Function = void (*)(void*, const unsigned char*, unsigned long);
  const auto next = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "jpeg_mem_src"));
  next(info, bytes, size);
}
