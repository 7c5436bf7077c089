// SPDX-License-Identifier: Apache-2.0
// Decodes OpenEXR with the C++ functions of OpenEXR. The C functions of OpenEXR 3.1 decode no DWA,
// and decode channels of 32 bits wrongly if they are compressed by B44.
#include "platform/decoders/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "platform/decoders/exr_header.h"
#include "platform/decoders/limits.h"
#include "platform/deep_image.h"

namespace starfocus {
namespace {

// A file in memory that OpenEXR reads.
class ExrInput : public Imf::IStream {
 public:
  explicit ExrInput(const Bytes& bytes) : Imf::IStream("picture"), bytes_(bytes) {}

  bool read(char* to, int count) override {
    const uint64_t size = static_cast<uint64_t>(std::max(count, 0));
    if (at_ > bytes_.size() || size > bytes_.size() - at_) {
      throw std::runtime_error("the file ends too early");
    }
    if (size > 0) std::memcpy(to, bytes_.data() + at_, static_cast<size_t>(size));
    at_ += size;
    return at_ < bytes_.size();
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t at) override { at_ = at; }

 private:
  const Bytes& bytes_;
  uint64_t at_ = 0;
};

// Returns the result of `decode`, which calls functions of OpenEXR that throw exceptions.
template <class T, class Decode>
Result<T> CatchExr(const std::string& where, const Bytes& exr, Decode decode) {
  if (!VisitExrAttributes(exr.data(), exr.size(),
                          [](const std::string&, const uint8_t*, size_t) {})) {
    return Expected(where, "an undamaged OpenEXR file", "a damaged one (its header)");
  }
  try {
    return decode();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    return Expected(where, "an undamaged OpenEXR file",
                    std::string("a damaged or unusual one (") + failure.what() + ")");
  }
}

std::string Lower(std::string text) {
  for (char& letter : text) {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return text;
}

// A channel of a part. The name of a channel is a layer, a dot, and a last word: "rgba.R".
struct ExrChannel {
  int part;
  std::string part_name, name, layer, last;
  bool is_right;  // true if it belongs to the right view of a stereo pair
};

bool StartsWithWord(const std::string& text, const char* word) {
  return Lower(text).rfind(word, 0) == 0;
}

// Lists the channels of all parts of pixels, which are not deep data.
std::vector<ExrChannel> ListChannels(const Imf::MultiPartInputFile& file) {
  std::vector<ExrChannel> list;
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    if (header.hasType() && !Imf::isImage(header.type())) continue;
    const std::string name = header.hasName() ? header.name() : "",
                      view = header.hasView() ? header.view() : "";
    for (auto at = header.channels().begin(); at != header.channels().end(); ++at) {
      ExrChannel channel = {part, name, at.name(), "", "", false};
      const size_t dot = channel.name.rfind('.');
      channel.last = dot == std::string::npos ? channel.name : channel.name.substr(dot + 1);
      if (dot != std::string::npos) channel.layer = channel.name.substr(0, dot);
      const std::string names = Lower(channel.part_name + " " + channel.layer + " " + view);
      channel.is_right = names.find("right") != std::string::npos;
      list.push_back(std::move(channel));
    }
  }
  return list;
}

std::string NamesOf(const std::vector<ExrChannel>& channels) {
  std::string text;
  for (const ExrChannel& channel : channels) {
    text += (text.empty() ? "" : ", ") + channel.name;
  }
  return text.empty() ? "no channels of pixels" : "the channels " + text;
}

// Position of a part on the display window, whose upper left pixel is at (0, 0).
struct ExrWindow {
  int left = 0, top = 0, width = 0, height = 0;  // of the stored pixels
  int display_width = 0, display_height = 0;
};

// Properties of a compression: an upper bound of the bytes to which a byte of the file expands, and
// the rows of a chunk. Deflate expands a byte to at most 1032 bytes, and the codes of PIZ and B44
// expand less. DWA stores a block of 8x8 half floats in at least 2 bytes before Deflate.
struct ExrCompression {
  uint64_t most_expansion;
  int rows;
};
ExrCompression PropertiesOf(Imf::Compression compression) {
  constexpr uint64_t kDeflate = 1032;
  switch (compression) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
      return {kDeflate, 1};
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return {kDeflate, 16};
    case Imf::DWAA_COMPRESSION:
      return {64 * kDeflate, 32};
    case Imf::DWAB_COMPRESSION:
      return {64 * kDeflate, 256};
    default:
      return {kDeflate, 32};
  }
}

// Returns the bytes of all channels of a pixel, or 0 if a channel has fewer samples than pixels.
uint64_t BytesOfPixel(const Imf::Header& header) {
  uint64_t bytes = 0;
  for (auto at = header.channels().begin(); at != header.channels().end(); ++at) {
    const Imf::Channel& channel = at.channel();
    if (channel.xSampling != 1 || channel.ySampling != 1) return 0;
    bytes += channel.type == Imf::HALF ? 2 : 4;
  }
  return bytes;
}

// Returns the windows of a part, whose sizes are limited to what the file can contain. OpenEXR has
// read only the headers so far.
Result<ExrWindow> ReadWindow(const std::string& where, const Imf::Header& header, size_t bytes) {
  const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
  const auto side = [](int first, int last) { return int64_t{last} - first + 1; };
  const int64_t width = side(data.min.x, data.max.x), height = side(data.min.y, data.max.y),
                display_width = side(display.min.x, display.max.x),
                display_height = side(display.min.y, display.max.y);
  if (Error error = CheckPictureSize(where, display_width, display_height)) return error;
  if (Error error = CheckPictureSize(where, width, height)) return error;
  const uint64_t pixel = BytesOfPixel(header);
  if (pixel == 0) {
    return Expected(where, "channels with a sample for each pixel", "a channel with fewer");
  }
  const ExrCompression compression = PropertiesOf(header.compression());
  const auto stored = static_cast<uint64_t>(width * height),
             shown = static_cast<uint64_t>(display_width * display_height);
  uint64_t chunk = static_cast<uint64_t>(width) * static_cast<uint64_t>(compression.rows);
  if (header.hasTileDescription()) {
    const Imf::TileDescription& tile = header.tileDescription();
    chunk = uint64_t{tile.xSize} * tile.ySize;
  }
  constexpr uint64_t kMostOfChunk = uint64_t{1} << 28;
  if (pixel > kMostOfChunk || chunk > kMostOfChunk / pixel) {
    return Expected(where, "blocks of at most 256 MiB", "a larger one");
  }
  if (std::max(stored * pixel, shown) / compression.most_expansion > bytes) {
    return Expected(where, "an undamaged OpenEXR file",
                    "a damaged one (it is too small for its pixels)");
  }
  const int64_t left = int64_t{data.min.x} - display.min.x,
                top = int64_t{data.min.y} - display.min.y;
  if (std::max(std::abs(left), std::abs(top)) > kMaxPictureSize) {
    return Expected(where, "stored pixels near the display window", "pixels far away from it");
  }
  return ExrWindow{static_cast<int>(left),          static_cast<int>(top),
                   static_cast<int>(width),         static_cast<int>(height),
                   static_cast<int>(display_width), static_cast<int>(display_height)};
}

// Reads channels of a part, and calls `take(x, y, count, values)` for each run of stored pixels
// within the display window. `values` are the interleaved samples of the channels.
template <class Take>
void ReadPart(Imf::MultiPartInputFile* file, int part, const ExrWindow& window,
              const std::vector<std::string>& names, Take take) {
  Imf::InputPart input(*file, part);
  const Imath::Box2i data = input.header().dataWindow();
  const int begin = std::max(-window.left, 0),
            end = std::min(window.width, window.display_width - window.left);
  // The rows of a chunk of most compressions, and a multiple or divisor of the rows of a tile.
  constexpr int kRows = 32;
  const size_t channels = names.size(), row = channels * static_cast<size_t>(window.width);
  std::vector<float> values(row * kRows);
  for (int top = 0; top < window.height && begin < end; top += kRows) {
    const int rows = std::min(kRows, window.height - top);
    Imf::FrameBuffer target;
    for (size_t c = 0; c < channels; ++c) {
      target.insert(
          names[c],
          Imf::Slice::Make(Imf::FLOAT, values.data() + c, Imath::V2i(data.min.x, data.min.y + top),
                           window.width, rows, channels * sizeof(float), row * sizeof(float)));
    }
    input.setFrameBuffer(target);
    input.readPixels(data.min.y + top, data.min.y + top + rows - 1);
    for (int line = 0; line < rows; ++line) {
      const int y = window.top + top + line;
      if (y < 0 || y >= window.display_height) continue;
      take(window.left + begin, y, end - begin,
           values.data() + static_cast<size_t>(line) * row + static_cast<size_t>(begin) * channels);
    }
  }
}

// The channels of a picture, in the order of the samples of a DeepImage.
struct ExrColours {
  int part = -1;
  std::string name;  // of the layer or the part; empty: neither has a name
  std::vector<std::string> channels;
  bool is_right = false;
};

// Lists the pictures of a file: all layers with R, G and B, or otherwise all layers with Y.
std::vector<ExrColours> ListPictures(const std::vector<ExrChannel>& channels) {
  std::vector<ExrColours> pictures;
  for (const std::vector<std::string>& lasts : {std::vector<std::string>{"R", "G", "B"}, {"Y"}}) {
    if (!pictures.empty()) break;
    for (const ExrChannel& first : channels) {
      if (first.last != lasts[0]) continue;
      ExrColours picture = {
          first.part, first.layer.empty() ? first.part_name : first.layer, {}, first.is_right};
      const auto add = [&](const std::string& last) {
        for (const ExrChannel& channel : channels) {
          if (channel.part != first.part || channel.layer != first.layer) continue;
          if (channel.last == last) picture.channels.push_back(channel.name);
        }
      };
      for (const std::string& last : lasts) add(last);
      if (picture.channels.size() != lasts.size()) continue;
      add("A");
      pictures.push_back(std::move(picture));
    }
  }
  std::stable_sort(pictures.begin(), pictures.end(), [](const ExrColours& a, const ExrColours& b) {
    return !a.is_right && b.is_right;
  });
  return pictures;
}

// Limits samples to finite half floats. NaN stays, so that CountUnusable finds it.
uint16_t StoredHalf(float value) {
  return HalfOfFloat(std::isnan(value) ? value : std::clamp(value, -kLargestHalf, kLargestHalf));
}

// Reads the attribute chromaticities. Without it, the primaries are those of BT.709.
ColourDescription ReadChromaticities(const Imf::Header& header) {
  if (!Imf::hasChromaticities(header)) return {};
  const Imf::Chromaticities& found = Imf::chromaticities(header);
  const Imath::V2f points[] = {found.red, found.green, found.blue, found.white};
  ColourDescription colours;
  constexpr int kLinearTransfer = 8;  // of H.273
  constexpr float kMost = 10;
  for (size_t k = 0; k < std::size(points); ++k) {
    if (!(std::fabs(points[k].x) < kMost && std::fabs(points[k].y) < kMost)) return {};
    colours.chromaticities[2 * k] = static_cast<int32_t>(std::lround(100000.0 * points[k].x));
    colours.chromaticities[2 * k + 1] = static_cast<int32_t>(std::lround(100000.0 * points[k].y));
  }
  colours.form = "chromaticities";
  colours.primaries = ColourDescription::kGiven;
  colours.transfer = kLinearTransfer;
  return colours;
}

// Returns the channel of a depth map or a matte, or null.
const ExrChannel* ChooseChannel(const std::vector<ExrChannel>& channels, bool is_matte) {
  using Test = bool (*)(const ExrChannel&);
  const Test depths[] = {[](const ExrChannel& channel) { return channel.last == "Z"; },
                         [](const ExrChannel& channel) {
                           return StartsWithWord(channel.name, "disparity") &&
                                  (channel.layer.empty() || Lower(channel.last) == "x");
                         },
                         [](const ExrChannel& channel) {
                           return StartsWithWord(channel.last, "depth") ||
                                  Lower(channel.name) == "depth.v";
                         }};
  const Test mattes[] = {[](const ExrChannel& channel) { return channel.last == "A"; },
                         [](const ExrChannel& channel) { return channel.name == "Y"; },
                         [](const ExrChannel&) { return false; }};
  for (const Test& test : is_matte ? mattes : depths) {
    for (const bool is_right : {false, true}) {
      for (const ExrChannel& channel : channels) {
        if (channel.is_right == is_right && test(channel)) return &channel;
      }
    }
  }
  return channels.size() == 1 ? &channels[0] : nullptr;
}

// Returns true if a channel has samples of 32 bits.
bool HasWideSamples(const Imf::Header& header, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [&header](const std::string& name) {
    return header.channels()[name].type != Imf::HALF;
  });
}

// Adds notes about stored pixels and a position that the picture does not keep.
void NoteWindows(const Imath::Box2i& display, const ExrWindow& window,
                 std::vector<std::string>* notes) {
  if (std::min(window.left, window.top) < 0 || window.left + window.width > window.display_width ||
      window.top + window.height > window.display_height) {
    notes->push_back("the pixels outside of the display window are left out");
  }
  if (display.min == Imath::V2i(0, 0)) return;
  notes->push_back("the display window starts at " + std::to_string(display.min.x) + "," +
                   std::to_string(display.min.y) + ", and that of a new picture at 0,0");
}

Result<DecodedPicture> DecodeColours(const std::string& where, const Bytes& exr) {
  ExrInput stream(exr);
  Imf::MultiPartInputFile file(stream, 0, false);
  const std::vector<ExrChannel> channels = ListChannels(file);
  const std::vector<ExrColours> pictures = ListPictures(channels);
  if (pictures.empty()) {
    return Expected(where, "an OpenEXR picture with the channels R, G and B, or Y",
                    NamesOf(channels));
  }
  const ExrColours& chosen = pictures[0];
  const Result<ExrWindow> window = ReadWindow(where, file.header(chosen.part), exr.size());
  if (!window) return window.error();
  const size_t stored = chosen.channels.size();
  const bool is_grey = stored < 3, has_alpha = stored % 2 == 0;
  DecodedPicture picture;
  picture.deep = DeepImage(window->display_width, window->display_height, has_alpha ? 4 : 3);
  DeepImage& deep = *picture.deep;
  deep.is_half = deep.is_multiplied = true;
  deep.transfer = STARFOCUS_TRANSFER_NONE;
  const auto samples = static_cast<size_t>(deep.channels);
  ReadPart(&file, chosen.part, *window, chosen.channels,
           [&](int x, int y, int count, const float* values) {
             uint16_t* to = deep.row(y) + static_cast<size_t>(x) * samples;
             for (; count > 0; --count, to += samples, values += stored) {
               for (size_t c = 0; c < samples; ++c) {
                 const size_t from = !is_grey ? c : c < 3 ? 0 : 1;
                 to[c] = StoredHalf(values[from]);
               }
             }
           });
  picture.bits = HasWideSamples(file.header(chosen.part), chosen.channels) ? 32 : 16;
  deep.bits = picture.bits;
  picture.is_transparent = DropOpaqueAlpha(&deep);
  picture.image = ToImage(deep);
  picture.metadata.colours = ReadChromaticities(file.header(chosen.part));
  NoteWindows(file.header(chosen.part).displayWindow(), *window, &picture.notes);
  if (pictures.size() > 1) {
    picture.notes.push_back("the file has " + std::to_string(pictures.size()) +
                            " pictures, of which the program reads " +
                            (chosen.name.empty() ? "the first" : chosen.name));
  }
  return picture;
}

Result<Samples> DecodeChannel(const std::string& where, bool is_matte, const Bytes& exr) {
  ExrInput stream(exr);
  Imf::MultiPartInputFile file(stream, 0, false);
  const std::vector<ExrChannel> channels = ListChannels(file);
  const ExrChannel* chosen = ChooseChannel(channels, is_matte);
  if (chosen == nullptr) {
    return Expected(where,
                    is_matte ? "an OpenEXR file with the channel A or with one channel"
                             : "an OpenEXR file with the channel Z or with one channel",
                    NamesOf(channels));
  }
  const Result<ExrWindow> window = ReadWindow(where, file.header(chosen->part), exr.size());
  if (!window) return window.error();
  Samples samples;
  samples.is_wide = true;
  samples.is_alpha = is_matte && chosen->last == "A";
  samples.larger_is_nearer = StartsWithWord(chosen->name, "disparity");
  const bool is_distance = !is_matte && chosen->last == "Z";
  FloatMap& map = samples.map;
  map.width = window->display_width;
  map.height = window->display_height;
  const float unstored = is_matte      ? 0
                         : is_distance ? std::numeric_limits<float>::infinity()
                                       : std::numeric_limits<float>::quiet_NaN();
  const auto columns = static_cast<size_t>(map.width);
  map.values.assign(columns * static_cast<size_t>(map.height), unstored);
  ReadPart(&file, chosen->part, *window, {chosen->name},
           [&](int x, int y, int count, const float* values) {
             std::copy_n(values, count,
                         &map.values[static_cast<size_t>(y) * columns + static_cast<size_t>(x)]);
           });
  return samples;
}

}  // namespace

Result<DecodedPicture> DecodeExr(const std::string& where, const Bytes& exr) {
  return CatchExr<DecodedPicture>(where, exr, [&] { return DecodeColours(where, exr); });
}

Result<Samples> DecodeExrSamples(const std::string& where, bool is_matte, const Bytes& exr) {
  return CatchExr<Samples>(where, exr, [&] { return DecodeChannel(where, is_matte, exr); });
}

bool HasExrDistances(const Bytes& exr) {
  const Result<bool> found = CatchExr<bool>("", exr, [&]() -> Result<bool> {
    ExrInput stream(exr);
    const Imf::MultiPartInputFile file(stream, 0, false);
    const std::vector<ExrChannel> channels = ListChannels(file);
    return std::any_of(channels.begin(), channels.end(),
                       [](const ExrChannel& channel) { return channel.last == "Z"; });
  });
  return found && *found;
}

}  // namespace starfocus
