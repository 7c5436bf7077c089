// SPDX-License-Identifier: Apache-2.0
// Procedural patterns: deterministic noise from integer hashes. Only + - * /, floor and sqrt are
// used, so that every IEEE machine makes the same pictures.
#ifndef STARFOCUS_EXAMPLES_SCENE_NOISE_H_
#define STARFOCUS_EXAMPLES_SCENE_NOISE_H_

#include <cstdint>

namespace starfocus {

// Well-mixed 32 bits from two lattice coordinates and a seed.
uint32_t Hash(int32_t x, int32_t y, uint32_t seed);

// The same as a number in [0, 1).
double HashUnit(int32_t x, int32_t y, uint32_t seed);

// Smooth noise in [0, 1] with features about one unit across.
double Noise(double x, double y, uint32_t seed);

// `octaves` octaves of Noise, each half as large and half as strong, in [0, 1].
double Fractal(double x, double y, int octaves, uint32_t seed);

// x modulo period, in [0, period).
double Wrap(double x, double period);

// Triangle wave of the given period, in [0, 1], 0 at multiples of the period.
double Triangle(double x, double period);

// 0 below `low`, 1 above `high`, smooth between.
double Smooth(double low, double high, double x);

inline double Clamp01(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_NOISE_H_
