// SPDX-License-Identifier: Apache-2.0
// usage: photo_seeds tests/fuzz/corpus
// Writes the seeds of the fuzz targets for photos, as the specifications of the formats define
// them.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "tests/support/portrait_files.h"

namespace {

using namespace starfocus::photos;

const std::string kRange =
    "GDepth:Format=\"RangeInverse\" GDepth:Near=\"1\" GDepth:Far=\"9\" GDepth:Units=\"m\" "
    "GFocus:FocalPointX=\"0.5\" GFocus:FocalPointY=\"0.5\"";
const std::string kDisparities =
    "<apdi:AuxiliaryImageType>disparity</apdi:AuxiliaryImageType>"
    "<apdi:FloatMinValue>1</apdi:FloatMinValue><apdi:FloatMaxValue>4</apdi:FloatMaxValue>"
    "<depthData:Accuracy>absolute</depthData:Accuracy>";
const std::string kMatte =
    "<apdi:AuxiliaryImageType>depth</apdi:AuxiliaryImageType>"
    "<apdi:AuxiliaryImageSubType>portraiteffectsmatte</apdi:AuxiliaryImageSubType>";
const std::string kMap =
    "DepthMap:Format=\"RangeLinear\" DepthMap:Near=\"1\" DepthMap:Far=\"9\" "
    "DepthMap:Units=\"Meters\"";

const std::string kDiopters =
    "DepthMap:Format=\"RangeInverse\" DepthMap:Near=\"0.1\" DepthMap:Far=\"0.2\" "
    "DepthMap:Units=\"Diopters\"";
const std::string kCaptions = "xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\"";

void WritePhotos(const std::string& folder) {
  const std::string jpeg = Encode(Ramp(8, 6), ".jpg"), png = Encode(Ramp(4, 3), ".png");
  const std::string data = "GDepth:Data=\"" + Base64(png) + "\"";
  Write(folder + "/gdepth.jpg", Gdepth(Insert(jpeg, ExifSegment(6, 26)), kRange, data, 150));
  Write(folder + "/gdepth16.jpg",
        Gdepth(jpeg, kRange, "GDepth:Data=\"" + Base64(Png16(2, 2, {0, 9, 99, 65535})) + "\""));
  Write(folder + "/dynamic.jpg", DynamicDepth(jpeg, png, kMap));
  Write(folder + "/apple.jpg", MultiPicture(jpeg, AppleMap(jpeg, kDisparities)));
  Write(folder + "/mattes.jpg",
        MultiPicture(jpeg, AppleMap(jpeg, kMatte)) + AppleMap(jpeg, kDisparities));
  // Unusual photos: no index, a wrong index, a pair, diopters with wrong lengths, two packets, and
  // a profile with unordered parts.
  Write(folder + "/no_index.jpg", jpeg + AppleMap(jpeg, kDisparities));
  Write(folder + "/wrong_index.jpg",
        MultiPicture(jpeg, AppleMap(jpeg, kDisparities), {true, 2, 9}));
  Write(folder + "/pair.jpg", MultiPicture(jpeg, jpeg, {true, 32, 0, 0x020002}));
  Write(folder + "/diopters.jpg", DynamicDepth(jpeg, png, kDiopters, 5));
  std::vector<Part> portrait = PortraitParts(8, 6);
  Write(folder + "/portrait.jpg", Portrait(jpeg, portrait, Directories::kLater, Lengths::kRight));
  std::vector<Part> masked = portrait;
  masked[2].semantic = "Segmentation";
  masked[2].uri = "android/mask";
  Write(folder + "/mask.jpg", Portrait(jpeg, masked, Directories::kLater, Lengths::kRight));
  portrait.erase(portrait.begin() + 3, portrait.end());
  Write(folder + "/two_directories.jpg",
        Portrait(jpeg, portrait, Directories::kBoth, Lengths::kMissing, 2));
  const std::string chroma = Big(31270, 4) + Big(32900, 4) + Big(64000, 4) + Big(33000, 4) +
                             Big(21000, 4) + Big(71000, 4) + Big(15000, 4) + Big(6000, 4);
  const std::string given = Chunk("gAMA", Big(55556, 4)) + Chunk("cHRM", chroma);
  Write(folder + "/given_colours.png", Png(1, 1, {8, 6, given}, std::string("\1\2\3\4", 4), 4));
  Write(folder + "/code_points.png",
        Png(1, 1, {8, 2, Chunk("cICP", std::string("\x09\x10\0\1", 4))}, "abc", 3));
  const std::vector<std::string> parts = ProfileSegments(Profile(200), 2);
  Write(folder + "/captions.jpg",
        Insert(jpeg, parts[1] + IptcSegment("\x1c\2\x78") + parts[0] +
                         XmpSegment(Packet(kCaptions, "xmp:Rating=\"4\"")) +
                         XmpSegment(Packet(kGoogle, kRange + " " + data))));
}

void WritePackets(const std::string& folder) {
  const std::string png = Encode(Ramp(4, 3), ".png");
  Write(folder + "/apple", std::string(1, '\0') + Packet(kApple, "", kDisparities));
  Write(folder + "/extended", "\1" + Packet(kGoogle, "GDepth:Data=\"" + Base64(png) + "\""));
  Write(folder + "/gdepth",
        "\2" + Packet(kGoogle, kRange + " GDepth:Data=\"" + Base64(png) + "\""));
  Write(folder + "/captions",
        "\3" + Packet(kCaptions + " xmlns:dc=\"http://purl.org/dc/elements/1.1/\"",
                      "xmp:Rating=\"4\"",
                      "<dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">a&amp;b</rdf:li></rdf:Alt>"
                      "</dc:title>"));
  const std::string dynamic = DynamicDepth(Encode(Ramp(8, 8), ".jpg"), png, kMap);
  const size_t begin = dynamic.find("<x:xmpmeta"), end = dynamic.find("</x:xmpmeta>");
  Write(folder + "/dynamic", "\2" + dynamic.substr(begin, end + 12 - begin));
}

void WriteLayouts(const std::string& folder) {
  Write(folder + "/row", "nIMG_01.png\nIMG_02.png\nIMG_03.png");
  std::string grid = "n", stanford = "n";
  for (int k = 0; k < 9; ++k) {
    const std::string at = std::to_string(k / 3) + "_" + std::to_string(k % 3);
    grid += (k > 0 ? "\nv" : "v") + at + ".png";
    stanford += (k > 0 ? "\nout_0" : "out_0") + at + "_-38" + std::to_string(k) + ".9_7.1_.png";
  }
  Write(folder + "/grid", grid);
  Write(folder + "/stanford", stanford);
  Write(folder + "/keys", "k[a]\nbaseline_mm = 5\nfocal_length_mm=100.0\ncam0=[1 0; 2]\r\n");
  const std::string jpeg = Encode(Ramp(8, 6), ".jpg");
  Write(folder + "/parts",
        MultiPicture(Gdepth(Insert(jpeg, ExifSegment(3, 50)), kRange, "", 100), jpeg));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string corpus = argv[1];
  try {
    for (const char* target : {"photo", "xmp", "layouts"}) {
      std::filesystem::create_directories(corpus + "/" + target);
    }
    WritePhotos(corpus + "/photo");
    WritePackets(corpus + "/xmp");
    WriteLayouts(corpus + "/layouts");
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "photo_seeds: %s\n", failure.what());
    return 1;
  }
  return 0;
}
