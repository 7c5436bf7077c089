// SPDX-License-Identifier: Apache-2.0
// The number of threads that a decoder may use. The programs set the number to the value of
// --threads. Decoders of libraries that start threads of their own obey it: libheif by an argument
// (readers/heic.cc), and in a helper process all others, because the process is restricted to as
// many processors.
#ifndef STARFOCUS_PLATFORM_HELPER_DECODER_THREADS_H_
#define STARFOCUS_PLATFORM_HELPER_DECODER_THREADS_H_

namespace starfocus {

// Sets the number of threads, at least 1, of each decoder that starts later.
void SetDecoderThreads(int threads);

// Returns the number of threads, or 0 if it is not limited.
int DecoderThreads();

// Restricts the calling process to as many processors as DecoderThreads returns. Successive values
// of `turn` select different processors.
void UseDecoderThreads(unsigned turn);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_HELPER_DECODER_THREADS_H_
