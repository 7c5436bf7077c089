// SPDX-License-Identifier: Apache-2.0
#include "platform/pfm.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "platform/file.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"

namespace starfocus::pfm_test {
namespace {

Result<FloatMap> ReadText(const std::string& text) {
  TempFolder folder;
  const std::string path = folder.file("map.pfm");
  REQUIRE(WriteFile(path, Bytes(text.begin(), text.end())) == "");
  return ReadPfm(path);
}

TEST_CASE("pfm: maps of either byte order are read back exactly") {
  TempFolder folder;
  FloatMap map;
  map.width = 3;
  map.height = 2;
  const float infinity = std::numeric_limits<float>::infinity();
  map.values = {1.5f, -2.25f, 1e-30f, infinity, -infinity, 7};
  for (ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
    REQUIRE(WritePfm(folder.file("a.pfm"), map, order) == "");
    FloatMap back = ValueOf(ReadPfm(folder.file("a.pfm")));
    CHECK(back.width == 3);
    CHECK(back.height == 2);
    CHECK(back.values == map.values);
  }
  CHECK(folder.count() == 1);
}

TEST_CASE("pfm: rows are stored from bottom to top, and the sign of the scale is the byte order") {
  // 1.0f is 3f800000, 2.0f is 40000000.
  const std::string one("\0\0\x80\x3f", 4), two("\0\0\0\x40", 4);
  const std::string big_one("\x3f\x80\0\0", 4), big_two("\x40\0\0\0", 4);
  FloatMap map = ValueOf(ReadText("Pf\n1 2\n-1.0\n" + one + two));
  CHECK(map.at(0, 0) == 2);
  CHECK(map.at(0, 1) == 1);
  map = ValueOf(ReadText("Pf\n1 2\n0.5\n" + big_one + big_two));
  CHECK(map.at(0, 0) == 2);
  CHECK(map.at(0, 1) == 1);
  map = ValueOf(ReadText("Pf 1 1 -1\n" + std::string("\0\0\xc0\x7f", 4)));
  CHECK(std::isnan(map.at(0, 0)));
}

TEST_CASE("pfm: bytes of white space and # after the header are data") {
  CHECK(ReadText("Pf\n1 1\n-1\n\n \t#") == "");
  CHECK(ReadText("Pf\n1 1\n-1\n####") == "");
}

TEST_CASE("pfm: malformed files cause one-line errors") {
  const std::string bad[] = {"",
                             "Pf",
                             "PF\n1 1\n-1\n0123456789ab",
                             "P6\n1 1\n255\nabc",
                             "Pf\n0 1\n-1\n",
                             "Pf\n1 0\n-1\n",
                             "Pf\n-1 1\n-1\nabcd",
                             "Pf\n1 -1\n-1\nabcd",
                             "Pf\n65536 1\n-1\nabcd",
                             "Pf\n99999999999999999999 1\n-1\nabcd",
                             "Pf\n65535 65535\n-1\nabcd",
                             "Pf\n1.5 1\n-1\nabcd",
                             "Pf\n1 1\n0\nabcd",
                             "Pf\n1 1\nnan\nabcd",
                             "Pf\n1 1\ninf\nabcd",
                             "Pf\n1 1\nx\nabcd",
                             "Pf\n1 1\n-1",
                             "Pf\n1 1\n-1\nabc",
                             "Pf\n1 1\n-1\nabcde",
                             "Pf\n1 1\n-1\r\nabcd"};
  for (const std::string& text : bad) {
    CAPTURE(text);
    const std::string error = ReadText(text).error().line();
    CHECK(Contains(error, ": expected "));
    CHECK(!Contains(error, "\n"));
  }
}

}  // namespace
}  // namespace starfocus::pfm_test
