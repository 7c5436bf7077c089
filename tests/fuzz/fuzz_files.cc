// SPDX-License-Identifier: Apache-2.0
// Three fuzz targets of files that a decoder of photos does not read: `files` for maps in PFM, NPY,
// NPZ and TIFF, pictures in PNG, PPM and JPEG, Y4M streams, and small texts; `folder` for
// light-field folders, whose files and contents the input selects; and `layouts` for the names of
// views and the texts beside them, and for the segments of JPEG files. Each target is built from
// this file with its name in STARFOCUS_FUZZ_TARGET.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "platform/container.h"
#include "platform/depth_file.h"
#include "platform/icc_profile.h"
#include "platform/image_io.h"
#include "platform/levels.h"
#include "platform/light_field.h"
#include "platform/pfm.h"
#include "platform/readers/jpeg_parts.h"
#include "platform/readers/key_values.h"
#include "platform/readers/multi_picture.h"
#include "platform/readers/view_array.h"
#include "platform/y4m.h"
#include "tests/fuzz/input.h"
#include "tests/support/temp_folder.h"

namespace starfocus::fuzz {
namespace {

// Checks the number of values of a map.
template <class Map>
void CheckSize(const Map& map) {
  Must(map.values.size() == size_t(map.width) * size_t(map.height));
}

// A file in memory, and a path that opens this file.
class MemoryFile {
 public:
  MemoryFile(const uint8_t* data, size_t size) : handle_(memfd_create("fuzz", 0)) {
    if (handle_ < 0 || write(handle_, data, size) != static_cast<ssize_t>(size)) std::abort();
  }
  ~MemoryFile() { close(handle_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(handle_); }

 private:
  int handle_;
};

void CheckFile(const uint8_t* data, size_t size) {
  const MemoryFile file(data, size);
  if (const auto map = ReadPfm(file.path())) CheckSize(*map);
  const auto small = ReadSmallFile(file.path());
  Must(bool(small) == (size <= kMostSmallBytes) && (!small || small->size() == size));
  Must(!DescribeFile(*small).empty());
  const auto image = ReadImage(file.path());
  Must(!image || image->pixels.size() == image->stride() * size_t(image->height));
  const starfocus::Bytes bytes(data, data + size);
  if (const auto levels = DecodeLevels("levels", bytes)) {
    CheckSize(*levels);
    for (const float level : levels->values) Must(!(level < 0) && !(level > 1));
  }
  Y4mReader stream;
  starfocus::Bytes planes;
  bool has_frame = !stream.Open(file.path());
  while (has_frame) {
    const auto has = stream.Next(&planes);
    has_frame = has && *has;
    if (!has_frame) break;
    const PlanarImage planar = ToPlanar(stream.header(), planes);
    Must(EncodeY4mFrame(stream.header().Written(), planar).size() > planar.luma_samples());
    Must(Narrow(planar).samples.size() <= planar.samples.size());
  }
  const auto depth = DecodeDepthFile("depth", Alpha::kTransparent, bytes);
  if (depth) CheckSize(depth->map);
  if (const auto samples = DecodeSamples("coverage", Alpha::kTaken, bytes)) {
    const auto largest = static_cast<float>(samples->largest);
    for (const float sample : samples->map.values) Must(sample >= 0 && sample <= largest);
  }
}

constexpr const char* kExtensions[] = {".png", ".ppm", ".jpg"};

void Write(const std::string& path, const std::string& bytes) {
  Must(bool(std::ofstream(path, std::ios::binary) << bytes));
}

// Writes the whole file, or its first half.
void Write(const std::string& path, const std::string& bytes, Input* input) {
  Write(path, bytes.substr(0, bytes.size() / (input->Rarely() ? 2 : 1)));
}

// Writes a valid picture of one colour, or bytes of the input.
void WriteView(const std::string& path, int side, Input* input) {
  if (input->Rarely()) {
    const size_t wanted = input->Value<uint8_t>(), size = std::min(wanted, input->size());
    const std::string bytes(reinterpret_cast<const char*>(input->data()), size);
    input->Skip(size);
    return Write(path, bytes);
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
    return ViewName(StarPositions(STARFOCUS_MAX_VIEWS)[static_cast<size_t>(view)]);
  }
  if (!input->Rarely()) {
    return ViewName({input->Int(-120, 120) / 100.0, input->Int(-10, 10) / 10.0});
  }
  constexpr char kLetters[] = "+-_.0123456789e";
  std::string name = "view_";
  for (int left = input->Int(1, 14); left > 0; --left) {
    name += kLetters[input->Value<uint8_t>() % (sizeof(kLetters) - 1)];
  }
  return name;
}

void CheckFolder(const uint8_t* data, size_t size) {
  static const TempFolder folder;
  static const std::string map = DisparityPath(folder.path());
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
  const Positions wanted = StarPositions(kWanted[input.Int(0, 4)]);
  if (const auto field = LoadLightField(folder.path(), wanted)) {
    const size_t loaded = field->views.size();
    Must(loaded >= 1 && loaded <= STARFOCUS_MAX_VIEWS && field->positions.size() == loaded);
    Must(wanted.empty() || loaded == wanted.size());
    for (const Image& image : field->views) {
      Must(image.width == field->width() && image.height == field->height());
    }
  }
  for (const std::string& path : written) unlink(path.c_str());
}

void CheckArray(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream lines(text);
  for (std::string name; std::getline(lines, name);) names.push_back(name);
  const auto array = FindArray("folder", names);
  if (!array || array->paths.empty()) return;
  Must(array->paths.size() == size_t(array->rows) * size_t(array->columns));
  Facts facts;
  const auto star = ChooseStar("folder", *array, &facts);
  if (!star) return;
  Must(!star->views.empty() && star->views.size() <= STARFOCUS_MAX_VIEWS);
  Must(star->views[0].position.u == 0 && star->views[0].position.v == 0);
  for (const ViewFile& view : star->views) {
    for (const double at : {view.position.u, view.position.v}) Must(at >= -1 && at <= 1);
  }
}

// Reads the segments and indices of a JPEG file without decoding a picture.
void CheckParts(const uint8_t* data, size_t size) {
  const auto read = ReadJpegParts("photo", {data, size});
  if (!read) return;
  const JpegParts& parts = *read;
  Must(parts.end <= size);
  const MultiPictures listed =
      ListMultiPictures({data, size}, parts, ListAppendedPictures({data, size}, parts.end));
  for (const MultiPicture& picture : listed.pictures) {
    const Span& file = picture.file;
    Must(file.data >= data + parts.end && file.data + file.size <= data + size);
    Must(file.size == picture.parts.end);
  }
  Must(parts.metadata.icc.empty() || IsRgbProfile(parts.metadata.icc));
  Must(parts.metadata.iptc.size() <= size);
  if (parts.extensions.empty()) return;
  const auto text = JoinExtensions("photo", parts, parts.extensions[0].guid);
  Must(!text || text->size() <= size);
}

void CheckLayout(const uint8_t* data, size_t size) {
  if (size < 1) return;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] == 'n') CheckArray(text);
  if (data[0] == 0xff) CheckParts(data, size);
  if (data[0] != 'k') return;
  const KeyValues values = ParseKeyValues(text);
  for (const auto& value : values) NumberOf(values, value.first);
}

}  // namespace
}  // namespace starfocus::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  constexpr std::string_view kTarget = STARFOCUS_FUZZ_TARGET;
  if (kTarget == "files") starfocus::fuzz::CheckFile(data, size);
  if (kTarget == "folder") starfocus::fuzz::CheckFolder(data, size);
  if (kTarget == "layouts") starfocus::fuzz::CheckLayout(data, size);
  return 0;
}
