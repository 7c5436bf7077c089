// Thin C++17 wrapper of starfocus.h: owns the workspace, adds nothing else. Header-only; no
// exceptions: every call returns an sf_status.
#ifndef STARFOCUS_STARFOCUS_HPP_
#define STARFOCUS_STARFOCUS_HPP_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

#include "starfocus/starfocus.h"

namespace starfocus {

struct Config : sf_config {
  Config() { sf_config_init(this); }
};

struct Params : sf_params {
  Params() { sf_params_init(this); }
};

// An engine together with its heap-allocated workspace. Movable; not for two threads at once.
class Engine {
 public:
  // Allocates the workspace and makes the engine. SF_ERROR_NULL when memory is short.
  sf_status Init(const sf_config& config) {
    size_t bytes = 0;
    sf_status status = sf_workspace_size(&config, &bytes);
    if (status != SF_OK) return status;
    memory_.reset(::operator new(bytes, std::align_val_t(SF_ALIGNMENT), std::nothrow));
    if (!memory_) return SF_ERROR_NULL;
    bytes_ = bytes;
    return sf_init(&config, memory_.get(), bytes, &engine_);
  }

  sf_status Refocus(const sf_params& params, const sf_light_field& light_field, uint8_t* out,
                    size_t out_stride, sf_runner runner = nullptr, void* runner_data = nullptr,
                    sf_report* report = nullptr) {
    return sf_refocus(engine_, &params, &light_field, out, out_stride, runner, runner_data, report);
  }

  sf_status RefocusAfter(const sf_params& params, const sf_light_field& light_field,
                         const sf_previous& previous, uint8_t* out, size_t out_stride,
                         sf_runner runner = nullptr, void* runner_data = nullptr,
                         sf_report* report = nullptr) {
    return sf_refocus_after(engine_, &params, &light_field, &previous, out, out_stride, runner,
                            runner_data, report);
  }

  // Allocates the memory of a prepared light field, in place of one prepared before, and prepares
  // it. SF_ERROR_NULL when memory is short.
  sf_status Prepare(const sf_config& config, const sf_light_field& light_field,
                    sf_runner runner = nullptr, void* runner_data = nullptr) {
    size_t bytes = 0;
    const sf_status status = sf_prepared_size(&config, &bytes);
    if (status != SF_OK) return status;
    prepared_memory_.reset(::operator new(bytes, std::align_val_t(SF_ALIGNMENT), std::nothrow));
    return sf_prepare(engine_, &light_field, prepared_memory_.get(), bytes, runner, runner_data,
                      &prepared_);
  }

  sf_status RefocusPrepared(const sf_params& params, uint8_t* out, size_t out_stride,
                            sf_runner runner = nullptr, void* runner_data = nullptr,
                            sf_report* report = nullptr) {
    return sf_refocus_prepared(engine_, &params, prepared_, out, out_stride, runner, runner_data,
                               report);
  }

  sf_status StreamBegin(const sf_params& params) { return sf_stream_begin(engine_, &params); }

  sf_status StreamPush(const sf_light_field& rows, int32_t count, int32_t* consumed) {
    return sf_stream_push(engine_, &rows, count, consumed);
  }

  sf_status StreamPull(uint8_t* out, size_t out_stride, int32_t rows, int32_t* written,
                       sf_runner runner = nullptr, void* runner_data = nullptr,
                       sf_report* report = nullptr) {
    return sf_stream_pull(engine_, out, out_stride, rows, runner, runner_data, written, report);
  }

  sf_engine* get() const { return engine_; }
  size_t workspace_bytes() const { return bytes_; }

 private:
  struct Free {
    void operator()(void* memory) const {
      ::operator delete(memory, std::align_val_t(SF_ALIGNMENT));
    }
  };
  std::unique_ptr<void, Free> memory_, prepared_memory_;
  sf_prepared* prepared_ = nullptr;
  sf_engine* engine_ = nullptr;
  size_t bytes_ = 0;
};

}  // namespace starfocus

#endif  // STARFOCUS_STARFOCUS_HPP_
