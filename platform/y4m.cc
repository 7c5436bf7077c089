// SPDX-License-Identifier: Apache-2.0
#include "platform/y4m.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>
#include <utility>

#include "platform/file.h"
#include "platform/standard_stream.h"
#include "platform/text.h"

namespace starfocus {
namespace {

constexpr char kY4mMagic[] = "YUV4MPEG2";
constexpr char kFrameLine[] = "FRAME";
constexpr size_t kMostHeaderLine = 1024;                // bytes of a header line
constexpr int64_t kMostFramePixels = int64_t{1} << 28;  // as of other pictures (image_io.h)
constexpr size_t kReadAtOnce = size_t{8}
                               << 20;  // bytes that are allocated before they have been read

struct Chroma {
  const char* name;
  int across, down, bits;
};

// The positions of 4:2:0 chroma samples (jpeg, mpeg2, paldv) are kept, but read alike.
constexpr Chroma kChromas[] = {{"420jpeg", 2, 2, 8}, {"420mpeg2", 2, 2, 8}, {"420paldv", 2, 2, 8},
                               {"420", 2, 2, 8},     {"422", 2, 1, 8},      {"444", 1, 1, 8},
                               {"mono", 0, 0, 8},    {"420p10", 2, 2, 10},  {"422p10", 2, 1, 10},
                               {"444p10", 1, 1, 10}, {"mono10", 0, 0, 10}};

// Parses a whole number from 1 to 65535. Returns 0 for other texts.
int SizeOf(const std::string& text) {
  const bool digits =
      !text.empty() && text.size() <= 5 &&
      std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  const int value = digits ? std::atoi(text.c_str()) : 0;
  return value <= kMaxPictureSize ? value : 0;
}

// Returns true for a ratio such as 30000:1001.
bool IsRatio(const std::string& text) {
  const size_t colon = text.find(':');
  const auto whole = [](const std::string& part) {
    return !part.empty() && part.size() <= 9 && part.find_first_not_of("0123456789") == part.npos;
  };
  return colon != text.npos && whole(text.substr(0, colon)) && whole(text.substr(colon + 1));
}

Error Invalid(const std::string& where, const std::string& expected, const std::string& found) {
  return Expected(where, "a Y4M header with " + expected, found.substr(0, 60));
}

Error SetChroma(const std::string& where, const std::string& name, Y4mHeader* header) {
  for (const Chroma& chroma : kChromas) {
    if (name != chroma.name) continue;
    header->chroma = name;
    header->across = chroma.across;
    header->down = chroma.down;
    header->bits = chroma.bits;
    return {};
  }
  return Invalid(where, "4:2:0, 4:2:2, 4:4:4 or mono of 8 or 10 bits", "C" + name);
}

// Sets a field of the header from a parameter. Unknown parameters are ignored.
Error SetField(const std::string& where, const std::string& word, Y4mHeader* header) {
  const std::string value = word.substr(1);
  switch (word[0]) {
    case 'W':
      header->width = SizeOf(value);
      if (header->width > 0) return {};
      return Invalid(where, "a width from 1 to " + std::to_string(kMaxPictureSize), word);
    case 'H':
      header->height = SizeOf(value);
      if (header->height > 0) return {};
      return Invalid(where, "a height from 1 to " + std::to_string(kMaxPictureSize), word);
    case 'F':
      if (!IsRatio(value)) return Invalid(where, "a frame rate such as F30:1", word);
      if (value[0] != '0' && value.find(":0") == value.npos) header->rate = value;
      return {};
    case 'A':
      if (!IsRatio(value)) return Invalid(where, "an aspect such as A1:1", word);
      header->aspect = value;
      return {};
    case 'I':
      if (value == "p" || value == "?" || value.empty()) return {};
      return Invalid(where, "progressive frames (ffmpeg -vf yadif makes them)", word);
    case 'C':
      return SetChroma(where, value, header);
    default:
      return {};
  }
}

// Returns the number of samples of each chroma plane.
size_t ChromaSamples(const Y4mHeader& header) {
  if (header.across == 0) return 0;
  return size_t((header.width + header.across - 1) / header.across) *
         size_t((header.height + header.down - 1) / header.down);
}

size_t FrameBytes(const Y4mHeader& header) {
  const size_t luma = size_t(header.width) * size_t(header.height);
  return (luma + 2 * ChromaSamples(header)) * (header.bits > 8 ? 2 : 1);
}

// Reads sample `index` of samples of 8 bits or of little-endian words.
template <class Sample>
int Get(const uint8_t* samples, size_t index) {
  if (sizeof(Sample) == 1) return samples[index];
  return samples[2 * index] | samples[2 * index + 1] << 8;
}

// Returns a plane of chroma at half the width and height: the rounded means of the samples of 2 x 2
// pixels, of which `plane` has one for each `across` x `down` pixels.
template <class Sample>
std::vector<uint16_t> Halve(const Y4mHeader& header, const uint8_t* plane) {
  const int width = (header.width + header.across - 1) / header.across;
  const int height = (header.height + header.down - 1) / header.down;
  const int columns = 2 / header.across, rows = 2 / header.down;  // of each mean
  std::vector<uint16_t> half;
  for (int y = 0; y < (header.height + 1) / 2; ++y) {
    for (int x = 0; x < (header.width + 1) / 2; ++x) {
      int sum = 0;
      for (int k = 0; k < rows * columns; ++k) {
        const int row = std::min(y * rows + k / columns, height - 1);
        const int column = std::min(x * columns + k % columns, width - 1);
        sum += Get<Sample>(plane, size_t(row) * size_t(width) + size_t(column));
      }
      half.push_back(static_cast<uint16_t>((sum + rows * columns / 2) / (rows * columns)));
    }
  }
  return half;
}

// Stores 10 bits in the upper bits of a word in the byte order of the machine.
void PutWord(int value, uint8_t* to) {
  const auto word = static_cast<uint16_t>(std::min(value, 1023) << 6);
  std::memcpy(to, &word, 2);
}

int GetWord(const uint8_t* from) {
  uint16_t word = 0;
  std::memcpy(&word, from, 2);
  return word >> 6;
}

// Returns the planes U and V of a frame at half its width and height.
template <class Sample>
std::vector<uint16_t> HalvedChroma(const Y4mHeader& header, const uint8_t* planes, size_t each) {
  if (header.across == 0) {
    return std::vector<uint16_t>(2 * each, uint16_t(1 << (header.bits - 1)));
  }
  const uint8_t* first = planes + size_t(header.width) * size_t(header.height) * sizeof(Sample);
  std::vector<uint16_t> both = Halve<Sample>(header, first);
  const std::vector<uint16_t> second =
      Halve<Sample>(header, first + ChromaSamples(header) * sizeof(Sample));
  both.insert(both.end(), second.begin(), second.end());
  return both;
}

}  // namespace

int32_t Y4mHeader::matrix() const {
  return height >= 720 ? STARFOCUS_MATRIX_BT709 : STARFOCUS_MATRIX_BT601;
}

Y4mHeader Y4mHeader::Written() const {
  Y4mHeader written = *this;
  if (across == 0 || (across == 2 && down == 2)) return written;
  // The means of 4:2:2 lie above the left pixels, and those of 4:4:4 between the pixels.
  written.chroma = bits > 8 ? "420p10" : across == 2 ? "420mpeg2" : "420jpeg";
  written.across = written.down = 2;
  return written;
}

double Y4mHeader::milliseconds() const {
  const size_t colon = rate.find(':');
  return 1000 * std::atof(rate.substr(colon + 1).c_str()) / std::atof(rate.c_str());
}

std::string Y4mHeader::Line() const {
  std::string line = std::string(kY4mMagic) + " W" + std::to_string(width) + " H" +
                     std::to_string(height) + " F" + rate + " Ip";
  if (!aspect.empty()) line += " A" + aspect;
  return line + " C" + chroma +
         (range == STARFOCUS_RANGE_FULL ? " XCOLORRANGE=FULL\n" : " XCOLORRANGE=LIMITED\n");
}

Result<Y4mHeader> ParseY4mHeader(const std::string& where, const std::string& line) {
  std::istringstream words(line);
  std::string word;
  if (!(words >> word) || word != kY4mMagic) {
    return Expected(where, "a Y4M stream (ffmpeg -i FILE -f yuv4mpegpipe -)", "other data");
  }
  Y4mHeader header;
  std::string range;
  while (words >> word) {
    if (word.rfind("XCOLORRANGE=", 0) == 0) {
      range = word.substr(12);
      continue;
    }
    if (Error error = SetField(where, word, &header)) return error;
  }
  if (header.width == 0 || header.height == 0)
    return Invalid(where, "a width and a height", "none");
  if (int64_t{header.width} * header.height > kMostFramePixels) {
    return Invalid(where, "at most " + std::to_string(kMostFramePixels) + " pixels",
                   SizeText(header.width, header.height));
  }
  // Grey pictures have the full range unless the stream states another, as in FFmpeg.
  const bool is_full = range == "FULL" || (header.across == 0 && range != "LIMITED");
  header.range = is_full ? STARFOCUS_RANGE_FULL : STARFOCUS_RANGE_LIMITED;
  return header;
}

bool IsY4mFile(const std::string& path) {
  const auto none = [](const Bytes&) { return false; };  // reads only the beginning of the file
  const Result<Bytes> beginning = ReadFileIf(path, none);
  constexpr size_t kLength = sizeof(kY4mMagic) - 1;
  return beginning && beginning->size() > kLength &&
         std::memcmp(beginning->data(), kY4mMagic, kLength) == 0;
}

void Y4mReader::CloseFile::operator()(std::FILE* file) const { std::fclose(file); }

Error Y4mReader::Open(const std::string& path) {
  where_ = InputName(path);
  if (path == "-") {
    const int handle = dup(STDIN_FILENO);
    file_.reset(handle < 0 ? nullptr : fdopen(handle, "rb"));
  } else {
    if (Error error = CheckPlainFile(path)) return error;
    file_.reset(std::fopen(path.c_str(), "rb"));
  }
  if (file_ == nullptr) return Cannot("read", path, {errno, std::generic_category()});
  std::string line;
  const Result<bool> has = ReadLine("a Y4M header", &line);
  if (!has) return has.error();
  if (!*has) {
    return Expected(where_, "a Y4M stream (ffmpeg -i FILE -f yuv4mpegpipe -)", "nothing");
  }
  return ParseY4mHeader(where_, line).MoveTo(&header_);
}

// Reads a line without its line break. Returns false if the stream has ended before it.
Result<bool> Y4mReader::ReadLine(const char* what, std::string* line) {
  line->clear();
  for (;;) {
    const int c = std::fgetc(file_.get());
    if (c == '\n') return true;
    if (c == EOF && std::ferror(file_.get()) != 0) {
      return Cannot("read", where_, {errno, std::generic_category()});
    }
    if (c == EOF && line->empty()) return false;
    if (c == EOF || line->size() == kMostHeaderLine) {
      // Data without a magic word are not a damaged stream, but another kind of file.
      if (line->rfind(kY4mMagic, 0) != 0 && frames_ == 0 && header_.width == 0) return true;
      return Expected(where_,
                      std::string(what) + " of at most " + std::to_string(kMostHeaderLine) +
                          " bytes with a line break",
                      c == EOF ? "the end of the stream" : "more");
    }
    line->push_back(static_cast<char>(c));
  }
}

Error Y4mReader::Truncated(size_t got, size_t bytes) const {
  return Expected(where_, std::to_string(bytes) + " bytes of frame " + std::to_string(frames_),
                  "the end of the stream after " + std::to_string(got));
}

Result<bool> Y4mReader::Next(std::vector<uint8_t>* planes) {
  std::string line;
  const Result<bool> has = ReadLine("a line FRAME", &line);
  if (!has || !*has) return has;
  if (line != kFrameLine && line.rfind(std::string(kFrameLine) + " ", 0) != 0) {
    return Expected(where_, "the line FRAME before frame " + std::to_string(frames_), "other data");
  }
  const size_t bytes = FrameBytes(header_);
  planes->clear();
  while (planes->size() < bytes) {
    const size_t before = planes->size(), part = std::min(kReadAtOnce, bytes - before);
    planes->resize(before + part);
    const size_t got = std::fread(planes->data() + before, 1, part, file_.get());
    if (got == part) continue;
    if (std::ferror(file_.get()) != 0) {
      return Cannot("read", where_, {errno, std::generic_category()});
    }
    return Truncated(before + got, bytes);
  }
  ++frames_;
  return true;
}

PlanarImage ToPlanar(const Y4mHeader& header, std::vector<uint8_t> planes) {
  PlanarImage planar;
  planar.width = header.width;
  planar.height = header.height;
  planar.is_deep = header.bits > 8;
  planar.matrix = header.matrix();
  planar.range = header.range;
  const size_t luma = planar.luma_samples(), chroma = planar.chroma_samples();
  if (!planar.is_deep) {
    if (header.across != 2 || header.down != 2) {
      const std::vector<uint16_t> halved = HalvedChroma<uint8_t>(header, planes.data(), chroma);
      planes.resize(luma + 2 * chroma);
      std::transform(halved.begin(), halved.end(), planes.begin() + ptrdiff_t(luma),
                     [](uint16_t value) { return static_cast<uint8_t>(value); });
    }
    planar.samples = std::move(planes);
    return planar;
  }
  const std::vector<uint16_t> halved = HalvedChroma<uint16_t>(header, planes.data(), chroma);
  planar.Allocate();
  uint8_t* const to = planar.samples.data();
  for (size_t i = 0; i < luma; ++i) PutWord(Get<uint16_t>(planes.data(), i), to + 2 * i);
  for (size_t i = 0; i < chroma; ++i) {
    PutWord(halved[i], to + 2 * luma + 4 * i);
    PutWord(halved[chroma + i], to + 2 * luma + 4 * i + 2);
  }
  return planar;
}

PlanarImage Narrow(const PlanarImage& planar) {
  if (!planar.is_deep) return planar;
  PlanarImage narrow = planar;
  narrow.is_deep = false;
  narrow.Allocate();
  const size_t luma = planar.luma_samples(), chroma = planar.chroma_samples();
  for (size_t i = 0; i < luma + 2 * chroma; ++i) {
    const size_t from = i < luma            ? i
                        : i < luma + chroma ? 2 * i - luma
                                            : 2 * (i - chroma) - luma + 1;
    const int code = GetWord(planar.samples.data() + 2 * from);
    narrow.samples[i] = static_cast<uint8_t>(std::min((code + 2) >> 2, 255));
  }
  return narrow;
}

std::vector<float> LumaLevels(const Y4mHeader& header, const std::vector<uint8_t>& planes,
                              int* largest) {
  const bool full = header.range == STARFOCUS_RANGE_FULL;
  const int scale = header.bits > 8 ? 4 : 1, black = full ? 0 : 16 * scale;
  *largest = full ? (256 * scale) - 1 : 219 * scale;
  std::vector<float> levels(size_t(header.width) * size_t(header.height));
  for (size_t i = 0; i < levels.size(); ++i) {
    const int code = scale > 1 ? Get<uint16_t>(planes.data(), i) : Get<uint8_t>(planes.data(), i);
    levels[i] = static_cast<float>(std::clamp(code - black, 0, *largest));
  }
  return levels;
}

std::vector<uint8_t> EncodeY4mFrame(const Y4mHeader& header, const PlanarImage& planar) {
  std::vector<uint8_t> bytes(kFrameLine, kFrameLine + sizeof(kFrameLine) - 1);
  bytes.push_back('\n');
  const size_t luma = planar.luma_samples(),
               chroma = header.across == 0 ? 0 : planar.chroma_samples();
  const uint8_t* const from = planar.samples.data();
  if (!planar.is_deep) {
    bytes.insert(bytes.end(), from, from + luma + 2 * chroma);
    return bytes;
  }
  const auto put = [&](size_t word) {
    const int code = GetWord(from + 2 * word);
    bytes.push_back(static_cast<uint8_t>(code & 255));
    bytes.push_back(static_cast<uint8_t>(code >> 8));
  };
  bytes.reserve(bytes.size() + 2 * (luma + 2 * chroma));
  for (size_t i = 0; i < luma; ++i) put(i);
  for (size_t i = 0; i < 2 * chroma; ++i) {
    put(luma + (i < chroma ? 2 * i : 2 * (i - chroma) + 1));
  }
  return bytes;
}

namespace {

// True while a frame is written, and after a signal that ends the program.
std::atomic<bool> writes_frame{false}, is_ending{false};

// Waits for the end of the frame that another thread writes. Runs in a signal handler.
void WaitForFrame(const void*) {
  is_ending = true;
  for (int k = 0; k < 2000 && writes_frame; ++k) {
    const timespec millisecond = {0, 1000000};
    nanosleep(&millisecond, nullptr);
  }
}

// Blocks signals in the thread that writes a frame, so that another thread handles them and waits,
// or this thread handles them after the frame.
class WholeFrame {
 public:
  WholeFrame() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
    writes_frame = true;
  }
  ~WholeFrame() {
    writes_frame = false;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WholeFrame(const WholeFrame&) = delete;
  WholeFrame& operator=(const WholeFrame&) = delete;

 private:
  sigset_t before_;
};

}  // namespace

Y4mWriter::Y4mWriter(Y4mHeader header) : header_(std::move(header)) {
  cleanup_.Add(SignalCleanup::Turn(), WaitForFrame, nullptr);
}

Y4mWriter::~Y4mWriter() { cleanup_.Remove(SignalCleanup::Turn()); }

Result<bool> Y4mWriter::Write(const PlanarImage& planar) {
  std::vector<uint8_t> bytes = EncodeY4mFrame(header_, planar);
  if (!has_begun_) {
    const std::string line = header_.Line();
    bytes.insert(bytes.begin(), line.begin(), line.end());
  }
  has_begun_ = true;
  const WholeFrame whole_frame;
  if (is_ending) return false;
  errno = 0;
  const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() &&
                     std::fflush(stdout) == 0;
  if (whole) return true;
  const int reason = errno != 0 ? errno : EIO;
  if (reason == EPIPE) return false;
  return Cannot("write to", "standard output", {reason, std::generic_category()});
}

}  // namespace starfocus
