// SPDX-License-Identifier: Apache-2.0
// Procedural patterns: deterministic noise from integer hashes. Uses only + - * /, floor and sqrt,
// so that pictures are identical on all IEEE 754 machines.
#ifndef STARFOCUS_EXAMPLES_SCENE_NOISE_H_
#define STARFOCUS_EXAMPLES_SCENE_NOISE_H_

#include <cstdint>

namespace starfocus {

// Returns 32 well-mixed bits from two lattice coordinates and a seed.
uint32_t Hash(int32_t x, int32_t y, uint32_t seed);

// Returns the hash of two lattice coordinates and a seed as a number in [0, 1).
double HashUnit(int32_t x, int32_t y, uint32_t seed);

// Returns smooth noise in [0, 1] whose features are about one unit wide.
double Noise(double x, double y, uint32_t seed);

// Returns the sum of `octaves` octaves of Noise in [0, 1]. Each octave has half the size and half
// the strength of the previous octave.
double Fractal(double x, double y, int octaves, uint32_t seed);

// Returns x modulo period, in [0, period).
double Wrap(double x, double period);

// Returns a triangle wave in [0, 1], which is 0 at multiples of the period.
double Triangle(double x, double period);

// Returns 0 below `low`, 1 above `high`, and a smooth transition between them.
double Smooth(double low, double high, double x);

inline double Clamp01(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_NOISE_H_
