// SPDX-License-Identifier: Apache-2.0
// Encodes OpenEXR with the C++ functions of OpenEXR.
#include "platform/writers/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <cstring>
#include <exception>
#include <new>
#include <optional>

namespace starfocus {
namespace {

// A file in memory that OpenEXR writes.
class ExrOutput : public Imf::OStream {
 public:
  explicit ExrOutput(Bytes* bytes) : Imf::OStream("picture"), bytes_(bytes) {}

  void write(const char* from, int count) override {
    const auto size = static_cast<size_t>(count);
    if (bytes_->size() < at_ + size) bytes_->resize(at_ + size);
    if (size > 0) std::memcpy(bytes_->data() + at_, from, size);
    at_ += size;
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t at) override { at_ = static_cast<size_t>(at); }

 private:
  Bytes* bytes_;
  size_t at_ = 0;
};

void SetChromaticities(const ColourDescription& colours, Imf::Header* header) {
  const std::optional<Chromaticities> at = ChromaticitiesOf(colours);
  if (!at || *at == ChromaticitiesOf({})) return;
  const auto point = [&at](size_t k) {
    return Imath::V2f(static_cast<float>((*at)[2 * k] / 1e5),
                      static_cast<float>((*at)[2 * k + 1] / 1e5));
  };
  Imf::addChromaticities(*header, Imf::Chromaticities(point(0), point(1), point(2), point(3)));
}

void Write(const DeepImage& half, const ColourDescription& colours, Bytes* bytes) {
  Imf::Header header(half.width, half.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  SetChromaticities(colours, &header);
  constexpr const char* kNames[] = {"R", "G", "B", "A"};
  Imf::FrameBuffer source;
  for (size_t c = 0; c < static_cast<size_t>(half.channels); ++c) {
    header.channels().insert(kNames[c], Imf::Channel(Imf::HALF));
    // OpenEXR does not write to the samples.
    auto* first = reinterpret_cast<char*>(const_cast<uint16_t*>(half.samples.data() + c));
    source.insert(kNames[c], Imf::Slice(Imf::HALF, first,
                                        static_cast<size_t>(half.channels) * sizeof(uint16_t),
                                        half.row_samples() * sizeof(uint16_t)));
  }
  ExrOutput stream(bytes);
  Imf::OutputFile file(stream, header, 0);
  file.setFrameBuffer(source);
  file.writePixels(half.height);
}

}  // namespace

Error CheckExrEncoder(const std::string&) { return {}; }

Result<Bytes> EncodeExr(const std::string& path, const DeepImage& half,
                        const ColourDescription& colours) {
  Bytes bytes;
  try {
    Write(half, colours, &bytes);  // writes the table of blocks when it returns
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    return Expected(path, "a picture that OpenEXR can write", failure.what());
  }
  return bytes;
}

}  // namespace starfocus
