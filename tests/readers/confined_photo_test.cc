// SPDX-License-Identifier: Apache-2.0
// Checks what a photo from a helper process, which a file may have taken over, can contain.
#include "platform/readers/confined_photo.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "platform/helper/helper.h"
#include "platform/text.h"
#include "tests/support/error_line.h"

namespace starfocus::confined_photo_test {
namespace {

TEST_CASE("confined_photo: texts arrive without control characters, and paths do not arrive") {
  ConfineDecoders();
  if (!DecodersAreConfined()) return;
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  const std::string evil = "a\x1b]0;owned\a\n\r\xc2\x9b" + all;
  DepthPhoto sent;
  sent.format = sent.map_problem = sent.depth_path = evil;
  sent.facts = {{evil, evil}};
  sent.notes = {evil, std::string(100000, 'x')};
  const Result<DepthPhoto> photo =
      Confined<DepthPhoto>("photo.jpg", [&] { return Result<DepthPhoto>(sent); });
  REQUIRE(photo);
  for (const std::string& text : {photo->format, photo->map_problem, photo->facts[0].first,
                                  photo->facts[0].second, photo->notes[0]}) {
    CHECK(text == Printable(evil));
    CHECK(text != evil);
  }
  CHECK(photo->notes[1].size() == 65536);
  CHECK(photo->depth_path.empty());
}

TEST_CASE("confined_photo: numbers of a photo that no decoder can find are rejected") {
  ConfineDecoders();
  if (!DecodersAreConfined()) return;
  using Field = double DepthPhoto::*;
  for (const Field field : {&DepthPhoto::focus_x, &DepthPhoto::focus_y, &DepthPhoto::subject_x,
                            &DepthPhoto::subject_y, &DepthPhoto::focal_35mm}) {
    for (const double value : {-1.0, 1e308, double{NAN}, double{INFINITY}, -1e-300}) {
      DepthPhoto photo;
      photo.*field = value;
      CHECK(Confined<DepthPhoto>("p", [&] { return Result<DepthPhoto>(photo); }).error() != "");
    }
  }
}

}  // namespace
}  // namespace starfocus::confined_photo_test
