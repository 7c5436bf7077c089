// SPDX-License-Identifier: Apache-2.0
// usage: starfocus-bench-speed ROUNDS [FOLDER FOCUS srgb|none]...
//
// Compares the engine (block mode, 5 views, one worker) with shift-and-add of 13 views, for the
// best SIMD target of each vector width. All runs of a scene alternate, and the smallest processor
// time of each run counts, because other processes only add time. If FOLDER contains the ray-traced
// picture of the focus, the last columns are the PSNR of both pictures against it. The last
// argument is the transfer function of the ray-traced picture.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "examples/lab/bench/metrics.h"
#include "examples/lab/bench/shift_and_add.h"
#include "examples/lab/bench/timed_engine.h"
#include "simd/kernels.h"

namespace starfocus::bench {
namespace {

// Shift-and-add uses the 13 of these 17 views that lie inside the lens.
constexpr int kViews = 5, kRivalViews = 17;

// The engine and its rival with vectors of one width.
struct Pair {
  Task task;
  TimedEngine timed;
  std::unique_ptr<ShiftAndAdd> rival;
  Image rival_picture;
  double engine_seconds = HUGE_VAL, rival_seconds = HUGE_VAL;
};

Error MakePairs(const Field& field, double focus, std::vector<Pair>* pairs) {
  const simd::Kernels* kernels = nullptr;
  for (size_t i = 0; (kernels = simd::KernelsOfTarget(i)) != nullptr; ++i) {
    Pair pair;
    pair.rival = std::make_unique<ShiftAndAdd>(field, kRivalViews, focus, kernels->name);
    const int bits = pair.rival->vector_bits();
    // The targets are sorted from the best to the worst. The last may be without vectors.
    if (bits < 128 || (!pairs->empty() && pairs->back().rival->vector_bits() == bits)) continue;
    pair.task.views = kViews;
    pair.task.target = kernels->name;
    pair.task.timed = false;
    pair.rival_picture = Image(field.data.width(), field.data.height());
    pairs->push_back(std::move(pair));
    if (Error error = Prepare(field, pairs->back().task, focus, 1, &pairs->back().timed)) {
      return error;
    }
  }
  return {};
}

Error RunOnce(const Field& field, Pair* pair) {
  Elapsed elapsed;
  if (Error error = RunOnce(field, pair->task, &pair->timed, &elapsed)) return error;
  pair->engine_seconds = std::min(pair->engine_seconds, elapsed.cpu);
  const Stopwatch stopwatch;
  pair->rival->Run(&pair->rival_picture);
  pair->rival_seconds = std::min(pair->rival_seconds, stopwatch.Get().cpu);
  return {};
}

void Print(const Field& field, double focus, const std::vector<Pair>& pairs) {
  const Image* const truth = field.FindTruth(focus, 1);
  for (const Pair& pair : pairs) {
    std::printf("| %s %g | %d (%s) | %.1f | %.1f | %.2f |", field.name.c_str(), focus,
                pair.rival->vector_bits(), pair.task.target.c_str(), 1e3 * pair.engine_seconds,
                1e3 * pair.rival_seconds, pair.engine_seconds / pair.rival_seconds);
    if (truth == nullptr) {
      std::printf(" – | – |\n");
    } else {
      std::printf(" %.2f | %.2f |\n", Psnr(pair.timed.picture, *truth),
                  Psnr(pair.rival_picture, *truth));
    }
  }
}

Error Compare(const std::string& folder, double focus, const std::string& transfer, int rounds) {
  Field field;
  if (Error error = LoadField(folder, &field)) return error;
  if (field.views() < kRivalViews) {
    return Expected(folder, "at least " + std::to_string(kRivalViews) + " views",
                    std::to_string(field.views()));
  }
  field.transfer = transfer == "none" ? STARFOCUS_TRANSFER_NONE : STARFOCUS_TRANSFER_SRGB;
  std::vector<Pair> pairs;
  if (Error error = MakePairs(field, focus, &pairs)) return error;
  for (int round = 0; round < rounds; ++round) {
    for (Pair& pair : pairs) {
      if (Error error = RunOnce(field, &pair)) return error;
    }
  }
  Print(field, focus, pairs);
  return {};
}

}  // namespace
}  // namespace starfocus::bench

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 0;
  if (rounds < 1 || argc % 3 != 2) {
    std::fprintf(stderr, "usage: starfocus-bench-speed ROUNDS [FOLDER FOCUS srgb|none]...\n");
    return 1;
  }
  std::printf(
      "| scene, focus | bits | engine, ms | shift-and-add, ms | ratio | engine, dB | "
      "shift-and-add, dB |\n|---|---|--:|--:|--:|--:|--:|\n");
  for (int k = 2; k < argc; k += 3) {
    const starfocus::Error error =
        starfocus::bench::Compare(argv[k], std::atof(argv[k + 1]), argv[k + 2], rounds);
    if (!error) continue;
    std::fprintf(stderr, "%s\n", error.line().c_str());
    return 1;
  }
  return 0;
}
