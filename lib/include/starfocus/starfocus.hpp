// SPDX-License-Identifier: Apache-2.0
/** @file
 * C++17 wrapper of starfocus.h, header-only. The wrapper owns the memory of an engine and adds no
 * other features. The wrapper throws no exceptions: calls return a starfocus_status, as in C. */
#ifndef STARFOCUS_STARFOCUS_HPP_
#define STARFOCUS_STARFOCUS_HPP_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"

namespace starfocus {

/** Configuration with the defaults and a tuning of its own. */
struct Config : starfocus_config {
  Config() {
    starfocus_config_init(this);
    starfocus_tuning_init(&tuning);
    starfocus_config::tuning = &tuning;
  }
  /** Copies the tuning as well. */
  Config(const Config& other) : Config() { *this = other; }
  /** Copies the tuning as well. */
  Config& operator=(const Config& other) {
    static_cast<starfocus_config&>(*this) = other;
    tuning = other.tuning;
    starfocus_config::tuning = &tuning;
    return *this;
  }

  starfocus_tuning tuning; /**< Hides the pointer of starfocus_config, which points here. */
};

/** Parameters with the defaults and a study of their own. */
struct Params : starfocus_params {
  Params() {
    starfocus_params_init(this);
    starfocus_study_init(&study);
    starfocus_params::study = &study;
  }
  /** Copies the study, unless it is null. */
  explicit Params(const starfocus_params& other) : starfocus_params(other) {
    starfocus_study_init(&study);
    if (other.study != nullptr) study = *other.study;
    starfocus_params::study = &study;
  }
  /** Copies the study as well. */
  Params(const Params& other) : Params(static_cast<const starfocus_params&>(other)) {}
  /** Copies the study as well. */
  Params& operator=(const Params& other) {
    static_cast<starfocus_params&>(*this) = other;
    study = other.study;
    starfocus_params::study = &study;
    return *this;
  }

  starfocus_study study; /**< Hides the pointer of starfocus_params, which points here. */
};

/** Returns a light field without views. */
inline starfocus_light_field NewLightField() {
  starfocus_light_field light_field;
  starfocus_light_field_init(&light_field);
  return light_field;
}

/** Returns statistics that are all 0. */
inline starfocus_report NewReport() {
  starfocus_report report;
  starfocus_report_init(&report);
  return report;
}

/** An engine and its prepared light field, in memory of operator new. Engines are movable. One
 *  thread at a time may use an engine. Before Init, and on an engine that was moved from, all calls
 *  except Init return STARFOCUS_ERROR_NULL. */
class Engine {
 public:
  /** Creates an engine, which replaces any earlier engine. After an error the earlier engine
   *  remains.
   *  @param config configuration
   *  @param problem receives the cause of an error; may be null
   *  @return as starfocus_create */
  starfocus_status Init(const starfocus_config& config, starfocus_problem* problem = nullptr) {
    const starfocus_allocator allocator = {nullptr, Allocate, Release};
    starfocus_engine* made = nullptr;
    const starfocus_status status = starfocus_create(&config, &allocator, &made, problem);
    if (status != STARFOCUS_OK) return status;
    prepared_.reset();
    engine_.reset(made);
    return STARFOCUS_OK;
  }

  /** Sets the callbacks of all later calls, until the next Init.
   *  @param callbacks callbacks, of which the engine keeps a copy
   *  @return as starfocus_set_callbacks */
  starfocus_status SetCallbacks(const starfocus_callbacks& callbacks) {
    return starfocus_set_callbacks(get(), &callbacks);
  }

  /** Calls starfocus_refocus. */
  starfocus_status Refocus(const starfocus_params& params, const starfocus_light_field& light_field,
                           const starfocus_image& out, starfocus_report* report = nullptr) {
    return starfocus_refocus(get(), &params, &light_field, &out, report);
  }

  /** Returns the problem that the last call except Init reported.
   *  @return the problem; null before Init */
  const starfocus_problem* problem() const { return starfocus_engine_problem(get()); }

  /** Prepares a light field. Frees any earlier prepared light field first. After an error no
   *  prepared light field exists, and RefocusPrepared returns STARFOCUS_ERROR_NULL.
   *  @param light_field light field, whose pixels must stay unchanged until the last refocusing
   *  @return as starfocus_prepare */
  starfocus_status Prepare(const starfocus_light_field& light_field) {
    prepared_.reset();
    starfocus_prepared* made = nullptr;
    const starfocus_status status = starfocus_prepare(get(), &light_field, nullptr, 0, &made);
    prepared_.reset(made);
    return status;
  }

  /** Calls starfocus_refocus_prepared. */
  starfocus_status RefocusPrepared(const starfocus_params& params, const starfocus_image& out,
                                   starfocus_report* report = nullptr) {
    return starfocus_refocus_prepared(get(), &params, prepared_.get(), &out, report);
  }

  /** Calls starfocus_stream_begin. */
  starfocus_status StreamBegin(const starfocus_params& params) {
    return starfocus_stream_begin(get(), &params);
  }

  /** Calls starfocus_stream_push. */
  starfocus_status StreamPush(const starfocus_light_field& rows, int32_t count, int32_t* consumed) {
    return starfocus_stream_push(get(), &rows, count, consumed);
  }

  /** Calls starfocus_stream_pull. */
  starfocus_status StreamPull(const starfocus_image& out, int32_t rows, int32_t* written,
                              starfocus_report* report = nullptr) {
    return starfocus_stream_pull(get(), &out, rows, written, report);
  }

  /** Returns the engine, for functions of the C API; null before Init. */
  starfocus_engine* get() const { return engine_.get(); }

 private:
  static void* Allocate(void*, size_t bytes, size_t alignment) {
    return ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
  }
  static void Release(void*, void* memory, size_t) {
    ::operator delete(memory, std::align_val_t(STARFOCUS_ALIGNMENT));
  }
  // Doxygen 1.9.4 links to a list of private structures that it does not write.
  /// @cond
  struct Destroy {
    void operator()(starfocus_engine* engine) const { starfocus_destroy(engine); }
    void operator()(starfocus_prepared* prepared) const { starfocus_destroy_prepared(prepared); }
  };
  /// @endcond

  std::unique_ptr<starfocus_engine, Destroy> engine_;
  std::unique_ptr<starfocus_prepared, Destroy> prepared_;
};

}  // namespace starfocus

#endif  // STARFOCUS_STARFOCUS_HPP_
