// SPDX-License-Identifier: Apache-2.0
#include "tests/operations/rig.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>
#include <utility>

#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/simd_targets.h"

namespace starfocus::stress {

std::string Variant::Text() const {
  return std::string(kernels == nullptr ? "best" : kernels->name) + ", " + std::to_string(workers) +
         (order == 0 ? " workers" : " shuffled workers") +
         (stream ? ", streaming " + std::to_string(push_rows) + "/" + std::to_string(pull_rows)
                 : std::string(", whole")) +
         (room == 1 ? "" : ", max_blur times " + std::to_string(room)) + ", memory of " +
         (poison < 0     ? "the heap"
          : poison > 255 ? "noise"
                         : std::to_string(poison));
}

const std::vector<const simd::Kernels*>& AllKernels() {
  static const std::vector<const simd::Kernels*> all = [] {
    std::vector<const simd::Kernels*> found = test::SimdTargets();
    found.insert(found.begin(), &simd::ReferenceKernels());
    return found;
  }();
  return all;
}

Variant RandomVariant(test::Random* random) {
  const auto& all = AllKernels();
  Variant variant;
  variant.kernels = all[static_cast<size_t>(random->Int(0, static_cast<int>(all.size()) - 1))];
  variant.stream = random->Int(0, 1) == 1;
  variant.workers = random->Int(1, 4);
  variant.order = random->Int(0, 1) == 1 ? random->Next() + 1u : 0;
  variant.poison = random->Int(-64, 320);
  variant.push_rows = random->Int(1, 40);
  variant.pull_rows = random->Int(1, 40);
  if (random->Int(0, 2) == 0) variant.room = random->Real(1, 8);
  return variant;
}

Memory::Memory(size_t bytes, int poison, test::Random* random)
    : memory_(::operator new (bytes, std::align_val_t{STARFOCUS_ALIGNMENT})) {
  auto* to = static_cast<uint8_t*>(memory_.get());
  if (poison >= 0 && poison <= 255) std::memset(to, poison, bytes);
  if (poison <= 255) return;
  // The random bytes repeat with a period of 1021 bytes, which is not a multiple of the element
  // sizes of tables.
  const size_t drawn = std::min<size_t>(bytes, 1021);
  for (size_t i = 0; i < drawn; ++i) to[i] = random->Byte();
  for (size_t i = drawn; i < bytes; i += drawn) std::memcpy(to + i, to, std::min(drawn, bytes - i));
}

void Memory::Free::operator()(void* memory) const {
  ::operator delete (memory, std::align_val_t{STARFOCUS_ALIGNMENT});
}

Rig::Rig(const test::Config& config, const Variant& variant)
    : config_(config), variant_(variant), random_(variant.order) {
  test::SetFeature(STARFOCUS_FEATURE_STREAMING, variant.stream, &config_.features);
  config_.max_workers = variant.workers;
  config_.max_blur = std::min(STARFOCUS_MAX_BLUR, config.max_blur * variant.room);
  status_ = starfocus_workspace_size(&config_, &bytes_, nullptr);
  if (status_ != STARFOCUS_OK) return;
  memory_ = std::make_unique<Memory>(bytes_, variant.poison, &random_);
  Restart();
}

void Rig::Restart() {
  status_ = starfocus_init(&config_, memory_->get(), bytes_, &engine_, nullptr);
  if (status_ == STARFOCUS_OK && variant_.kernels != nullptr) {
    test::UseKernels(variant_.kernels, engine_);
  }
}

int Rig::Run(void* self, starfocus_job job, void* data, int32_t count) {
  Rig* rig = static_cast<Rig*>(self);
  std::vector<int32_t> order(static_cast<size_t>(count));
  for (int32_t i = 0; i < count; ++i) order[static_cast<size_t>(i)] = i;
  for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rig->random_.Next() % i]);
  for (const int32_t index : order) {
    const int32_t worker = rig->random_.Int(0, rig->variant_.workers - 1);
    if (rig->jobs_left_ != 0) {
      if (rig->jobs_left_ > 0) --rig->jobs_left_;
      job(data, index, worker);
      continue;
    }
    rig->jobs_left_ = -1;
    rig->failed_ = true;
    switch (rig->random_.Int(0, 4)) {
      case 0:
        return 1;  // the runner reports the failure
      case 1:
        break;  // the runner omits the job
      case 2:
        job(data, index, rig->variant_.workers);
        break;  // the runner uses an invalid worker
      case 3:
        job(data, count, worker);
        break;  // the runner runs an invalid job
      default:
        job(data, index, worker);
        job(data, index, worker);
    }
  }
  return 0;
}

std::vector<uint8_t> Refocused(const Setup& setup, const Variant& variant,
                               starfocus_report* report) {
  Rig rig(setup.config, variant);
  starfocus_status status = rig.status();
  test::Output out(setup.scene.width, setup.scene.height, 5);
  if (status == STARFOCUS_OK) {
    status = variant.stream
                 ? test::Stream(&rig, setup.params, setup.scene, &out, variant.push_rows,
                                variant.pull_rows, rig.callbacks(), report)
                 : test::Refocus(&rig, setup.params, setup.scene, &out, rig.callbacks(), report);
  }
  std::string failure;
  if (!out.PaddingUntouched()) failure = "the call writes to the padding of rows";
  if (status != STARFOCUS_OK) failure = starfocus_status_string(status);
  if (!failure.empty()) {
    throw std::runtime_error(failure + " (" + variant.Text() + "): " + setup.Text());
  }
  return out.Tight();
}

}  // namespace starfocus::stress
