// SPDX-License-Identifier: Apache-2.0
// Decodes files from strangers in a helper process without rights. The helper process cannot open
// files, connect to a network, start programs or signal other processes, and its memory and its
// time are limited. The decoders of this program and of the libraries it uses run there: if a file
// makes a decoder crash, loop or wait forever, the program reports an error and continues.
#ifndef STARFOCUS_PLATFORM_HELPER_HELPER_H_
#define STARFOCUS_PLATFORM_HELPER_HELPER_H_

#include <cstdint>
#include <functional>
#include <string>

#include "platform/helper/channel.h"
#include "platform/result.h"

namespace starfocus {

struct HelperLimits {
  uint64_t bytes;       // memory in addition to that of the program
  unsigned seconds;     // processor time, summed over the threads of the helper
  double wall_seconds;  // time for which the program waits for the result (watch.h)
  double idle_seconds;  // time for which it waits without progress of the helper (watch.h)
};

// A picture of 2^28 pixels, the limit of all decoders, takes less than 6 GiB: a progressive JPEG
// file needs 2 GiB for the file, 1.6 GiB for coefficients and 0.8 GiB each for up to two pictures.
// A decoder either computes or sends its result. The limit of the whole time stops decoders that
// only pretend to make progress.
inline constexpr HelperLimits kDecoderLimits = {uint64_t{8} << 30, 300, 600, 10};

// Lets Confined start helper processes, if this build supports them. Programs call the function
// once, before they start threads. Without this call, Confined decodes in the calling process.
void ConfineDecoders();
bool DecodersAreConfined();

// Gives up the right to use networks, to start other programs, and to access the memory of other
// processes, until the program ends. Does nothing if decoders are not confined. Programs call the
// function after ConfineDecoders and before they start threads.
void ConfineProgram();

// Runs `work` in a helper process, which ends afterwards, and `pass` in both processes to transfer
// the result (channel.h). Returns an error, which starts with `where`, if the helper process
// crashes, exceeds a limit, or does not send a whole result. Several threads may call the function
// at the same time. Only for builds with helper processes.
Error RunHelper(const std::string& where, const HelperLimits& limits,
                const std::function<void()>& work, const std::function<void(Channel*)>& pass);

// Calls `decode` in a helper process and returns its result. `decode` must use no files, because it
// reads bytes that the program has read.
template <class T, class Decode>
Result<T> Confined(const std::string& where, Decode decode) {
  if (!DecodersAreConfined()) return decode();
  Result<T> result = T();
  const Error error = RunHelper(
      where, kDecoderLimits, [&] { result = decode(); },
      [&](Channel* channel) { Pass(channel, &result); });
  if (error) return error;
  return result;
}

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_HELPER_HELPER_H_
