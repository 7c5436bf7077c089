// SPDX-License-Identifier: Apache-2.0
// Opens portraits of phones: JPEG files that contain an original, a depth map, a confidence map, a
// gain map and a video behind the picture. All orders of the parts and all kinds of directories
// must give the original and the depth map.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "platform/readers/depth_photo_file.h"
#include "platform/readers/xmp.h"
#include "tests/support/opened_photo.h"
#include "tests/support/portrait_files.h"

namespace starfocus::container_test {
namespace {

using namespace photos;

// Returns a portrait whose blurred picture has the level 128.
std::string Portrait(const std::vector<Part>& parts, Directories directories, Lengths lengths,
                     size_t padding = 0) {
  static const std::string blurred = Photo();
  return photos::Portrait(blurred, parts, directories, lengths, padding);
}

std::vector<Part> Parts() { return PortraitParts(kWidth, kHeight); }

// Returns an empty text if `file` contains a picture of the level `level` and the ramp of the depth
// map, and otherwise the difference.
std::string Difference(const std::string& file, int level = kOriginalLevel) {
  const Span span = {reinterpret_cast<const uint8_t*>(file.data()), file.size()};
  const Result<DepthPhoto> photo = DecodeDepthPhoto("photo.jpg", span, true, Near::kUnknown);
  if (!photo) return photo.error().line();
  if (photo->map.values.empty()) return photo->map_problem;
  const int found = photo->picture.row(5)[30];
  if (std::abs(found - level) > 2) return "a picture of level " + std::to_string(found);
  const double near = double(photo->map.at(0, 3)), far = double(photo->map.at(kWidth - 1, 3));
  if (std::fabs(near - 1 / 0.5) > 0.05 || std::fabs(far - 1 / 4.0) > 0.05) {
    return "inverse distances from " + std::to_string(near) + " to " + std::to_string(far);
  }
  if (photo->is_blurred == (level == kOriginalLevel)) return "the wrong picture as the blurred one";
  for (const auto& fact : photo->facts) {
    if (fact.first == "gain map") return "";
  }
  return "no gain map";
}

TEST_CASE("portraits: all orders of the parts give the original and the depth map") {
  if (!CanReadXmp()) return;
  const std::vector<Part> parts = Parts();
  std::vector<size_t> order = {0, 1, 2, 3, 4};
  do {
    std::vector<Part> placed;
    std::string name;
    for (const size_t k : order) {
      placed.push_back(parts[k]);
      name += parts[k].semantic + " ";
    }
    CAPTURE(name);
    const size_t padding = order[0];  // several sizes
    for (const Lengths lengths : {Lengths::kRight, Lengths::kMissing, Lengths::kWrong}) {
      for (const Directories directories :
           {Directories::kBoth, Directories::kLater, Directories::kRepeated}) {
        CHECK(Difference(Portrait(placed, directories, lengths, padding)) == "");
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("portraits: a gain map without XMP of its own is known by the directory") {
  if (!CanReadXmp()) return;
  for (const bool other_length : {false, true}) {
    std::vector<Part> parts = Parts();
    parts[0].bytes = Encode(Ramp(kWidth / 2, kHeight / 2), ".jpg");
    if (other_length) std::swap(parts[0], parts[2]);
    CHECK(Difference(Portrait(parts, Directories::kBoth, Lengths::kRight)) == "");
    // The standard places the gain map right behind the first picture.
    if (other_length) continue;
    CHECK(Difference(Portrait(parts, Directories::kBoth, Lengths::kMissing)) == "");
  }
  // ISO 21496-1 describes a gain map by a segment, which the photo has as well without content.
  std::vector<Part> parts = Parts();
  const std::string iso = std::string("urn:iso:std:iso:ts:21496:-1") + std::string(5, '\0');
  parts[0].bytes = Insert(Encode(Ramp(kWidth / 2, kHeight / 2), ".jpg"),
                          Segment(0xe2, iso + std::string(60, '\1')));
  parts[0].semantic = "Other";
  parts[1].bytes = Insert(parts[1].bytes, Segment(0xe2, iso));
  CHECK(Difference(Portrait(parts, Directories::kBoth, Lengths::kMissing)) == "");
}

TEST_CASE("portraits: an original that is itself a file with a gain map is one item") {
  if (!CanReadXmp()) return;
  std::vector<Part> parts = Parts();
  parts[1].bytes = Insert(parts[1].bytes,
                          XmpSegment(Packet("xmlns:hdrgm=\"http://ns.adobe.com/hdr-gain-map/1.0/\"",
                                            "hdrgm:Version=\"1.0\"", "<Directory/>"))) +
                   parts[0].bytes;
  CHECK(Difference(Portrait(parts, Directories::kBoth, Lengths::kRight)) == "");
}

TEST_CASE("portraits: without an original, or with another picture, a note reports the blur") {
  if (!CanReadXmp()) return;
  std::vector<Part> parts = Parts();
  parts[1].bytes = Encode(Plain(kHeight, kWidth, kOriginalLevel), ".jpg");
  Capture capture;
  const std::string other = Portrait(parts, Directories::kBoth, Lengths::kRight);
  CHECK(Difference(other, 128) == "");
  REQUIRE(Open(other, &capture) == "");
  CHECK(HasNote(capture, "the sharp picture in the file is ignored"));
  CHECK(HasNote(capture, "already blurred"));
  parts.erase(parts.begin() + 1);
  const std::string none = Portrait(parts, Directories::kBoth, Lengths::kRight);
  CHECK(Difference(none, 128) == "");
  REQUIRE(Open(none, &capture) == "");
  CHECK(HasNote(capture, "already blurred"));
}

TEST_CASE("portraits: a gain map alone is never depth") {
  if (!CanReadXmp()) return;
  Capture capture;
  for (const Lengths lengths : {Lengths::kRight, Lengths::kMissing, Lengths::kWrong}) {
    const std::vector<Part> parts = {Parts()[0]};
    // The packet describes a depth map that is not in the file.
    CHECK(Contains(Open(Portrait(parts, Directories::kBoth, lengths), &capture),
                   "no complete picture there"));
  }
}

}  // namespace
}  // namespace starfocus::container_test
