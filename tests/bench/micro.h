// What starfocus-bench-micro times beside the kernels themselves.
#ifndef STARFOCUS_TESTS_BENCH_MICRO_H_
#define STARFOCUS_TESTS_BENCH_MICRO_H_

#include <string>

namespace starfocus::bench {

// Parts that have no kernels: the line scan and deblocking.
void RegisterScalarParts();

// Small pictures through the whole engine, by mode: "blur" is the ideal blur of one view.
void RegisterWholePictures(const std::string& target);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_MICRO_H_
