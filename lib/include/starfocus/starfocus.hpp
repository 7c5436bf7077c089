// SPDX-License-Identifier: Apache-2.0
// Thin C++17 wrapper of starfocus.h: owns the workspace, adds nothing else. Header-only; no
// exceptions: every call returns a starfocus_status.
#ifndef STARFOCUS_STARFOCUS_HPP_
#define STARFOCUS_STARFOCUS_HPP_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>

#include "starfocus/starfocus.h"

namespace starfocus {

struct Config : starfocus_config {
  Config() { starfocus_config_init(this); }
};

struct Params : starfocus_params {
  Params() { starfocus_params_init(this); }
};

// An engine together with its heap-allocated workspace. Movable; not for two threads at once.
// Before Init, and after it was moved from, every other call returns STARFOCUS_ERROR_NULL.
class Engine {
 public:
  // Allocates the workspace and makes the engine, in place of one made before;
  // STARFOCUS_ERROR_MEMORY when memory is short. After an error the engine is what it was before
  // the call.
  starfocus_status Init(const starfocus_config& config) {
    size_t bytes = 0;
    starfocus_status status = starfocus_workspace_size(&config, &bytes);
    if (status != STARFOCUS_OK) return status;
    Owned<starfocus_engine> fresh(bytes);
    if (fresh.memory == nullptr) return STARFOCUS_ERROR_MEMORY;
    status = starfocus_init(&config, fresh.memory.get(), bytes, &fresh.handle);
    if (status != STARFOCUS_OK) return status;
    engine_ = std::move(fresh);
    prepared_ = Owned<starfocus_prepared>();
    config_ = config;
    config_.problem = nullptr;  // which the caller may not keep
    return STARFOCUS_OK;
  }

  // Functions of the caller for all further calls. Init forgets them.
  starfocus_status SetCallbacks(const starfocus_callbacks& callbacks) {
    return starfocus_set_callbacks(get(), &callbacks);
  }

  starfocus_status Refocus(const starfocus_params& params, const starfocus_light_field& light_field,
                           const starfocus_image& out, starfocus_report* report = nullptr) {
    return starfocus_refocus(get(), &params, &light_field, &out, report);
  }

  // What the last call refused; null before Init. That of Init is where config.problem points to.
  const starfocus_problem* problem() const { return starfocus_engine_problem(engine_.handle); }

  // Allocates the memory of a prepared light field and prepares it; STARFOCUS_ERROR_MEMORY when
  // memory is short. One prepared before is freed first, so that there are never two: after an
  // error there is none, and RefocusPrepared returns STARFOCUS_ERROR_NULL.
  starfocus_status Prepare(const starfocus_light_field& light_field) {
    prepared_ = Owned<starfocus_prepared>();
    if (get() == nullptr) return STARFOCUS_ERROR_NULL;
    size_t bytes = 0;
    starfocus_status status = starfocus_prepared_size(&config_, &bytes);
    if (status != STARFOCUS_OK) return status;
    Owned<starfocus_prepared> fresh(bytes);
    if (fresh.memory == nullptr) return STARFOCUS_ERROR_MEMORY;
    status = starfocus_prepare(get(), &light_field, fresh.memory.get(), bytes, &fresh.handle);
    if (status == STARFOCUS_OK) prepared_ = std::move(fresh);
    return status;
  }

  starfocus_status RefocusPrepared(const starfocus_params& params, const starfocus_image& out,
                                   starfocus_report* report = nullptr) {
    return starfocus_refocus_prepared(get(), &params, prepared_.handle, &out, report);
  }

  starfocus_status StreamBegin(const starfocus_params& params) {
    return starfocus_stream_begin(get(), &params);
  }

  starfocus_status StreamPush(const starfocus_light_field& rows, int32_t count, int32_t* consumed) {
    return starfocus_stream_push(get(), &rows, count, consumed);
  }

  starfocus_status StreamPull(const starfocus_image& out, int32_t rows, int32_t* written,
                              starfocus_report* report = nullptr) {
    return starfocus_stream_pull(get(), &out, rows, written, report);
  }

  starfocus_engine* get() const { return engine_.handle; }
  size_t workspace_bytes() const { return engine_.bytes; }

 private:
  struct Free {
    void operator()(void* memory) const {
      ::operator delete(memory, std::align_val_t(STARFOCUS_ALIGNMENT));
    }
  };

  // What was made in memory of its own; nothing once it was moved from.
  template <class Handle>
  struct Owned {
    Owned() = default;
    explicit Owned(size_t size)
        : memory(::operator new(size, std::align_val_t(STARFOCUS_ALIGNMENT), std::nothrow)),
          bytes(size) {}
    Owned(Owned&& other) noexcept { *this = std::move(other); }
    Owned& operator=(Owned&& other) noexcept {
      memory = std::move(other.memory);
      handle = std::exchange(other.handle, nullptr);
      bytes = std::exchange(other.bytes, 0);
      return *this;
    }

    std::unique_ptr<void, Free> memory;
    Handle* handle = nullptr;
    size_t bytes = 0;
  };

  Owned<starfocus_engine> engine_;
  Owned<starfocus_prepared> prepared_;
  starfocus_config config_ = {};
};

}  // namespace starfocus

#endif  // STARFOCUS_STARFOCUS_HPP_
