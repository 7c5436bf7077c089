// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/stages.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace starfocus {
namespace {

using FramePointer = std::unique_ptr<ClipFrame>;

// Holds at most one frame that a stage has finished and the next stage has not begun.
class Handover {
 public:
  // Waits until the place is free. Returns false if no stage will take the frame.
  bool Put(FramePointer frame) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [&] { return frame_ == nullptr || stopped_; });
    if (stopped_) return false;
    frame_ = std::move(frame);
    changed_.notify_all();
    return true;
  }
  // Waits for a frame. Returns null after the last frame.
  FramePointer Take() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [&] { return frame_ != nullptr || ended_; });
    changed_.notify_all();
    return std::move(frame_);
  }
  void End() { Set(&ended_); }     // after the last Put
  void Stop() { Set(&stopped_); }  // after the last Take

 private:
  void Set(bool* flag) {
    const std::lock_guard<std::mutex> lock(mutex_);
    *flag = true;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  FramePointer frame_;
  bool ended_ = false, stopped_ = false;
};

// The failure of the earliest frame.
class FirstFailure {
 public:
  void Set(size_t frame, const Error& error, std::exception_ptr exception) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if ((error_ || exception_ != nullptr) && frame_ <= frame) return;
    frame_ = frame;
    error_ = error;
    exception_ = std::move(exception);
  }
  Error Get() const {
    if (exception_ != nullptr) std::rethrow_exception(exception_);
    return error_;
  }

 private:
  std::mutex mutex_;
  size_t frame_ = 0;
  Error error_;
  std::exception_ptr exception_;
};

// Runs a stage on one frame. Returns false if no more frames shall follow.
bool RunStage(const Stage& stage, ClipFrame* frame, FirstFailure* failure) {
  try {
    const Result<bool> result = stage(frame);
    if (!result) failure->Set(frame->index, result.error(), nullptr);
    return result && *result;
  } catch (...) {
    // Exceptions, as of memory that runs out, must not leave a thread.
    failure->Set(frame->index, {}, std::current_exception());
    return false;
  }
}

// Runs a stage on all frames. `from` is null for the first stage, and `to` for the last stage.
void RunFrames(const Stage& stage, Handover* from, Handover* to, FirstFailure* failure) {
  for (size_t index = 0;; ++index) {
    FramePointer frame;
    if (from != nullptr) {
      frame = from->Take();
      if (frame == nullptr) break;
    } else {
      frame = std::make_unique<ClipFrame>();
      frame->index = index;
    }
    if (!RunStage(stage, frame.get(), failure)) break;
    if (to != nullptr && !to->Put(std::move(frame))) break;
  }
  if (from != nullptr) from->Stop();
  if (to != nullptr) to->End();
}

Error RunInTurn(const std::vector<Stage>& stages) {
  FirstFailure failure;
  for (size_t index = 0;; ++index) {
    ClipFrame frame;
    frame.index = index;
    for (const Stage& stage : stages) {
      if (!RunStage(stage, &frame, &failure)) return failure.Get();
    }
  }
}

}  // namespace

Error RunStages(const std::vector<Stage>& stages, bool overlap) {
  if (!overlap) return RunInTurn(stages);
  FirstFailure failure;
  std::vector<Handover> between(stages.size() - 1);
  std::vector<std::thread> threads;
  bool started = true;
  for (size_t s = 0; s < stages.size() && started; ++s) {
    Handover* const from = s > 0 ? &between[s - 1] : nullptr;
    Handover* const to = s + 1 < stages.size() ? &between[s] : nullptr;
    try {
      threads.emplace_back(
          [&stages, s, from, to, &failure] { RunFrames(stages[s], from, to, &failure); });
    } catch (const std::system_error&) {
      failure.Set(0, Cannot("start", "a thread for each stage", "the system has too few"), nullptr);
      if (from != nullptr) from->Stop();
      started = false;
    }
  }
  for (std::thread& thread : threads) thread.join();
  return failure.Get();
}

}  // namespace starfocus
