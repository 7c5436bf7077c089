// SPDX-License-Identifier: Apache-2.0
// One call of a kernel, as kernels_bytes_test checks it and starfocus-bench-micro times it: the
// memory that the kernel works on, what it may do there, and how it is called.
#ifndef STARFOCUS_TESTS_SIMD_KERNEL_CALL_H_
#define STARFOCUS_TESTS_SIMD_KERNEL_CALL_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "simd/depth_kernels.h"
#include "simd/image_kernels.h"
#include "simd/kernels.h"
#include "tests/support/test_scene.h"

namespace test {

// Random numbers for a call. A call that is timed has one size and ordinary contents; one that is
// checked has any.
class Draw : public Random {
 public:
  static Draw ForTest(uint64_t seed, int round) { return {seed * 100003 + uint64_t(round), round}; }
  static Draw ForBench() { return {1, kTimed}; }

  bool timed() const { return round_ == kTimed; }

  // A size in [low, high]. The rounds of a test go through all of them, so that none is missed.
  size_t Length(int low, int high, int timed_size) const {
    return size_t(timed() ? timed_size : low + round_ % (high - low + 1));
  }
  // Any size in [low, high].
  size_t Size(int low, int high, int timed_size) {
    return size_t(timed() ? timed_size : Int(low, high));
  }
  // True once in `of` times; never when timed.
  bool Rarely(int of) { return !timed() && Int(1, of) == 1; }

 private:
  static constexpr int kTimed = -1;
  Draw(uint64_t seed, int round) : Random(seed), round_(round) {}

  int round_;
};

// Values that `make` returns one by one.
template <class T, class Make>
std::vector<T> Filled(size_t count, const Make& make) {
  std::vector<T> values(count);
  for (T& value : values) value = T(make());
  return values;
}

// Returns whether all of `count` results are right.
template <class IsRight>
bool AllRight(size_t count, const IsRight& is_right) {
  for (size_t n = 0; n < count; ++n) {
    if (!is_right(n)) return false;
  }
  return true;
}

// How often the calls of a kernel met something that they must meet.
using Met = std::map<std::string, int64_t>;

// The memory of a call.
class CallMemory {
 public:
  explicit CallMemory(Draw* draw) : random_(draw->Next()) {}
  CallMemory(const CallMemory&) = delete;
  CallMemory& operator=(const CallMemory&) = delete;

  // The values in memory of their own, in which no kernel may write. `padding` bytes follow, which
  // may hold anything; memory ends behind them, so that the sanitizers notice who reads on.
  template <class T>
  T* Input(const char* name, const std::vector<T>& values, size_t padding = 0) {
    T* first = Add<T>(name, values.size(), 0, padding, Role::kIgnored);
    std::copy(values.begin(), values.end(), first);
    Mark(first, values.size(), Role::kInput);
    return first;
  }
  // Says that no result depends on these values of an input.
  template <class T>
  void Ignore(const T* first, size_t count) {
    Mark(first, count, Role::kIgnored);
  }
  template <class T>
  void IgnoreRows(const T* first, size_t rows, size_t stride, size_t count) {
    for (size_t y = 0; y < rows; ++y) Ignore(first + y * stride, count);
  }

  // Room for `count` values, which hold anything, between wide margins. Kernels must leave all of
  // it as it is but for what Result and Free allow.
  template <class T>
  T* Output(const char* name, size_t count) {
    return Add<T>(name, count, kMargin, kMargin, Role::kUntouched);
  }
  // Says that the kernel determines these values of an output.
  template <class T>
  void Result(const T* first, size_t count) {
    Mark(first, count, Role::kResult);
  }
  // Room for values all of which the kernel determines, but for `free` more behind them.
  template <class T>
  T* Results(const char* name, size_t count, size_t free = 0) {
    T* first = Output<T>(name, count + free);
    ResultRows(first, 1, 0, count, free);
    return first;
  }
  // Marks rows of `count` results that lie `stride` apart, and of `free` values behind each row.
  template <class T>
  void ResultRows(const T* first, size_t rows, size_t stride, size_t count, size_t free = 0) {
    for (size_t y = 0; y < rows; ++y) {
      Result(first + y * stride, count);
      Free(first + y * stride + count, free);
    }
  }
  // Says that the kernel may leave anything there.
  template <class T>
  void Free(const T* first, size_t count) {
    Mark(first, count, Role::kFree);
  }

  // Optional: looks at the results of the reference, which returned that, and tells
  // whether they are right by the kernel's contract; may free what the contract leaves open then.
  std::function<bool(uint64_t returned, Met*)> is_right;

  // Bytes that a call reads and writes, each counted once.
  size_t Bytes() const;

 protected:
  // A table's name, and the call of its kernel.
  struct NamedRun {
    const char* name;
    std::function<uint64_t()> run;
  };

  // Runs the reference, and then the others on the same memory. Returns the first thing that is
  // wrong, or nothing. To be called once.
  std::string CheckRuns(const NamedRun& reference, const std::vector<NamedRun>& others, Met* met);

 private:
  enum class Role : uint8_t { kUntouched, kInput, kIgnored, kResult, kFree };

  struct Region {
    const char* name;
    size_t value_size, first, size;  // bytes; `first` is that of the first value
    std::unique_ptr<uint8_t[]> bytes;
    std::vector<Role> roles;  // of the bytes
    std::vector<uint8_t> before, expected;
  };

  static constexpr size_t kMargin = 256;  // bytes: more than the widest vector that padding allows

  template <class T>
  T* Add(const char* name, size_t count, size_t before, size_t behind, Role role) {
    static_assert(std::is_trivially_copyable<T>::value && kMargin % alignof(T) == 0,
                  "plain values");
    // Kernels may not rely on more alignment than that of the type.
    before += alignof(T) * size_t(random_.Int(0, 7));
    const size_t size = before + count * sizeof(T) + behind;
    return reinterpret_cast<T*>(AddRegion(name, sizeof(T), before, size, role) + before);
  }
  template <class T>
  void Mark(const T* first, size_t count, Role role) {
    MarkBytes(reinterpret_cast<const uint8_t*>(first), count * sizeof(T), role);
  }

  uint8_t* AddRegion(const char* name, size_t value_size, size_t first, size_t size, Role role);
  void MarkBytes(const uint8_t* first, size_t size, Role role);
  std::string Compare(const std::string& who) const;

  Random random_;
  std::vector<Region> regions_;
};

// A call of a kernel of some kind of table.
template <class Table>
class CallOf : public CallMemory {
 public:
  using CallMemory::CallMemory;

  // Calls the kernel of that table and returns what it returns.
  std::function<uint64_t(const Table&)> run;

  // Sets `run` to what calls a kernel that returns nothing.
  template <class Call>
  void Runs(const Call& call) {
    run = [=](const Table& table) {
      call(table);
      return uint64_t{0};
    };
  }

  // Checks the kernels of each table against those of the reference.
  std::string Check(const Table& reference, const std::vector<const Table*>& tables, Met* met) {
    const auto of = [this](const Table& table) {
      return NamedRun{table.name, [this, &table] { return run(table); }};
    };
    std::vector<NamedRun> others;
    for (const Table* table : tables) others.push_back(of(*table));
    return CheckRuns(of(reference), others, met);
  }
};

using KernelCall = CallOf<starfocus::simd::Kernels>;
using DepthCall = CallOf<starfocus::simd::DepthKernels>;
using ImageCall = CallOf<starfocus::simd::ImageKernels>;

}  // namespace test

#endif  // STARFOCUS_TESTS_SIMD_KERNEL_CALL_H_
