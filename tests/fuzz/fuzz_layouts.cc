// SPDX-License-Identifier: Apache-2.0
// Fuzz target: folders of views. The lines of the input are the names of pictures, and the contents
// of text files next to the pictures.
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "platform/icc_profile.h"
#include "platform/readers/jpeg_parts.h"
#include "platform/readers/key_values.h"
#include "platform/readers/multi_picture.h"
#include "platform/readers/view_array.h"
#include "tests/fuzz/input.h"

namespace {

void CheckArray(const std::string& text) {
  std::vector<std::string> names(1);
  for (const char c : text) {
    if (c == '\n') {
      names.emplace_back();
    } else {
      names.back() += c;
    }
  }
  const auto array = starfocus::FindArray("folder", names);
  if (!array || array->paths.empty()) return;
  if (array->paths.size() != size_t(array->rows) * size_t(array->columns)) std::abort();
  starfocus::Facts facts;
  const auto star = starfocus::ChooseStar("folder", *array, &facts);
  if (!star) return;
  if (star->views.empty() || star->views.size() > STARFOCUS_MAX_VIEWS) std::abort();
  if (star->views[0].position.u != 0 || star->views[0].position.v != 0) std::abort();
  for (const starfocus::ViewFile& view : star->views) {
    if (view.position.u < -1 || view.position.u > 1) std::abort();
    if (view.position.v < -1 || view.position.v > 1) std::abort();
  }
}

// Reads the segments and indices of a JPEG file without decoding a picture.
void CheckParts(const uint8_t* data, size_t size) {
  const auto read = starfocus::ReadJpegParts("photo", {data, size});
  if (!read) return;
  const starfocus::JpegParts& parts = *read;
  if (parts.end > size) std::abort();
  const starfocus::MultiPictures listed = starfocus::ListMultiPictures(
      {data, size}, parts, starfocus::ListAppendedPictures({data, size}, parts.end));
  for (const starfocus::MultiPicture& picture : listed.pictures) {
    const starfocus::Span& file = picture.file;
    if (file.data < data + parts.end || file.data + file.size > data + size) std::abort();
    if (file.size != picture.parts.end) std::abort();
  }
  if (!parts.metadata.icc.empty() && !starfocus::IsRgbProfile(parts.metadata.icc)) std::abort();
  if (parts.metadata.iptc.size() > size) std::abort();
  if (!parts.extensions.empty()) {
    const auto text = starfocus::JoinExtensions("photo", parts, parts.extensions[0].guid);
    if (text && text->size() > size) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 1) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] == 'n') CheckArray(text);
  if (data[0] == 0xff) CheckParts(data, size);
  if (data[0] != 'k') return 0;
  const starfocus::KeyValues values = starfocus::ParseKeyValues(text);
  for (const auto& value : values) starfocus::NumberOf(values, value.first);
  return 0;
}
