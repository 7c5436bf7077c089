// SPDX-License-Identifier: Apache-2.0
// Tests the ways to look at a refocused picture: the page of `refocus --compare`, and pictures on
// terminals with `refocus --show`.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/base64.h"
#include "platform/image_io.h"
#include "platform/light_field.h"
#include "tests/programs/session.h"
#include "tests/support/processes.h"

namespace starfocus::looking_program_test {
namespace {

namespace fs = std::filesystem;

constexpr char kQuery[] = "\x1b[c\r\x1b[K";

// Writes a folder `<&>` with one view. Columns from two thirds of the width on have disparity 6,
// and the other columns have disparity -2.
void MakeField(const TempFolder& folder, int width, int height) {
  LightField field;
  field.views.emplace_back(width, height);
  field.disparity = {width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    const int x = i % width, y = i / width;
    for (int c = 0; c < 3; ++c) {
      field.views[0].pixels[size_t(3 * i + c)] = uint8_t((x / 5 + y / 5) % 2 == 0 ? 200 : 60 + c);
    }
    field.disparity.values.push_back(3 * x < 2 * width ? -2.0f : 6.0f);
  }
  SaveField(folder, "<&>", field);
}

void MakeSmallField(const TempFolder& folder) { MakeField(folder, 60, 40); }

TEST_CASE("looking: every session of page_sessions.txt succeeds") {
  RunSessions("programs/page_sessions.txt", {{"field", MakeSmallField}});
}

// Returns the pictures that a page contains, in their order.
std::vector<Image> PicturesIn(const std::string& page) {
  const std::string start = "data:image/jpeg;base64,";
  std::vector<Image> pictures;
  for (size_t at = page.find(start); at != std::string::npos; at = page.find(start, at + 1)) {
    const size_t begin = at + start.size();
    const auto bytes = DecodeBase64(page.substr(begin, page.find('"', begin) - begin));
    REQUIRE(bytes);
    pictures.push_back(ValueOf(DecodeImage("page", *bytes)).image);
  }
  return pictures;
}

std::string SizeOf(const Image& picture) {
  return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

// Returns the mean difference of the samples of two pictures of the same size.
double MeanDifference(const Image& a, const Image& b) {
  REQUIRE(SizeOf(a) == SizeOf(b));
  int64_t sum = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
  return double(sum) / double(a.pixels.size());
}

// Returns true if all samples of a pixel are within `most` of the expected colour.
bool IsNear(const Image& picture, int x, int y, const std::vector<int>& color, int most) {
  for (size_t c = 0; c < 3; ++c) {
    if (std::abs(picture.row(y)[3 * x + int(c)] - color[c]) > most) return false;
  }
  return true;
}

TEST_CASE("compare: the page has the picture before and after, its depth, and the focus") {
  TempFolder folder;
  MakeSmallField(folder);
  Succeed(folder, "refocus '<&>' --focus-at 50,10 -o out.png --compare page.html");
  const std::string page = Text(folder.file("page.html"));
  const std::vector<Image> pictures = PicturesIn(page);
  REQUIRE(pictures.size() == 4);
  CHECK(MeanDifference(pictures[0], Picture(folder, "<&>/view_+0.0_+0.0.png")) < 4);
  CHECK(MeanDifference(pictures[1], Picture(folder, "out.png")) < 4);
  CHECK(MeanDifference(pictures[0], pictures[1]) > 8);
  // The first and the last colour of the legend, and grey and orange for pixels out of and in
  // focus.
  CHECK(IsNear(pictures[2], 10, 20, {68, 1, 84}, 6));
  CHECK(IsNear(pictures[2], 55, 20, {253, 231, 37}, 6));
  CHECK(IsNear(pictures[3], 12, 22, {200, 200, 200}, 12));
  CHECK(IsNear(pictures[3], 52, 22, {233, 164, 80}, 12));
}

TEST_CASE("compare: large pictures are reduced, and their depth and focus stay aligned") {
  TempFolder wide, tall;
  MakeField(wide, 1800, 24);
  MakeField(tall, 24, 1800);
  const std::string arguments = "refocus '<&>' --focus 6 --aperture 0.2 --compare -";
  const std::vector<Image> flat = PicturesIn(Call(wide, arguments).out);
  const std::vector<Image> upright = PicturesIn(Call(tall, arguments).out);
  REQUIRE(flat.size() == 4);
  REQUIRE(upright.size() == 4);
  for (const size_t i : {0, 1, 2, 3}) {
    CHECK(SizeOf(flat[i]) == (i < 2 ? "1600x21" : "600x8"));
    CHECK(SizeOf(upright[i]) == (i < 2 ? "21x1575" : "8x600"));
  }
  CHECK(IsNear(flat[2], 395, 4, {68, 1, 84}, 20));
  CHECK(IsNear(flat[2], 404, 4, {253, 231, 37}, 20));
  const auto red = [&](int x) { return flat[3].row(4)[3 * x] - flat[3].row(4)[3 * x + 2]; };
  CHECK(red(395) < 30);
  CHECK(red(404) > 90);
}

TEST_CASE("compare, view: the legend and the colours have the same ends in a reduced map") {
  TempFolder folder;
  MakeField(folder, 1800, 24);
  ChangeMap(folder, "<&> 0,0,1,1=14");  // The reduced map does not contain this pixel.
  for (const char* call :
       {"refocus '<&>' --focus 6 --aperture 0.2 --compare -", "view '<&>' --aperture 0.2 -o -"}) {
    CAPTURE(call);
    const std::string page = Call(folder, call).out;
    CHECK(Contains(page, "<span>near 14.00</span>"));
    const Image depth = PicturesIn(page)[Contains(call, "view") ? 1 : 2];
    CHECK(depth.width == 600);
    CHECK(IsNear(depth, 200, 4, {68, 1, 84}, 20));
    // The disparity 6 is in the middle between -2 and 14.
    CHECK(IsNear(depth, 500, 4, {33, 145, 140}, 20));
  }
}

// Runs `refocus --show` on a terminal of 10 rows that sends `answer`.
TerminalRun Show(const TempFolder& folder, const std::string& answer, unsigned short width,
                 unsigned short height, const std::string& output = "-o out.png ") {
  const std::string command = "cd '" + folder.path() +
                              "' && TERM=test exec '" STARFOCUS_PROGRAM
                              "' refocus '<&>' --focus 6 " +
                              output + "--show 2>errors";
  return CallOnTerminal(command, {10, 40, width, height}, kQuery, answer);
}

// Returns the picture that escape sequences of the kitty protocol contain.
Image ReadKitty(const std::string& out) {
  std::string data;
  bool last = false;
  for (size_t at = out.find("\x1b_Ga=T"); at != std::string::npos && !last;
       at = out.find("\x1b_G", at + 1)) {
    const size_t payload = out.find(';', at) + 1, end = out.find("\x1b\\", at);
    REQUIRE(end - payload <= 4096);
    last = Contains(out.substr(at, payload - at), "m=0;");
    CHECK((last || (end - payload) % 4 == 0));
    data += out.substr(payload, end - payload);
  }
  CHECK(last);
  const auto bytes = DecodeBase64(data);
  REQUIRE(bytes);
  return ValueOf(DecodeImage("kitty", *bytes)).image;
}

TEST_CASE("show: a terminal with the kitty protocol gets the pixels, reduced if necessary" *
          doctest::test_suite("terminal")) {
  TempFolder folder;
  MakeSmallField(folder);
  const TerminalRun run = Show(folder, "\x1b_Gi=31;OK\x1b\\\x1b[?62;4c", 800, 600);
  CHECK(run.code == 0);
  CHECK(run.restored);
  CHECK(Text(folder.file("errors")) == "out.png: focus at disparity 6, f/1\n");
  CHECK(Count(run.out, kQuery) == 1);
  CHECK(Contains(run.out, ",q=2,"));  // Answers would appear as typed text.
  CHECK(ReadKitty(run.out).pixels == Picture(folder, "out.png").pixels);
  // The last of 10 rows is for the prompt: 20 - 2 = 18 pixels remain, and 60 * 18 / 40 = 27.
  const Image low = ReadKitty(Show(folder, "\x1b_Gi=31;OK\x1b\\\x1b[?62c", 800, 20).out);
  CHECK(SizeOf(low) == "27x18");
  // A terminal that states its size only in an answer.
  const Image narrow =
      ReadKitty(Show(folder, "\x1b_Gi=31;OK\x1b\\\x1b[4;600;30t\x1b[?62c", 0, 0).out);
  CHECK(SizeOf(narrow) == "30x20");
}

TEST_CASE("show: a terminal with sixels gets sixels that decode to the picture" *
          doctest::test_suite("terminal")) {
  TempFolder folder;
  MakeSmallField(folder);
  const TerminalRun run = Show(folder, "\x1b[?62;4;22c", 800, 600);
  if (Contains(Text(folder.file("errors")), "built without libsixel")) return;
  CHECK(run.code == 0);
  CHECK(run.restored);
  const size_t begin = run.out.find("\x1bP"), end = run.out.find("\x1b\\", begin);
  REQUIRE(end != std::string::npos);
  const std::string sixels = run.out.substr(begin, end + 2 - begin);
  CHECK(Contains(sixels, "q\"1;1;60;40"));
  CHECK(Contains(Show(folder, "\x1b[?2;0;30;400S\x1b[?62;4c", 800, 600).out, "q\"1;1;30;20"));
  CHECK(Contains(Show(folder, "\x1b[?2;0;300;10S\x1b[?62;4c", 800, 600).out, "q\"1;1;15;10"));
  if (std::system("command -v sixel2png >/dev/null") != 0) {
    MESSAGE("sixel2png is absent, so no other program decodes the sixels");
    return;
  }
  REQUIRE(WriteText(folder.file("sixels"), sixels) == "");
  REQUIRE(std::system(("cd '" + folder.path() + "' && sixel2png -i sixels -o shown.png").c_str()) ==
          0);
  // A sixel colour has 101 levels, and the colours are dithered.
  CHECK(MeanDifference(Picture(folder, "shown.png"), Picture(folder, "out.png")) < 6);
}

TEST_CASE(
    "show: on other terminals, the other outputs are written, and the terminal keeps its mode" *
    doctest::test_suite("terminal")) {
  TempFolder folder;
  MakeSmallField(folder);
  const std::string expected = "--show: expected a terminal with kitty or sixel graphics, found a ";
  for (const std::string answer : {"\x1b[?64;22c", ""}) {
    CAPTURE(answer);
    const std::string cause = answer.empty() ? "did not answer within a second" : "64;22";
    const TerminalRun run = Show(folder, answer, 800, 600, "-o out.png --compare page.html ");
    CHECK(run.code == 0);
    CHECK(run.restored);
    const std::string notes = Text(folder.file("errors"));
    CHECK(notes.rfind("<&>: the picture is not shown: " + expected + "terminal (TERM=test)", 0) ==
          0);
    CHECK(Contains(notes, cause));
    CHECK(Contains(notes, "\nout.png: focus at disparity 6, f/1\npage.html: focus at "));
    CHECK(PicturesIn(Text(folder.file("page.html"))).size() == 4);
    fs::remove(folder.file("out.png"));
    fs::remove(folder.file("page.html"));
    // Without another output, the terminal is rejected before any work.
    const TerminalRun alone = Show(folder, answer, 800, 600, "");
    CHECK(alone.code == 2);
    CHECK(alone.restored);
    const std::string error = Text(folder.file("errors"));
    CheckErrorLine(error);
    CHECK(Contains(error, expected + "terminal (TERM=test)"));
    CHECK(Contains(error, cause));
    CHECK(folder.count() == 2);
  }
  CHECK(Contains(Call(folder, "refocus '<&>' --focus 6 -o out.png --show").err, "is not shown"));
}

}  // namespace
}  // namespace starfocus::looking_program_test
