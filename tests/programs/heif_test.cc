// SPDX-License-Identifier: Apache-2.0
// Reads the seeds of tests/fuzz/corpus/heif: brands, sizes, auxiliary depth pictures and stereo
// groups of HEIF files. mattes_test.cc reads their mattes, photo_metadata_test.cc their colours,
// and photo_refusals_test.cc has the files that are rejected.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "platform/readers/capture.h"
#include "platform/readers/coded_size.h"
#include "platform/readers/heic.h"
#include "platform/readers/heif_boxes.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"

namespace starfocus::heif_test {
namespace {

using namespace photos;

Span SpanOf(const std::string& bytes) {
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

TEST_CASE("HEIF: the brands of still pictures and sequences are found anywhere in the list") {
  std::string file = Seed("heif/plain.avif");
  for (const std::string brand : {"avif", "avis", "miaf", "mif1"}) {
    CHECK(IsHeif(SpanOf(file.replace(8, 4, brand))));
  }
  CHECK(IsHeif(SpanOf(file.replace(8, 4, "abcd"))));  // other brands in the list remain
  CHECK(!IsHeif(SpanOf(Big(16, 4) + "ftypisom" + Big(0, 4))));
  CHECK(!IsHeif(SpanOf(file.substr(0, 7))));
}

TEST_CASE("HEIF: sizes are read from the headers of the codecs") {
  const HeifItems items = ReadHeifItems(SpanOf(Seed("heif/depth.heic"))).value();
  REQUIRE(items.size() == 4);
  CHECK(items.at(2).type == "grid");
  CHECK(items.at(2).inputs == std::vector<uint32_t>{1});
  CHECK(items.at(1).width == 64);
  const CodedSize hevc = HevcSize(items.at(1).configuration, items.at(1).head);
  CHECK(hevc.width == 64);
  CHECK(hevc.height == 64);
  const HeifItem item = ReadHeifItems(SpanOf(Seed("heif/plain.avif"))).value().at(1);
  const CodedSize av1 = Av1Size(item.configuration, item.head);
  CHECK(av1.width == 24);
  CHECK(av1.height == 16);
}

TEST_CASE("HEIF: the auxiliary depth picture is read, and more than 8 bits are noted") {
  const auto read = [](const std::string& file) {
    return ReadHeif("x", SpanOf(file), Near::kUnknown);
  };
  const std::string depth = Seed("heif/depth.heic");
#ifdef STARFOCUS_HAS_HEIF
  const DepthPhoto photo = ValueOf(read(depth));
  CHECK(photo.picture.width == 16);
  REQUIRE(photo.map.values.size() == 16 * 16);
  // The depth differs between the left and the right side.
  CHECK(std::fabs(photo.map.at(0, 8) - photo.map.at(15, 8)) > 0.8F);
  for (const size_t size : {size_t{30}, depth.size() / 2, depth.size() - 1}) {
    CHECK(Contains(read(depth.substr(0, size)), "the HEIF file is truncated"));
  }
  const DepthPhoto deep = ValueOf(read(Seed("heif/ten_bits.heic")));
  REQUIRE(deep.notes.size() == 1);
  CHECK(Contains(deep.notes[0], "the pixels have 10 bits for each colour"));
  // The levels of the file increase from 100 to 856 of 1023.
  CHECK(deep.picture.width == 64);
  CHECK(std::abs(deep.picture.row(9)[0] - 25) < 10);
  CHECK(std::abs(deep.picture.row(9)[3 * 63] - 213) < 10);
  CHECK(ValueOf(read(Seed("heif/plain.avif"))).notes.empty());
#else
  CHECK(Contains(read(depth), "built without libheif"));
#endif
}

TEST_CASE("HEIF: a spatial photo has the pictures of its stereo group") {
  const std::string file = Seed("heif/stereo.heic");
  CHECK(HeifStereoPair(SpanOf(file)) == std::vector<uint32_t>{2, 4});
  for (size_t size = 0; size < file.size(); size += 7) {
    const std::vector<uint32_t> ids = HeifStereoPair(SpanOf(file.substr(0, size)));
    CHECK((ids.empty() || ids.size() == 2));
  }
  // A group of two equal pictures is not a pair.
  const std::string first = file.substr(file.find("ster") + 16, 4);
  CHECK(HeifStereoPair(SpanOf(Changed(file, "ster", 16, first))).empty());
#ifdef STARFOCUS_HAS_HEIF
  const Capture capture =
      ValueOf(OpenCapture(STARFOCUS_SOURCE_DIR "/tests/fuzz/corpus/heif/stereo.heic", {}));
  CHECK(capture.format == "stereo pair (HEIF)");
  REQUIRE(capture.light_field.views.size() == 2);
  CHECK(capture.light_field.positions[1].u == 1);
  // The left picture is grey, and the right picture becomes brighter to the right.
  const uint8_t* left = capture.light_field.views[0].row(9);
  const uint8_t* right = capture.light_field.views[1].row(9);
  CHECK(std::abs(left[0] - left[3 * 39]) < 4);
  CHECK(right[3 * 39] - right[0] > 240);
#endif
}

}  // namespace
}  // namespace starfocus::heif_test
