// SPDX-License-Identifier: Apache-2.0
// Tests the outputs of the program: formats, standard streams, stacks, batches, and the page of
// `view`. Compares pictures that are refocused from views at any positions with ray-traced
// pictures.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/image_io.h"
#include "platform/light_field.h"
#include "platform/pfm.h"
#include "platform/writers/webp.h"
#include "tests/programs/session.h"
#include "tests/support/error_line.h"

namespace starfocus::writers_program_test {
namespace {

namespace fs = std::filesystem;

void MakeScene(const TempFolder& folder, const std::string& name, const std::string& more = "") {
  Succeed(folder, "scene " + name + " --size 48x36 --views 5 --threads 1 " + more);
}

TEST_CASE("programs: every session of cli/sessions.txt succeeds") {
  RunSessions("programs/sessions.txt");
}

TEST_CASE("writers: a full disk leaves no folder and no part of a light field") {
  TempFolder folder;
  MakeScene(folder, "lf");
  MakeScene(folder, "other");
  // A limit on the size of files, in blocks of 512 bytes, fails like a full disk. With the larger
  // limits, views are written, and the map of 6912 bytes is not.
  for (const int blocks : {1, 8, 12}) {
    const std::string full = "trap '' XFSZ; ulimit -f " + std::to_string(blocks) + "; ";
    const std::vector<std::string> calls =
        blocks == 1
            ? std::vector<std::string>{"import lf a/new", "video lf other -o a/new --focus 1",
                                       "refocus lf other -o a/new --focus 1",
                                       "steps lf -o a/new --focus 1",
                                       "scene a/new --size 48x36 --views 5"}
            : std::vector<std::string>{"import lf a/new", "scene a/new --size 48x36"};
    for (const std::string& call : calls) {
      CAPTURE(blocks);
      CAPTURE(call);
      const Outcome outcome = Call(folder, call, full);
      CHECK(outcome.code == 1);
      CHECK(!fs::exists(folder.file("a")));
    }
  }
  Succeed(folder, "import lf a/new");
}

TEST_CASE("writers: a sweep writes an animation, or a sharp picture with the focus of each pixel") {
  TempFolder folder;
  MakeScene(folder, "lf");
  const bool webp = !WebpWriter::Check("", 1, 1);
  const std::string out = webp ? "s.webp" : "s.png";
  Succeed(
      folder,
      "refocus lf --sweep -0.45:0.45:4 --all-in-focus all.png --focus-index index.png -o " + out);
  CHECK(folder.count() == (webp ? 4 : 7));
  const Image all = ValueOf(ReadImage(folder.file("all.png")));
  const Image centre = ValueOf(ReadImage(folder.file("lf/view_+0.0_+0.0.png")));
  const Image index = ValueOf(ReadImage(folder.file("index.png")));
  CHECK(all.pixels == centre.pixels);
  FloatMap map = ValueOf(ReadPfm(folder.file("lf/disparity.pfm")));
  bool seen[4] = {};
  for (size_t i = 0; i < map.values.size(); ++i) {
    const int number = index.pixels[3 * i];
    REQUIRE(number < 4);
    seen[number] = true;
    CHECK(std::abs(double(map.values[i]) - (-0.45 + 0.3 * number)) <= 0.16);
  }
  CHECK((seen[0] && seen[2] && seen[3]));
  const Outcome wrong = Call(folder, "refocus lf --sweep 0:1:2 --focus-index index.jpg -o s.png");
  CHECK(wrong.code == 2);
  CheckErrorLine(wrong.err);
}

TEST_CASE("writers: a batch continues after a bad input and names the inputs that failed") {
  TempFolder folder;
  MakeScene(folder, "lf");
  MakeScene(folder, "more/one");
  MakeScene(folder, "more/two");
  fs::create_directory(folder.file("bad"));
  REQUIRE(WriteFile(folder.file("bad/view_+0.0_+0.0.png"), {1, 2, 3}) == "");
  for (const std::string jobs : {"1", "3"}) {
    CAPTURE(jobs);
    const Outcome outcome =
        Call(folder, "refocus lf bad more/ none -o out --focus 1 --jobs " + jobs);
    CHECK(outcome.code == 1);
    CHECK(Contains(outcome.err, "(failed: bad, none)"));
    CHECK(Contains(outcome.err, "\nstarfocus: 3 finished, 0 skipped, 2 failed\n"));
    CHECK(Count(outcome.err, "\n") == 7);
    for (const char* name : {"lf.png", "one.png", "two.png"}) {
      CHECK(Contains(outcome.err, "out/" + std::string(name) + ": focus at disparity 1, f/1\n"));
      CHECK(fs::exists(folder.file("out/" + std::string(name))));
    }
    CHECK(std::distance(fs::directory_iterator(folder.file("out")), {}) == 3);
    Succeed(folder, "refocus lf -o single.png --focus 1");
    CHECK(Text(folder.file("single.png")) == Text(folder.file("out/lf.png")));
    fs::remove_all(folder.file("out"));
  }
  for (const std::string wrong : {"lf more -o x.png", "lf lf -o out", "lf more -o out --map m.png",
                                  "lf more -o out --jobs 0", "lf more -o out --sweep 0:1:2"}) {
    CAPTURE(wrong);
    const Outcome outcome = Call(folder, "refocus --focus 1 " + wrong);
    CHECK(outcome.code == 2);
    CheckErrorLine(outcome.err);
    CHECK_FALSE(fs::exists(folder.file("out")));
  }
}

TEST_CASE("writers: compare draws the differences and does not overwrite its inputs") {
  TempFolder folder;
  Image a(4, 3), b(4, 3);
  b.pixels[3 * 5 + 1] = 40;
  b.pixels[3 * 6] = 20;
  REQUIRE(WriteImage(folder.file("a.png"), a) == "");
  REQUIRE(WriteImage(folder.file("b.png"), b) == "");
  CHECK(Call(folder, "compare a.png b.png --map map.ppm").code == 0);
  Image map = ValueOf(ReadImage(folder.file("map.ppm")));
  for (size_t i = 0; i < 12; ++i) {
    const int sum = map.pixels[3 * i] + map.pixels[3 * i + 1] + map.pixels[3 * i + 2];
    CHECK(sum == (i == 5 ? 765 : i == 6 ? 382 : 0));
  }
  CHECK(Call(folder, "compare a.png b.png --map a.png").code == 2);
  CHECK(Call(folder, "compare a.png b.png --map -").code == 2);
  fs::create_hard_link(folder.file("b.png"), folder.file("c.png"));
  CHECK(Call(folder, "compare a.png b.png --map c.png").code == 2);
}

TEST_CASE("writers: the page of `starfocus view` is self-contained and describes its pictures") {
  TempFolder folder;
  MakeScene(folder, "'a<b&\"c'", "--truth 4,1 --truth 2,0.5");
  Succeed(folder, "view 'a<b&\"c' -o page.html");
  const std::string page = Text(folder.file("page.html"));
  CHECK(Contains(page, "<title>a&lt;b&amp;&quot;c</title>"));
  CHECK(!Contains(page, "a<b"));
  CHECK(Count(page, "<img ") == 13);  // The page shows 1 photo, 1 map, 6 foci, 1 picture of blocks,
                                      // 2 ray-traced pictures and 2 errors.
  CHECK(Count(page, "src=\"data:image/jpeg;base64,/9j/") == 13);
  CHECK(Count(page, "src=") == 13);
  CHECK(Count(page, "http:") + Count(page, "https:") + Count(page, "<script") == 0);
  CHECK(Count(page, " alt=\"") == 13);
  CHECK(Count(page, " alt=\"\"") == 0);
  CHECK(Count(page, "<rect ") == 32);
  CHECK(Count(page, " dB, largest ") == 2);
  CHECK(Contains(page, "prefers-color-scheme: dark"));
  for (const char* element : {"html", "main", "section", "figure", "svg", "table", "details"}) {
    CHECK(Count(page, "<" + std::string(element) + ">") +
              Count(page, "<" + std::string(element) + " ") ==
          Count(page, "</" + std::string(element) + ">"));
  }
  CHECK(Call(folder, "view 'a<b&\"c' -o -").out == page);
  const Outcome over = Call(folder, "view 'a<b&\"c' -o 'a<b&\"c/disparity.pfm'");
  CHECK(over.code == 2);
  CheckErrorLine(over.err);
}

double Psnr(const TempFolder& folder, const std::string& names) {
  const Outcome outcome = Call(folder, "compare " + names);
  REQUIRE(outcome.out.rfind("PSNR ", 0) == 0);
  return std::atof(outcome.out.c_str() + 5);
}

TEST_CASE("views: each further side with a captured view raises the PSNR against ray tracing") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 256x192 --views 5 --transfer none --truth=-2.4,1");
  const auto error = [&](const std::string& views) {
    Succeed(folder, "refocus lf -o x.png --transfer none --focus=-2.4 --views " + views);
    return Psnr(folder, "lf/truth_dt-2.4_ut1.png x.png");
  };
  const double one = error("1"), five = error("5");
  const double pair = error("0,0:1,0"), other = error("0,0:-1,0");
  const double corner = error("0,0:1,0:0,1"), row = error("0,0:-1,0:1,0");
  CHECK(five > one + 2);
  // A pair sees behind edges on one of four sides. The gain of a pair in PSNR must be at least 15 %
  // of the gain of five views.
  CHECK(pair > one + 0.15 * (five - one));
  CHECK(other > one + 0.15 * (five - one));
  CHECK(corner > pair);
  CHECK(row > pair);
  CHECK(row > other);
  CHECK(five > row);
}

TEST_CASE(
    "views: a stereo pair in the Middlebury layout is read, and unknown disparities are filled") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 64x48 --views 0,0:1,0");
  LightField field = ValueOf(LoadLightField(folder.file("lf"), {}));
  fs::create_directory(folder.file("pair"));
  REQUIRE(WriteImage(folder.file("pair/im0.png"), field.views[0]) == "");
  REQUIRE(WriteImage(folder.file("pair/im1.png"), field.views[1]) == "");
  REQUIRE(WritePfm(folder.file("pair/disp0.pfm"), field.disparity) == "");
  Succeed(folder, "refocus lf -o a.png --focus 0");
  Succeed(folder, "refocus pair -o b.png --focus 0");
  CHECK(Call(folder, "compare a.png b.png").out == "PSNR inf, largest difference 0\n");
  field.disparity.values[70] = HUGE_VALF;
  REQUIRE(WritePfm(folder.file("pair/disp0.pfm"), field.disparity) == "");
  CHECK(Contains(Call(folder, "info pair").out, "1 invalid"));
  REQUIRE(WritePfm(folder.file("lf/disparity.pfm"), field.disparity) == "");
  // The map of a Middlebury pair may have infinite values. In the map of a light field, infinite
  // values are errors.
  CHECK(Contains(Call(folder, "refocus lf -o c.png --focus 0").err, "--fill-invalid"));
  Succeed(folder, "refocus lf -o c.png --focus 0 --fill-invalid");
  Succeed(folder, "refocus pair -o b.png --focus 0");
  CHECK(Call(folder, "compare b.png c.png").out == "PSNR inf, largest difference 0\n");
  CHECK(Call(folder, "refocus pair -o pair/im1.png --focus 0 --fill-invalid").code == 2);
}

}  // namespace
}  // namespace starfocus::writers_program_test
