// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/calibrate/scene_times.h"

#include <algorithm>
#include <utility>

#include "platform/file.h"

namespace starfocus {
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
