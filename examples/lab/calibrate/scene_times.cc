// SPDX-License-Identifier: Apache-2.0

#include "examples/lab/calibrate/scene_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "platform/file.h"
#include "starfocus/experimental.h"

namespace starfocus {
namespace {

using Vector = std::array<double, kTimingTermCount>;

Vector Terms(const BlockWork& work) {
  Vector terms;
  for (size_t k = 0; k < terms.size(); ++k) {
    const TimingTerm& term = kTimingTerms[k];
    terms[k] = term.work == nullptr ? 1.0 : static_cast<double>(work.*term.work);
  }
  return terms;
}

// The normal equations of the least-squares fit, with every term scaled to unit length.
struct Equations {
  std::array<Vector, kTimingTermCount> matrix = {};
  Vector right = {}, length = {};
};

Equations MakeEquations(const std::vector<Measurement>& measurements) {
  Equations equations;
  for (const Measurement& measurement : measurements) {
    const Vector terms = Terms(measurement.work);
    const double weight = 1 / measurement.picoseconds;
    for (size_t i = 0; i < terms.size(); ++i) {
      for (size_t k = 0; k < terms.size(); ++k) {
        equations.matrix[i][k] += weight * terms[i] * terms[k];
      }
      equations.right[i] += weight * terms[i] * measurement.picoseconds;
    }
  }
  for (size_t i = 0; i < equations.length.size(); ++i) {
    equations.length[i] = std::sqrt(equations.matrix[i][i]);
  }
  for (size_t i = 0; i < equations.length.size(); ++i) {
    if (equations.length[i] == 0) continue;  // term i is 0 for all blocks
    equations.right[i] /= equations.length[i];
    for (size_t k = 0; k < equations.length.size(); ++k) {
      if (equations.length[k] == 0) continue;
      equations.matrix[i][k] /= equations.length[i] * equations.length[k];
    }
  }
  return equations;
}

// Solves the equations with coordinate descent: each iteration sets one unknown to its best
// non-negative value.
Vector Solve(const Equations& equations) {
  constexpr int kMostSweeps = 200000;
  Vector solution = {};
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double change = 0, largest = 0;
    for (size_t i = 0; i < solution.size(); ++i) {
      if (equations.length[i] == 0) continue;
      double rest = equations.right[i];
      for (size_t k = 0; k < solution.size(); ++k) {
        if (k != i) rest -= equations.matrix[i][k] * solution[k];
      }
      const double value = std::max(0.0, rest);
      change = std::max(change, std::fabs(value - solution[i]));
      largest = std::max(largest, value);
      solution[i] = value;
    }
    if (change <= 1e-12 * largest) break;
  }
  return solution;
}

}  // namespace

starfocus_timing FitTiming(const std::vector<Measurement>& measurements) {
  const Equations equations = MakeEquations(measurements);
  const Vector solution = Solve(equations);
  starfocus_timing timing = {};
  for (size_t k = 0; k < solution.size(); ++k) {
    if (equations.length[k] == 0) continue;
    const double value = std::min<double>(solution[k] / equations.length[k], STARFOCUS_MAX_TIMING);
    timing.*kTimingTerms[k].coefficient = static_cast<uint32_t>(value + 0.5);
  }
  return timing;
}

Agreement Compare(const starfocus_timing& timing, const std::vector<Measurement>& measurements) {
  const auto r_squared = [&](auto weight_of) {
    double sum = 0, weights = 0, errors = 0, deviations = 0;
    for (const Measurement& measurement : measurements) {
      const double weight = weight_of(measurement);
      weights += weight;
      sum += weight * measurement.picoseconds;
    }
    for (const Measurement& measurement : measurements) {
      const double time = measurement.picoseconds, weight = weight_of(measurement);
      const double error = time - static_cast<double>(PredictTime(timing, measurement.work));
      const double deviation = time - sum / weights;
      errors += weight * error * error;
      deviations += weight * deviation * deviation;
    }
    return deviations > 0 ? 1 - errors / deviations : 0;
  };
  return {r_squared([](const Measurement&) { return 1.0; }),
          r_squared([](const Measurement& each) { return 1 / each.picoseconds; })};
}

namespace {

constexpr int kBlocksPerGroup = 4;
constexpr double kNever = 1e30;

}  // namespace

Error SceneTimes::Open(const std::string& name, LightField light_field) {
  name_ = name;
  light_field_ = std::move(light_field);
  if (Error error = bench_.Open(name, light_field_)) return error;
  BlockSampler sampler(light_field_.disparity);
  bool layered = false;
  for (const BlockGroup& group : sampler.Sample(kBlocksPerGroup)) {
    groups_.emplace_back();
    layered = layered || group.kind.layer > 0;
    for (const BlockTask& task : group.tasks) {
      groups_.back().push_back({task, {bench_.Work(task), kNever}});
      ++blocks_;
    }
  }
  if (groups_.size() >= 2 * kTimingTermCount && layered) return {};
  return Expected(name, "a light field large enough for blocks of several sizes",
                  std::to_string(light_field_.width()) + "x" +
                      std::to_string(light_field_.height()) + " with " +
                      std::to_string(groups_.size()) + " configurations");
}

void SceneTimes::Measure(Progress* progress) {
  for (std::vector<Timed>& group : groups_) {
    for (Timed& timed : group) {
      // Avoid zero, because the fit divides by times.
      const double picoseconds = std::max(1.0, double(bench_.Time(timed.task)));
      timed.measurement.picoseconds = std::min(timed.measurement.picoseconds, picoseconds);
      progress->Step();
    }
  }
}

std::vector<Measurement> SceneTimes::Blocks() const {
  std::vector<Measurement> blocks;
  for (const std::vector<Timed>& group : groups_) {
    for (const Timed& timed : group) blocks.push_back(timed.measurement);
  }
  return blocks;
}

std::vector<Measurement> SceneTimes::Configurations() const {
  std::vector<Measurement> configurations;
  for (const std::vector<Timed>& group : groups_) {
    Measurement mean = {};
    for (const Timed& timed : group) {
      mean.picoseconds += timed.measurement.picoseconds / double(group.size());
      for (const TimingTerm& term : kTimingTerms) {
        if (term.work != nullptr) mean.work.*term.work += timed.measurement.work.*term.work;
      }
    }
    for (const TimingTerm& term : kTimingTerms) {
      if (term.work != nullptr) mean.work.*term.work /= group.size();
    }
    configurations.push_back(mean);
  }
  return configurations;
}

}  // namespace starfocus
