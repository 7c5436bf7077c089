// SPDX-License-Identifier: Apache-2.0
// Fuzz target: the reader of light-field folders. The input selects the files and their contents.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "platform/light_field.h"
#include "tests/fuzz/input.h"
#include "tests/support/temp_folder.h"

namespace {

using starfocus::fuzz::Input;

constexpr const char* kExtensions[] = {".png", ".ppm", ".jpg"};

void Write(const std::string& path, const void* data, size_t size) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) std::abort();
  if (size != 0) std::fwrite(data, 1, size, file);
  std::fclose(file);
}

void Write(const std::string& path, std::string bytes, Input* input) {
  if (input->Rarely()) bytes.resize(bytes.size() / 2);
  Write(path, bytes.data(), bytes.size());
}

// Writes a valid picture of one colour, or bytes of the input.
void WriteView(const std::string& path, int side, Input* input) {
  if (input->Rarely()) {
    const size_t wanted = input->Value<uint8_t>(), size = std::min(wanted, input->size());
    Write(path, input->data(), size);
    input->Skip(size);
    return;
  }
  const std::string header = "P6 " + std::to_string(side) + " 2 255\n";
  const std::string pixels(static_cast<size_t>(6 * side), static_cast<char>(input->Int(0, 255)));
  Write(path, header + pixels, input);
}

void WriteMap(const std::string& path, int side, Input* input) {
  const std::string header = "Pf\n" + std::to_string(side) + " 2\n-1\n";
  Write(path, header + std::string(static_cast<size_t>(8 * side), '\0'), input);
}

// Returns the file name of a view of a star set, or of a view at any position. In a few cases, the
// name only starts like the name of a view. A position may be out of range or occur twice.
std::string NameOf(int view, Input* input) {
  if (!input->Rarely()) {
    return starfocus::ViewName(
        starfocus::StarPositions(STARFOCUS_MAX_VIEWS)[static_cast<size_t>(view)]);
  }
  if (!input->Rarely()) {
    return starfocus::ViewName({input->Int(-120, 120) / 100.0, input->Int(-10, 10) / 10.0});
  }
  constexpr char kLetters[] = "+-_.0123456789e";
  std::string name = "view_";
  for (int left = input->Int(1, 14); left > 0; --left) {
    name += kLetters[input->Value<uint8_t>() % (sizeof(kLetters) - 1)];
  }
  return name;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const starfocus::TempFolder folder;
  static const std::string map = starfocus::DisparityPath(folder.path());
  Input input(data, size);
  std::vector<std::string> written;
  const int side = input.Int(1, 4), views = input.Int(0, STARFOCUS_MAX_VIEWS);
  for (int view = 0; view < views; ++view) {
    if (input.Rarely()) continue;
    const char* extension = kExtensions[input.Rarely() ? input.Int(0, 2) : 1];
    written.push_back(folder.file(NameOf(view, &input) + extension));
    WriteView(written.back(), input.Rarely() ? input.Int(1, 4) : side, &input);
  }
  if (!input.Rarely()) {
    WriteMap(map, input.Rarely() ? input.Int(1, 4) : side, &input);
    written.push_back(map);
  }
  constexpr int kWanted[] = {0, 1, 5, 9, 17};
  const starfocus::Positions wanted = starfocus::StarPositions(kWanted[input.Int(0, 4)]);
  if (const auto field = starfocus::LoadLightField(folder.path(), wanted)) {
    const size_t loaded = field->views.size();
    if (loaded < 1 || loaded > STARFOCUS_MAX_VIEWS || field->positions.size() != loaded)
      std::abort();
    if (!wanted.empty() && loaded != wanted.size()) std::abort();
    for (const starfocus::Image& image : field->views) {
      if (image.width != field->width() || image.height != field->height()) std::abort();
    }
  }
  for (const std::string& path : written) unlink(path.c_str());
  return 0;
}
