// SPDX-License-Identifier: Apache-2.0
// One call of a kernel: the memory, the permitted accesses, and the call itself. kernels_bytes_test
// checks the results of kernel calls, and starfocus-bench-micro measures their time.
#ifndef STARFOCUS_TESTS_KERNELS_KERNEL_CALL_H_
#define STARFOCUS_TESTS_KERNELS_KERNEL_CALL_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "simd/kernels.h"
#include "tests/support/test_scene.h"

namespace test {

// Random numbers for the arguments of a kernel call. A timed call has one size and typical
// contents. A checked call has any size and contents.
class Draw : public Random {
 public:
  static Draw ForTest(uint64_t seed, int round) { return {seed * 100003 + uint64_t(round), round}; }
  static Draw ForBench() { return {1, kTimed}; }

  bool timed() const { return round_ == kTimed; }

  // Returns a size in [low, high]. Successive rounds of a test use all sizes in turn.
  size_t Length(int low, int high, int timed_size) const {
    return size_t(timed() ? timed_size : low + round_ % (high - low + 1));
  }
  // Returns a random size in [low, high].
  size_t Size(int low, int high, int timed_size) {
    return size_t(timed() ? timed_size : Int(low, high));
  }
  // Returns true with a probability of 1 / `of`. For a timed kernel call, always returns false.
  bool Rarely(int of) { return !timed() && Int(1, of) == 1; }

 private:
  static constexpr int kTimed = -1;
  Draw(uint64_t seed, int round) : Random(seed), round_(round) {}

  int round_;
};

// Returns a vector filled by calling `make` for each value.
template <class T, class Make>
std::vector<T> Filled(size_t count, const Make& make) {
  std::vector<T> values(count);
  for (T& value : values) value = T(make());
  return values;
}

// Returns a vector of random integers in [low, high].
template <class T>
std::vector<T> Ints(size_t count, int low, int high, Draw* draw) {
  return Filled<T>(count, [&] { return draw->Int(low, high); });
}

// Returns true if is_right(n) is true for all n below `count`.
template <class IsRight>
bool AllRight(size_t count, const IsRight& is_right) {
  for (size_t n = 0; n < count; ++n) {
    if (!is_right(n)) return false;
  }
  return true;
}

// Number of kernel calls or values for each situation that the random calls must produce.
using Met = std::map<std::string, int64_t>;

// Memory that a kernel call reads and writes.
class CallMemory {
 public:
  explicit CallMemory(Draw* draw) : random_(draw->Next()) {}
  CallMemory(const CallMemory&) = delete;
  CallMemory& operator=(const CallMemory&) = delete;

  // Copies the values to separate memory, which kernels must not change. `padding` arbitrary bytes
  // follow the values. The memory ends after the padding, so that sanitizers detect reads past the
  // end.
  template <class T>
  T* Input(const char* name, const std::vector<T>& values, size_t padding = 0) {
    T* first = Add<T>(name, values.size(), 0, padding, Role::kIgnored);
    std::copy(values.begin(), values.end(), first);
    Mark(first, values.size(), Role::kInput);
    return first;
  }
  // Marks input values that must not affect any result.
  template <class T>
  void Ignore(const T* first, size_t count) {
    Mark(first, count, Role::kIgnored);
  }
  template <class T>
  void IgnoreRows(const T* first, size_t rows, size_t stride, size_t count) {
    for (size_t y = 0; y < rows; ++y) Ignore(first + y * stride, count);
  }

  // Allocates `count` arbitrary values between wide margins. Kernels may change only the values
  // that Result and Free mark.
  template <class T>
  T* Output(const char* name, size_t count) {
    return Add<T>(name, count, kMargin, kMargin, Role::kUntouched);
  }
  // Marks output values that must equal the values of the reference.
  template <class T>
  void Result(const T* first, size_t count) {
    Mark(first, count, Role::kResult);
  }
  // Allocates `count` results, which must equal the reference, followed by `free` values that the
  // kernel may change.
  template <class T>
  T* Results(const char* name, size_t count, size_t free = 0) {
    T* first = Output<T>(name, count + free);
    ResultRows(first, 1, 0, count, free);
    return first;
  }
  // Marks rows of `count` results, `stride` apart, and `free` changeable values after each row.
  template <class T>
  void ResultRows(const T* first, size_t rows, size_t stride, size_t count, size_t free = 0) {
    for (size_t y = 0; y < rows; ++y) {
      Result(first + y * stride, count);
      Free(first + y * stride + count, free);
    }
  }
  // Allocates rows of results, as ResultRows marks them. The last row ends after `count` results
  // and `free` values.
  template <class T>
  T* OutputRows(const char* name, size_t rows, size_t stride, size_t count, size_t free = 0) {
    T* first = Output<T>(name, (rows - 1) * stride + count + free);
    ResultRows(first, rows, stride, count, free);
    return first;
  }
  // Marks output values that the kernel may set to anything.
  template <class T>
  void Free(const T* first, size_t count) {
    Mark(first, count, Role::kFree);
  }

  // Optional. Returns true if the output of the reference and its return value `returned` fulfil
  // the contract of the kernel. The function may call Free for output values that the contract does
  // not define.
  std::function<bool(uint64_t returned, Met*)> is_right;

  // Returns the number of bytes that a kernel call reads and writes, each counted once.
  size_t Bytes() const;

 protected:
  // Name of a kernel table, and a function that calls the kernel in this table.
  struct NamedRun {
    const char* name;
    std::function<uint64_t()> run;
  };

  // Runs the reference kernel, and then each of `others` on equal input in the same memory. Returns
  // the first error, or an empty string. CheckRuns may be called only once.
  std::string CheckRuns(const NamedRun& reference, const std::vector<NamedRun>& others, Met* met);

 private:
  enum class Role : uint8_t { kUntouched, kInput, kIgnored, kResult, kFree };

  struct Region {
    const char* name;
    size_t value_size, first, size;  // Sizes in bytes, and the offset of the first value in bytes.
    std::unique_ptr<uint8_t[]> bytes;
    std::vector<Role> roles;  // Role of each byte.
    std::vector<uint8_t> before, expected;
  };

  // Margin in bytes, which is larger than the widest vector.
  static constexpr size_t kMargin = 256;

  template <class T>
  T* Add(const char* name, size_t count, size_t before, size_t behind, Role role) {
    static_assert(std::is_trivially_copyable<T>::value && kMargin % alignof(T) == 0,
                  "plain values");
    // The values start at a random offset, since kernels may rely only on the alignment of the
    // type.
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

// A call to a kernel in a table of type `Table` (Kernels, DepthKernels, ImageKernels,
// LineScanKernels, VideoKernels or WordKernels).
template <class Table>
class CallOf : public CallMemory {
 public:
  using CallMemory::CallMemory;

  // Calls the kernel of the given table, and returns the result of the kernel.
  std::function<uint64_t(const Table&)> run;

  // Sets `run` to a call of a kernel that returns nothing.
  template <class Call>
  void Runs(const Call& call) {
    run = [=](const Table& table) {
      call(table);
      return uint64_t{0};
    };
  }

  // Sets `run` to calls of a kernel that returns nothing, for each index below `count`.
  template <class Call>
  void RunsEach(size_t count, const Call& call) {
    Runs([=](const Table& table) {
      for (size_t n = 0; n < count; ++n) call(table, n);
    });
  }

  // Sets `run` to a call of `kernel` with copies of the arguments.
  template <class Result, class... Parameters, class... Arguments>
  void Calls(Result (*Table::*kernel)(Parameters...), const Arguments&... arguments) {
    run = [=](const Table& table) -> uint64_t {
      if constexpr (std::is_void_v<Result>) {
        (table.*kernel)(arguments...);
        return 0;
      } else {
        return uint64_t((table.*kernel)(arguments...));
      }
    };
  }

  // Compares the kernel of each table in `tables` with the reference kernel.
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
using LineScanCall = CallOf<starfocus::simd::LineScanKernels>;
using VideoCall = CallOf<starfocus::simd::VideoKernels>;
using WordCall = CallOf<starfocus::simd::WordKernels>;

}  // namespace test

#endif  // STARFOCUS_TESTS_KERNELS_KERNEL_CALL_H_
