// SPDX-License-Identifier: Apache-2.0
#include "platform/helper/channel.h"

#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "platform/text.h"

namespace starfocus {
namespace {

constexpr int64_t kMostPixels = int64_t{1} << 28;  // the limit of all decoders
constexpr size_t kMostText = 65536;
// Values of at least this size are sent without a copy to the buffer.
constexpr size_t kLargeValue = 4096;
constexpr size_t kBuffer = 65536;

// Sends a part of the data, and returns its size, or -1 on failure.
ssize_t Send(int file, const uint8_t* data, size_t size) {
#ifdef __linux__
  // Pass the pages of large data without copying them. The helper process does not change a result
  // that it sends.
  if (size > kBuffer) {
    const iovec pages = {const_cast<uint8_t*>(data), size};
    return vmsplice(file, &pages, 1, 0);
  }
#endif
  return write(file, data, size);
}

// Passes a picture or a map with `samples` samples for each pixel. The size is checked before
// memory for the samples is allocated.
template <class Values>
void PassPixels(Channel* channel, int* width, int* height, size_t samples, Values* values) {
  channel->Value(width);
  channel->Value(height);
  const int64_t pixels = int64_t{*width} * *height;
  channel->Require(*width >= 0 && *height >= 0 && (*width == 0) == (*height == 0) &&
                   *width <= kMaxPictureSize && *height <= kMaxPictureSize &&
                   pixels <= kMostPixels);
  if (!channel->is_sound()) return;
  const size_t count = static_cast<size_t>(pixels) * samples;
  channel->Block(values, count);
  channel->Require(values->size() == count);
}

}  // namespace

Channel::Channel(int file, Direction direction, Wait wait)
    : file_(file), direction_(direction), wait_(std::move(wait)) {
  if (direction == Direction::kSend) buffer_.reserve(kBuffer + kLargeValue);
}

void Channel::Value(bool* value) {
  uint8_t byte = *value ? 1 : 0;
  Move(&byte, 1);
  *value = byte != 0;
}

void Channel::Text(std::string* text) {
  if (text->size() > kMostText) text->resize(kMostText);
  Block(text, kMostText);
  if (direction_ == Direction::kReceive) *text = Printable(std::move(*text));
}

size_t Channel::Count(size_t count, uint64_t most) {
  uint64_t number = count;
  Value(&number);
  Require(number <= most);
  return is_sound_ ? static_cast<size_t>(number) : 0;
}

void Channel::Move(void* data, size_t size) {
  auto* const bytes = static_cast<uint8_t*>(data);
  if (direction_ == Direction::kReceive) return Read(bytes, size);
  if (size >= kLargeValue) {
    Flush();
    return Write(bytes, size);
  }
  buffer_.insert(buffer_.end(), bytes, bytes + size);
  if (buffer_.size() >= kBuffer) Flush();
}

void Channel::Flush() {
  Write(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void Channel::Write(const uint8_t* data, size_t size) {
  while (size > 0 && is_sound_) {
    const ssize_t sent = Send(file_, data, size);
    if (sent < 0 && errno == EINTR) continue;
    Require(sent > 0);
    if (!is_sound_) return;
    data += sent;
    size -= static_cast<size_t>(sent);
  }
}

void Channel::Read(uint8_t* data, size_t size) {
  while (size > 0 && is_sound_) {
    Require(wait_(received_));
    received_ = 0;
    if (!is_sound_) return;
    const ssize_t got = read(file_, data, size);
    if (got < 0 && errno == EINTR) continue;
    is_closed_ = got == 0;
    Require(got > 0);
    if (!is_sound_) return;
    received_ = static_cast<size_t>(got);
    data += got;
    size -= received_;
  }
}

// The structured bindings below fail to compile if a structure gets another field.
void Pass(Channel* channel, bool* value) { channel->Value(value); }

void Pass(Channel* channel, Image* image) {
  auto& [width, height, pixels] = *image;
  PassPixels(channel, &width, &height, 3, &pixels);
}

void Pass(Channel* channel, std::optional<DeepImage>* deep) {
  bool has_deep = deep->has_value();
  channel->Value(&has_deep);
  if (!has_deep) return deep->reset();
  if (channel->direction() == Direction::kReceive) deep->emplace();
  auto& [width, height, channels, is_half, bits, is_multiplied, transfer, samples] = **deep;
  channel->Value(&channels);
  channel->Value(&is_half);
  channel->Value(&is_multiplied);
  channel->Value(&bits);
  channel->Require(bits >= 8 && bits <= 32);
  channel->Value(&transfer);
  channel->Require(channels == 3 || channels == 4);
  channel->Require(transfer >= STARFOCUS_TRANSFER_SRGB && transfer <= STARFOCUS_TRANSFER_HLG);
  PassPixels(channel, &width, &height, static_cast<size_t>(channels), &samples);
}

void Pass(Channel* channel, FloatMap* map) {
  auto& [width, height, values] = *map;
  PassPixels(channel, &width, &height, 1, &values);
}

void Pass(Channel* channel, GainMap* map) {
  auto& [width, height, channels, levels, format, min, max, gamma, offset_sdr, offset_hdr,
         capacity_min, capacity_max] = *map;
  channel->Value(&channels);
  channel->Require(channels == 1 || channels == 3);
  if (!channel->is_sound()) return;
  PassPixels(channel, &width, &height, static_cast<size_t>(channels), &levels);
  channel->Text(&format);
  for (std::array<double, 3>* values : {&min, &max, &gamma, &offset_sdr, &offset_hdr}) {
    for (double& value : *values) channel->Value(&value);
  }
  for (double* value : {&capacity_min, &capacity_max}) channel->Value(value);
  channel->Require(levels.empty() || !CheckGainMap("", *map));
}

void Pass(Channel* channel, ColourDescription* colours) {
  auto& [form, primaries, transfer, full_range, chromaticities, gamma] = *colours;
  channel->Text(&form);
  channel->Value(&primaries);
  channel->Value(&transfer);
  for (const int code : {primaries, transfer}) {
    channel->Require(code >= 0 && code <= ColourDescription::kAdobeRgb);
  }
  channel->Value(&full_range);
  for (int32_t& value : chromaticities) channel->Value(&value);
  channel->Value(&gamma);
}

void Pass(Channel* channel, Metadata* metadata) {
  auto& [exif, icc, iptc, xmp, colours] = *metadata;
  for (Bytes* block : {&exif, &icc, &iptc}) channel->Block(block);
  channel->Block(&xmp);
  Pass(channel, &colours);
}

void Pass(Channel* channel, Samples* samples) {
  auto& [map, largest, is_wide, is_alpha, larger_is_nearer] = *samples;
  Pass(channel, &map);
  channel->Value(&largest);
  for (bool* value : {&is_wide, &is_alpha, &larger_is_nearer}) channel->Value(value);
  channel->Require(largest >= 0 && largest <= 65535);
}

void Pass(Channel* channel, Error* error) {
  ErrorKind kind = error->kind();
  std::string line = error->line();
  channel->Value(&kind);
  channel->Text(&line);
  channel->Require(kind >= ErrorKind::kNone && kind <= ErrorKind::kInternal);
  if (channel->direction() == Direction::kReceive) *error = Error(kind, line);
}

}  // namespace starfocus
