// SPDX-License-Identifier: Apache-2.0
// Reads and writes YUV4MPEG2 streams (.y4m), the uncompressed video that FFmpeg writes with
// `-f yuv4mpegpipe`: a header line, and for each frame a line "FRAME" and the planes.
#ifndef STARFOCUS_PLATFORM_Y4M_H_
#define STARFOCUS_PLATFORM_Y4M_H_

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/result.h"
#include "platform/signal_cleanup.h"

namespace starfocus {

// Header of a stream. Frames are progressive.
struct Y4mHeader {
  int width = 0, height = 0;
  // Divisors of the width and height of chroma planes: 2 x 2 (4:2:0), 2 x 1 (4:2:2), 1 x 1 (4:4:4),
  // or 0 without chroma planes.
  int across = 2, down = 2;
  int bits = 8;                             // 8 or 10
  std::string chroma = "420jpeg";           // value of C
  std::string rate = "30:1";                // value of F, frames per second
  std::string aspect;                       // value of A, aspect of a pixel; empty: unknown
  int32_t range = STARFOCUS_RANGE_LIMITED;  // starfocus_range

  // Returns the matrix of YUV, which Y4M does not state: BT.709 from 720 rows on, else BT.601.
  int32_t matrix() const;
  // Returns the header of the frames that the engine computes from frames with this header. Their
  // chroma has 4:2:0, or is absent.
  Y4mHeader Written() const;
  // Returns milliseconds per frame.
  double milliseconds() const;
  std::string Line() const;  // the header line with its line break
};

// Parses a header line, without its line break. Limits the size of frames to 2^28 pixels. `where`
// appears only in error messages.
Result<Y4mHeader> ParseY4mHeader(const std::string& where, const std::string& line);

// Returns true if a file begins like a Y4M stream. Returns false if it cannot be read.
bool IsY4mFile(const std::string& path);

// Reads a stream from a regular file, or from standard input for the path "-".
class Y4mReader {
 public:
  Y4mReader() = default;

  // Opens the stream and reads its header.
  Error Open(const std::string& path);
  const Y4mHeader& header() const { return header_; }
  // Number of frames that Next has returned.
  size_t frames() const { return frames_; }

  // Reads the next frame into `planes`: all samples of the planes Y, U and V, as they are stored.
  // Returns false at the end of the stream. A stream that ends within a frame is an error.
  Result<bool> Next(std::vector<uint8_t>* planes);

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const;
  };

  Result<bool> ReadLine(const char* what, std::string* line);
  Error Truncated(size_t got, size_t bytes) const;

  std::string where_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  Y4mHeader header_;
  size_t frames_ = 0;
};

// Converts a frame of Y4mReader to the planes that the engine reads. Averages the chroma of 4:2:2
// and 4:4:4; frames without chroma are grey.
PlanarImage ToPlanar(const Y4mHeader& header, std::vector<uint8_t> planes);

// Returns a copy of a picture with 8 bits.
PlanarImage Narrow(const PlanarImage& planar);

// Returns the luma of a frame as levels from 0 (black) to `largest` (white).
std::vector<float> LumaLevels(const Y4mHeader& header, const std::vector<uint8_t>& planes,
                              int* largest);

// Returns the bytes of a frame of a stream with the header, with the line "FRAME".
std::vector<uint8_t> EncodeY4mFrame(const Y4mHeader& header, const PlanarImage& planar);

// Writes a stream to standard output. If a signal ends the program, the stream ends after a
// complete frame, unless its reader stops reading for two seconds.
class Y4mWriter {
 public:
  explicit Y4mWriter(Y4mHeader header);
  ~Y4mWriter();
  Y4mWriter(const Y4mWriter&) = delete;
  Y4mWriter& operator=(const Y4mWriter&) = delete;

  // Writes a frame, and the header before the first frame. Returns false if nobody reads the stream
  // any more, or if the program is ending.
  Result<bool> Write(const PlanarImage& planar);

 private:
  const Y4mHeader header_;
  bool has_begun_ = false;
  SignalCleanup cleanup_;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_Y4M_H_
