// SPDX-License-Identifier: Apache-2.0
#include "platform/helper/decoder_threads.h"

#include <atomic>
#include <vector>

#include "platform/pool/big_cores.h"

namespace starfocus {
namespace {

std::atomic<int> most{0};

}  // namespace

void SetDecoderThreads(int threads) { most = threads; }

int DecoderThreads() { return most; }

void UseDecoderThreads(unsigned turn) {
  const size_t threads = static_cast<size_t>(DecoderThreads());
  if (threads == 0) return;
  const CoreSet available = BigCores();
  std::vector<int> cores;
  for (int core = 0; core < kMaxCores; ++core) {
    if (available.Has(core)) cores.push_back(core);
  }
  if (cores.size() <= threads) return;
  CoreSet chosen;
  for (size_t k = 0; k < threads; ++k) {
    chosen.Add(cores[(turn * threads + k) % cores.size()]);
  }
  RunOn(chosen);
}

}  // namespace starfocus
