// SPDX-License-Identifier: Apache-2.0
// Transfers results from a helper process (helper.h) through a pipe. One function per type, Pass,
// describes both directions: in the helper the function sends the fields of a structure, and in the
// program the same function overwrites the fields with what arrives.
#ifndef STARFOCUS_PLATFORM_HELPER_CHANNEL_H_
#define STARFOCUS_PLATFORM_HELPER_CHANNEL_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "platform/gain_map.h"
#include "platform/image.h"
#include "platform/levels.h"
#include "platform/metadata.h"
#include "platform/pfm.h"
#include "platform/result.h"

namespace starfocus {

enum class Direction { kSend, kReceive };

// One end of a pipe. The receiver does not trust the sender: sizes are limited, control characters
// are removed from texts, and after the first wrong or missing byte the channel ignores all further
// calls.
class Channel {
 public:
  // Waits until a read does not block, or returns false to end the transfer. The argument is the
  // number of bytes that have been received since the last call.
  using Wait = std::function<bool(size_t received)>;

  // `file` is an open descriptor, which the caller closes. The receiver calls `wait` before each
  // read.
  Channel(int file, Direction direction, Wait wait = nullptr);
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  // Sends or receives a number, a truth value or an enumerator.
  template <class T>
  void Value(T* value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    Move(value, sizeof(T));
  }
  void Value(bool* value);

  // Sends or receives a vector or the bytes of a text, with at most `most` elements.
  template <class T>
  void Block(T* block, uint64_t most = kMostElements) {
    constexpr size_t kElement = sizeof(*block->data());
    const size_t count = Count(block->size(), most);
    // Receive in parts that fit into the cache, because the vector sets new elements to zero.
    for (size_t begin = 0; begin < count && is_sound_;) {
      const size_t end = std::min(count, begin + kPart / kElement);
      if (direction_ == Direction::kReceive) {
        if (begin == 0) {
          block->clear();
          block->reserve(count);
        }
        block->resize(end);
      }
      Move(block->data() + begin, (end - begin) * kElement);
      begin = end;
    }
    if (count == 0) block->clear();
  }

  // Sends or receives a text that programs print. Longer texts than 64 KiB are cut off.
  void Text(std::string* text);

  // Sends or receives a vector whose elements `pass(element)` passes. At most 1000.
  template <class T, class F>
  void List(std::vector<T>* list, F pass) {
    constexpr uint64_t kMostOfList = 1000;
    const size_t count = Count(list->size(), kMostOfList);
    if (direction_ == Direction::kReceive) list->assign(is_sound_ ? count : 0, T());
    for (T& element : *list) pass(&element);
  }

  // Ends the transfer unless `is_valid` is true.
  void Require(bool is_valid) { is_sound_ = is_sound_ && is_valid; }

  // Sends the content of the buffer.
  void Flush();

  // Returns true if all calls succeeded so far.
  bool is_sound() const { return is_sound_; }
  // Returns true if the sender has closed the pipe before the end of the transfer.
  bool is_closed() const { return is_closed_; }
  Direction direction() const { return direction_; }

 private:
  static constexpr size_t kPart = size_t{1} << 18;
  // Limit of a block of metadata. Pictures and maps have as many elements as their sizes state.
  static constexpr uint64_t kMostElements = uint64_t{1} << 30;

  void Move(void* data, size_t size);
  // Sends or receives a number of elements, and requires that it is at most `most`.
  size_t Count(size_t count, uint64_t most);
  void Write(const uint8_t* data, size_t size);
  void Read(uint8_t* data, size_t size);

  int file_;
  Direction direction_;
  Wait wait_;
  size_t received_ = 0;  // bytes since the last call of wait_
  bool is_sound_ = true, is_closed_ = false;
  std::vector<uint8_t> buffer_;  // small values that will be sent together
};

void Pass(Channel* channel, bool* value);
void Pass(Channel* channel, Image* image);
void Pass(Channel* channel, std::optional<DeepImage>* deep);
void Pass(Channel* channel, FloatMap* map);
void Pass(Channel* channel, GainMap* map);
void Pass(Channel* channel, ColourDescription* colours);
void Pass(Channel* channel, Metadata* metadata);
void Pass(Channel* channel, Samples* samples);
void Pass(Channel* channel, Error* error);

// Passes a value or an error.
template <class T>
void Pass(Channel* channel, Result<T>* result) {
  Error error = result->error();
  Pass(channel, &error);
  if (!error) {
    Pass(channel, &**result);
  } else if (channel->direction() == Direction::kReceive) {
    *result = error;
  }
}

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_HELPER_CHANNEL_H_
