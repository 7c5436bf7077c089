// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/apple_depth.h"

#include <utility>

#include "platform/levels.h"
#include "platform/readers/apple_mattes.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/multi_picture.h"

namespace starfocus {
namespace {

const std::string kPixels = "http://ns.apple.com/pixeldatainfo/1.0/|";
const std::string kDepth = "http://ns.apple.com/depthData/1.0/|";

// Returns the type of an auxiliary picture. The portrait effects matte has the type "depth" like
// maps of distances, and a subtype.
std::string TypeOf(const XmpNode& xmp) {
  for (const char* name : {"AuxiliaryImageSubType", "AuxiliaryImageType"}) {
    const std::string* type = FindProperty(xmp, kPixels + name);
    if (type != nullptr) return *type;
  }
  return "";
}

bool IsMap(const std::string& type) { return type == "disparity" || type == "depth"; }

// Parses the XMP packets of an auxiliary picture. Skips packets that are not well-formed.
XmpNode ReadPackets(const JpegParts& parts) {
  XmpNode root;
  for (const Span& packet : parts.xmp) {
    const char* text = reinterpret_cast<const char*>(packet.data);
    Result<XmpNode> node = ParseXmp("", text, packet.size);
    if (node) root.children.push_back(std::move(*node));
  }
  return root;
}

void NoteIndex(const JpegParts& parts, const MultiPicture& picture, DepthPhoto* photo) {
  if (picture.indexed) return;
  photo->notes.push_back(
      parts.multi_picture.empty()
          ? "the file has no multi-picture index: the depth map was found behind the picture"
          : "the wrong multi-picture index is ignored: the depth map was found behind the "
            "picture");
}

}  // namespace

void UnderstandApple(const XmpNode& xmp, DepthPhoto* photo) {
  const bool disparity = TypeOf(xmp) != "depth";
  const std::string* low = FindProperty(xmp, kPixels + "FloatMinValue");
  const std::string* high = FindProperty(xmp, kPixels + "FloatMaxValue");
  const std::optional<double> from = XmpNumber(low), to = XmpNumber(high);
  if (!from || !to || *from < 0 || *to <= *from) {
    if (from && to) {
      photo->notes.push_back("the range of the depth map is ignored (from " + *low + " to " +
                             *high + "): levels of the map define only an order of depth");
    }
    TellMap(std::string(disparity ? "disparities" : "depths") + " without a range", photo);
    ToOrder(disparity ? Near::kWhite : Near::kBlack, photo);
    return;
  }
  ToRange(*from, *to, &photo->map);
  if (!disparity) Invert(&photo->map);
  const std::string* accuracy = FindProperty(xmp, kDepth + "Accuracy");
  const bool absolute = accuracy != nullptr && *accuracy == "absolute";
  photo->meaning = absolute ? MapMeaning::kInverseMetres : MapMeaning::kInverse;
  TellMap(std::string(disparity ? "disparities" : "depths") + " from " + *low + " to " + *high +
              (disparity ? " per metre, " : " metres, ") +
              (absolute ? "absolute" : "correct up to a factor"),
          photo);
}

Error ReadAppleJpeg(Span file, const JpegParts& parts, std::vector<AppendedPicture> appended,
                    DepthPhoto* photo) {
  if (!CanReadXmp()) return {};
  Error error;
  const MultiPictures listed = ListMultiPictures(file, parts, std::move(appended));
  for (const MultiPicture& picture : listed.pictures) {
    const XmpNode xmp = ReadPackets(picture.parts);
    const std::string type = TypeOf(xmp);
    if (!IsMap(type) || !photo->map.values.empty()) continue;
    const Bytes bytes(picture.file.data, picture.file.data + picture.file.size);
    error = DecodeLevels("auxiliary picture", bytes).MoveTo(&photo->map);
    if (error) continue;
    photo->format = "Apple depth photo (JPEG)";
    NoteIndex(parts, picture, photo);
    UnderstandApple(xmp, photo);
  }
  if (!photo->map.values.empty()) return {};
  if (error || !listed.missing) return error;
  return Expected("multi-picture index", "all listed pictures in the file",
                  "a missing or truncated picture");
}

void ReadAppleMattes(const std::vector<AppendedPicture>& appended, DepthPhoto* photo) {
  if (!CanReadXmp()) return;
  std::vector<AuxiliaryPicture> pictures;
  for (const AppendedPicture& picture : appended) {
    const Span file = picture.file;
    pictures.push_back({TypeOf(ReadPackets(picture.parts)), [file](const std::string& where) {
                          return DecodeLevels(where, Bytes(file.data, file.data + file.size));
                        }});
  }
  ChooseMatte(pictures, photo);
  if (photo->map.values.empty() && !photo->matte.values.empty()) {
    photo->format = "Apple photo with a matte (JPEG)";
  }
}

}  // namespace starfocus
