// SPDX-License-Identifier: Apache-2.0
// Tests Y4M streams: headers, the samples of each kind of chroma, damaged streams, the end of the
// program by a signal, and the exchange with FFmpeg if it is installed.
#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "platform/file.h"
#include "platform/y4m.h"
#include "tests/programs/session.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"
#include "tests/support/test_scene.h"

namespace starfocus::stream_test {
namespace {

std::string ErrorOfHeader(const std::string& line) {
  return ParseY4mHeader("in", line).error().line();
}

void Write(const std::string& path, const std::string& bytes) {
  REQUIRE(WriteText(path, bytes) == "");
}

TEST_CASE("stream: a header has its fields in any order, and the defaults of FFmpeg") {
  const Y4mHeader header =
      ValueOf(ParseY4mHeader("in",
                             "YUV4MPEG2 C422p10 H480 Ip A4:3 F30000:1001 XCOLORRANGE=FULL "
                             "W641 XYSCSS=422P10"));
  CHECK((header.width == 641 && header.height == 480 && header.bits == 10));
  CHECK((header.across == 2 && header.down == 1 && header.range == STARFOCUS_RANGE_FULL));
  CHECK(header.Written().Line() ==
        "YUV4MPEG2 W641 H480 F30000:1001 Ip A4:3 C420p10 XCOLORRANGE=FULL\n");
  CHECK(header.milliseconds() == doctest::Approx(1001.0 / 30));
  const Y4mHeader least = ValueOf(ParseY4mHeader("in", "YUV4MPEG2 W2 H720"));
  CHECK(least.Line() == "YUV4MPEG2 W2 H720 F30:1 Ip C420jpeg XCOLORRANGE=LIMITED\n");
  CHECK(least.matrix() == STARFOCUS_MATRIX_BT709);
  CHECK(header.matrix() == STARFOCUS_MATRIX_BT601);
  // Grey streams have the full range, unless they state another.
  CHECK(ValueOf(ParseY4mHeader("in", "YUV4MPEG2 W2 H2 Cmono")).range == STARFOCUS_RANGE_FULL);
  CHECK(ValueOf(ParseY4mHeader("in", "YUV4MPEG2 W2 H2 Cmono XCOLORRANGE=LIMITED")).range ==
        STARFOCUS_RANGE_LIMITED);
  // An unknown rate, as of pictures, is 30 frames per second.
  CHECK(ValueOf(ParseY4mHeader("in", "YUV4MPEG2 W2 H2 F0:0")).rate == "30:1");
}

TEST_CASE("stream: a header that cannot be read is an error with its cause") {
  const std::pair<const char*, const char*> kErrors[] = {
      {"RIFF", "a Y4M stream (ffmpeg -i FILE -f yuv4mpegpipe -), found other data"},
      {"YUV4MPEG2 W2", "a width and a height, found none"},
      {"YUV4MPEG2 W0 H2", "a width from 1 to 65535, found W0"},
      {"YUV4MPEG2 W65536 H2", "a width from 1 to 65535, found W65536"},
      {"YUV4MPEG2 W2 H-2", "a height from 1 to 65535, found H-2"},
      {"YUV4MPEG2 W20000 H20000", "at most 268435456 pixels, found 20000x20000"},
      {"YUV4MPEG2 W2 H2 It", "progressive frames (ffmpeg -vf yadif makes them), found It"},
      {"YUV4MPEG2 W2 H2 C420p12", "of 8 or 10 bits, found C420p12"},
      {"YUV4MPEG2 W2 H2 F25", "a frame rate such as F30:1, found F25"},
      {"YUV4MPEG2 W2 H2 A1:", "an aspect such as A1:1, found A1:"}};
  for (const auto& row : kErrors) {
    CAPTURE(row.first);
    CHECK(Contains(ErrorOfHeader(row.first), row.second));
  }
}

// Returns the first frame of a stream of one frame with these samples.
PlanarImage FirstFrame(const std::string& header, const std::string& samples) {
  const TempFolder folder;
  Write(folder.file("in.y4m"), "YUV4MPEG2 " + header + "\nFRAME Xa\n" + samples);
  Y4mReader reader;
  REQUIRE(reader.Open(folder.file("in.y4m")) == "");
  std::vector<uint8_t> planes;
  REQUIRE(ValueOf(reader.Next(&planes)));
  const PlanarImage planar = ToPlanar(reader.header(), planes);
  CHECK(!ValueOf(reader.Next(&planes)));
  return planar;
}

TEST_CASE("stream: chroma of all kinds becomes 4:2:0 of an odd size") {
  using Samples = std::vector<uint8_t>;
  CHECK(FirstFrame("W3 H1 C420paldv", "abcdefg").samples ==
        Samples{'a', 'b', 'c', 'd', 'e', 'f', 'g'});
  // Means of the rows 1 and 2, and of row 3 alone.
  CHECK(FirstFrame("W1 H3 C422", std::string("abc") + "\x10\x13\x20" + "\x30\x40\x50").samples ==
        Samples{'a', 'b', 'c', 0x12, 0x20, 0x38, 0x50});
  CHECK(FirstFrame("W3 H2 C444", std::string("abcdef") + "\x10\x20\x30\x12\x22\x34" + "ABCDEF")
            .samples == Samples{'a', 'b', 'c', 'd', 'e', 'f', 0x19, 0x32, 'C', 'E'});
  CHECK(FirstFrame("W2 H1 Cmono", "ab").samples == Samples{'a', 'b', 128, 128});
}

TEST_CASE("stream: words of 10 bits pass to the engine and back unchanged") {
  const std::string samples("\xff\x03\x40\x00\x01\x02\x03\x01\x00\x02", 10);  // Y Y Y U V
  const Y4mHeader header = ValueOf(ParseY4mHeader("in", "YUV4MPEG2 W1 H3 C420p10"));
  const std::string four =
      samples.substr(0, 6) + std::string("\x11\x01\x22\x01\x33\x02\x00\x03", 8);
  const PlanarImage planar = FirstFrame("W1 H3 C420p10", four);
  CHECK(planar.is_deep);
  const std::vector<uint8_t> frame = EncodeY4mFrame(header, planar);
  CHECK(std::string(frame.begin(), frame.end()) == "FRAME\n" + four);
  // Chroma of words is in turn: U V U V.
  const auto word = [&](size_t k) {
    uint16_t value = 0;
    std::memcpy(&value, planar.samples.data() + 2 * k, 2);
    return value >> 6;
  };
  CHECK((word(0) == 0x3ff && word(3) == 0x111 && word(4) == 0x233 && word(5) == 0x122));
  CHECK(Narrow(planar).samples == std::vector<uint8_t>{255, 16, 128, 68, 73, 141, 192});
}

TEST_CASE("stream: luma of the limited range becomes levels from black to white") {
  Y4mHeader header = ValueOf(ParseY4mHeader("in", "YUV4MPEG2 W4 H1 C420jpeg"));
  int largest = 0;
  const std::vector<uint8_t> planes = {0, 16, 126, 255, 0, 0, 0, 0};
  CHECK(LumaLevels(header, planes, &largest) == std::vector<float>{0, 0, 110, 219});
  CHECK(largest == 219);
  header.range = STARFOCUS_RANGE_FULL;
  CHECK(LumaLevels(header, planes, &largest) == std::vector<float>{0, 16, 126, 255});
  CHECK(largest == 255);
}

TEST_CASE("stream: damaged streams are errors that name the frame") {
  const TempFolder folder;
  const std::string path = folder.file("in.y4m"), header = "YUV4MPEG2 W2 H2\n";
  const std::string frame = "FRAME\n123456";
  const std::pair<std::string, const char*> kErrors[] = {
      {"", "expected a Y4M stream (ffmpeg -i FILE -f yuv4mpegpipe -), found nothing"},
      {std::string(3000, 'x'), "found other data"},
      {"YUV4MPEG2 W2 H2 X" + std::string(3000, 'x'), "of at most 1024 bytes"},
      {header + frame + "FRAMES\n", "the line FRAME before frame 1, found other data"},
      {header + frame + "FRAME", "a line FRAME of at most 1024 bytes with a line break"},
      {header + frame + "FRAME\n123",
       "expected 6 bytes of frame 1, found the end of the stream after 3"}};
  for (const auto& row : kErrors) {
    CAPTURE(row.second);
    Write(path, row.first);
    Y4mReader reader;
    Error error = reader.Open(path);
    std::vector<uint8_t> planes;
    for (int k = 0; k < 3 && !error; ++k) error = reader.Next(&planes).error();
    CHECK(Contains(error.line(), row.second));
  }
}

TEST_CASE("stream: a signal ends the program after a complete frame") {
  const TempFolder folder;
  REQUIRE(RunShell(folder, "lab scene lf --size 640x360 --views 1") == 0);
  std::string frames;
  for (int k = 0; k < 40; ++k) frames += " lf";
  for (const char* number : {"INT", "TERM"}) {
    for (const char* threads : {"1", "3"}) {
      CAPTURES(number, threads);
      // The pipe is full when the signal comes, within a frame.
      const std::string call = std::string("env --default-signal=") + number + " '" +
                               STARFOCUS_PROGRAM "' video" + frames + " -o - --focus 1 --threads " +
                               threads;
      REQUIRE(RunShell(folder, "(" + call +
                                   " 2>log & echo $! >id; wait $!) | { head -c 1000000 "
                                   ">out.y4m; (sleep 0.3; kill -" +
                                   number + " $(cat id)); sleep 0.3; cat >>out.y4m; }") == 0);
      const std::string out = Text(folder.file("out.y4m"));
      const size_t header = out.find('\n') + 1, frame = 6 + 640 * 360 * 3 / 2;
      CHECK((out.size() - header) % frame == 0);
      CHECK(out.size() > header + 2 * frame);
      CHECK(out.size() < header + 39 * frame);
    }
  }
}

TEST_SUITE("ffmpeg") {
  TEST_CASE("stream: FFmpeg writes the input and reads the output") {
    if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0) {
      std::printf("SKIPPED: ffmpeg is not there\n");
      return;
    }
    const TempFolder folder;
    const std::string ffmpeg = "ffmpeg -v error -nostdin -y ";
    REQUIRE(RunShell(folder,
                     ffmpeg +
                         "-f lavfi -i testsrc=s=161x91:r=5:d=1 -c:v ffv1 in.mkv && mkdir d && " +
                         ffmpeg +
                         "-f lavfi -i 'gradients=s=161x91:r=5:d=1:c0=black:c1=white' "
                         "-pix_fmt gray d/%05d.png") == 0);
    for (const char* format : {"yuv420p", "yuv422p", "yuv444p", "gray"}) {
      CAPTURE(format);
      REQUIRE(RunShell(folder, ffmpeg + "-i in.mkv -pix_fmt " + format +
                                   " -f yuv4mpegpipe - | starfocus video - --depth 'd/%05d.png' "
                                   "--near white --no-repair --strength 0 -o - 2>log | " +
                                   ffmpeg + "-f yuv4mpegpipe -i - -c:v ffv1 out.mkv") == 0);
      CHECK(RunShell(folder,
                     "test $(ffprobe -v error -count_frames -show_entries "
                     "stream=nb_read_frames -of csv=p=0 out.mkv) = 5") == 0);
      // Without blur, luma is that of the input, except for chroma that RGB cannot have.
      for (const char* file : {"in", "out"}) {
        REQUIRE(RunShell(folder, ffmpeg + "-i " + file + ".mkv -frames:v 1 -vf format=" + format +
                                     ",extractplanes=y " + file + ".png") == 0);
      }
      CHECK(PsnrOf(folder, "in.png", "out.png") > 35);
    }
  }
}

}  // namespace
}  // namespace starfocus::stream_test
