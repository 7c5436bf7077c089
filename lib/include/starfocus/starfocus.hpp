// SPDX-License-Identifier: Apache-2.0
// Thin C++17 wrapper of starfocus.h: owns the workspace, adds nothing else. Header-only; no
// exceptions: every call returns an sf_status.
#ifndef STARFOCUS_STARFOCUS_HPP_
#define STARFOCUS_STARFOCUS_HPP_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>

#include "starfocus/starfocus.h"

namespace starfocus {

struct Config : sf_config {
  Config() { sf_config_init(this); }
};

struct Params : sf_params {
  Params() { sf_params_init(this); }
};

// An engine together with its heap-allocated workspace. Movable; not for two threads at once.
// Before Init, and after it was moved from, every other call returns SF_ERROR_NULL.
class Engine {
 public:
  // Allocates the workspace and makes the engine, in place of one made before; SF_ERROR_MEMORY when
  // memory is short. After an error the engine is what it was before the call.
  sf_status Init(const sf_config& config) {
    size_t bytes = 0;
    sf_status status = sf_workspace_size(&config, &bytes);
    if (status != SF_OK) return status;
    Owned<sf_engine> fresh(bytes);
    if (fresh.memory == nullptr) return SF_ERROR_MEMORY;
    status = sf_init(&config, fresh.memory.get(), bytes, &fresh.handle);
    if (status != SF_OK) return status;
    engine_ = std::move(fresh);
    prepared_ = Owned<sf_prepared>();
    config_ = config;
    config_.problem = nullptr;  // which the caller may not keep
    return SF_OK;
  }

  // Functions of the caller for all further calls. Init forgets them.
  sf_status SetCallbacks(const sf_callbacks& callbacks) {
    return sf_set_callbacks(get(), &callbacks);
  }

  sf_status Refocus(const sf_params& params, const sf_light_field& light_field, const sf_image& out,
                    sf_report* report = nullptr) {
    return sf_refocus(get(), &params, &light_field, &out, report);
  }

  // What the last call refused; null before Init. That of Init is where config.problem points to.
  const sf_problem* problem() const { return sf_engine_problem(engine_.handle); }

  // Allocates the memory of a prepared light field and prepares it; SF_ERROR_MEMORY when memory is
  // short. One prepared before is freed first, so that there are never two: after an error there is
  // none, and RefocusPrepared returns SF_ERROR_NULL.
  sf_status Prepare(const sf_light_field& light_field) {
    prepared_ = Owned<sf_prepared>();
    if (get() == nullptr) return SF_ERROR_NULL;
    size_t bytes = 0;
    sf_status status = sf_prepared_size(&config_, &bytes);
    if (status != SF_OK) return status;
    Owned<sf_prepared> fresh(bytes);
    if (fresh.memory == nullptr) return SF_ERROR_MEMORY;
    status = sf_prepare(get(), &light_field, fresh.memory.get(), bytes, &fresh.handle);
    if (status == SF_OK) prepared_ = std::move(fresh);
    return status;
  }

  sf_status RefocusPrepared(const sf_params& params, const sf_image& out,
                            sf_report* report = nullptr) {
    return sf_refocus_prepared(get(), &params, prepared_.handle, &out, report);
  }

  sf_status StreamBegin(const sf_params& params) { return sf_stream_begin(get(), &params); }

  sf_status StreamPush(const sf_light_field& rows, int32_t count, int32_t* consumed) {
    return sf_stream_push(get(), &rows, count, consumed);
  }

  sf_status StreamPull(const sf_image& out, int32_t rows, int32_t* written,
                       sf_report* report = nullptr) {
    return sf_stream_pull(get(), &out, rows, written, report);
  }

  sf_engine* get() const { return engine_.handle; }
  size_t workspace_bytes() const { return engine_.bytes; }

 private:
  struct Free {
    void operator()(void* memory) const {
      ::operator delete(memory, std::align_val_t(SF_ALIGNMENT));
    }
  };

  // What was made in memory of its own; nothing once it was moved from.
  template <class Handle>
  struct Owned {
    Owned() = default;
    explicit Owned(size_t size)
        : memory(::operator new(size, std::align_val_t(SF_ALIGNMENT), std::nothrow)), bytes(size) {}
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

  Owned<sf_engine> engine_;
  Owned<sf_prepared> prepared_;
  sf_config config_ = {};
};

}  // namespace starfocus

#endif  // STARFOCUS_STARFOCUS_HPP_
