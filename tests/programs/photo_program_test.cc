// SPDX-License-Identifier: Apache-2.0
// Runs the program on typical inputs. The program refocuses, describes and imports photos, and must
// not overwrite an input file. The program exiftool checks the GDepth files that the tests write.
// The suite data_sets tests real photographs.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "platform/image_io.h"
#include "platform/levels.h"
#include "platform/light_field.h"
#include "platform/pfm.h"
#include "platform/readers/capture.h"
#include "platform/readers/heic.h"
#include "platform/readers/xmp.h"
#include "platform/runner.h"
#include "tests/programs/session.h"
#include "tests/support/opened_photo.h"
#include "tests/support/photo_files.h"

namespace starfocus::photo_program_test {
namespace {

namespace fs = std::filesystem;
using namespace photos;

// Returns a photo of 96 x 64 pixels whose left half is near, with a map of half the size.
std::string GdepthPhoto() {
  Image map = Plain(48, 32, 255), picture = Ramp(96, 64);
  for (int y = 0; y < map.height; ++y) std::fill_n(map.row(y), 3 * 24, uint8_t{0});
  for (int y = 0; y < picture.height; y += 4)
    std::fill_n(picture.row(y), picture.stride(), uint8_t{30});
  return Gdepth(Encode(picture, ".jpg"),
                kInverse +
                    "GDepth:Units=\"m\" GDepth:Mime=\"image/png\" "
                    "GFocus:FocalPointX=\"0.25\" GFocus:FocalPointY=\"0.5\"",
                Data(Encode(map, ".png")));
}

// Writes a grey photo, a photo of noise and depth pictures. In the first picture, the left half is
// near. In the second picture, all rows except the top rows are near.
void MakePhotoAndMap(const TempFolder& folder) {
  Image near_left(96, 64);
  for (int y = 0; y < 64; ++y) std::fill_n(near_left.row(y), 3 * 48, uint8_t{255});
  Write(folder.file("a.jpg"), Encode(Ramp(96, 64), ".jpg"));
  Write(folder.file("a-depth.png"), Encode(near_left, ".png"));
  Write(folder.file("a.png"), Encode(Ramp(96, 64), ".png"));
  Write(folder.file("noise.png"), Encode(Noise(96, 64), ".png"));
  Image map = Plain(96, 64, 255);
  for (int y = 0; y < 20; ++y) std::fill_n(map.row(y), map.stride(), uint8_t{0});
  Write(folder.file("map.png"), Encode(map, ".png"));
}

// Writes pictures of one level, which identify the views of a folder, and maps of one disparity.
void MakeViews(const TempFolder& folder) {
  for (int level = 0; level < 100; ++level) {
    Write(folder.file(std::to_string(level)), Encode(Plain(4, 3, level), ".ppm"));
  }
  FloatMap map = {4, 3, std::vector<float>(12, 0.75F)};
  Require(WritePfm(folder.file("map.pfm"), map));
  map.values[0] = HUGE_VALF;
  Require(WritePfm(folder.file("inf.pfm"), map));
}

#ifdef STARFOCUS_HAS_EXIF
// Adds photos whose EXIF contains an orientation and a subject, and may contain the size of the
// picture that the subject refers to.
void MakeSubjects(const TempFolder& folder) {
  MakePhotoAndMap(folder);
  constexpr int kArea = 0x9214, kLocation = 0xa214;  // tags of EXIF
  const std::pair<const char*, std::string> kPhotos[] = {
      {"point", SubjectSegment(1, kArea, {72, 20})},
      {"circle", SubjectSegment(1, kArea, {72, 20, 9})},
      {"box", SubjectSegment(1, kArea, {72, 20, 9, 5})},
      {"location", SubjectSegment(1, kLocation, {72, 20})},
      {"turned3", SubjectSegment(3, kArea, {72, 20}, 96, 64)},
      {"turned6", SubjectSegment(6, kArea, {72, 20, 9, 5})},
      {"location6", SubjectSegment(6, kLocation, {72, 20, 5}, 96, 64)},
      {"turned8", SubjectSegment(8, kArea, {72, 20})},
      {"half", SubjectSegment(1, kArea, {144, 40}, 192, 128)},
      {"half6", SubjectSegment(6, kLocation, {144, 40}, 192, 128)},
      {"cropped", SubjectSegment(1, kArea, {72, 20}, 128, 128)},
      {"outside", SubjectSegment(1, kArea, {96, 20})},
      {"number", SubjectSegment(1, kArea, {72})},
      {"sized", SubjectSegment(1, kArea, {72, 20}, 96, 64)},
      {"sized_location", SubjectSegment(1, kLocation, {72, 20}, 96, 64)},
      {"sized_box", SubjectSegment(1, kArea, {72, 20, 5, 9}, 96, 64)},
      {"doubled", SubjectSegment(1, kArea, {72, 20}, 192, 128)}};
  const std::string photo = Text(folder.file("a.jpg"));
  for (const auto& [name, exif] : kPhotos) {
    Write(folder.file(name + std::string(".jpg")), Insert(photo, exif));
  }
}
#endif

TEST_CASE("photos: every session of the tables succeeds") {
  const auto write_pair = [](const TempFolder& folder) {
    Write(folder.file("pair.mpo"), MultiPicture(Photo(), Encode(Ramp(40, 24), ".jpg")));
  };
  const auto write_photo = [](const TempFolder& folder) {
    Write(folder.file("photo.jpg"), GdepthPhoto());
  };
  const auto copy_seeds = [](const TempFolder& folder) {
    for (const std::string name : {"mask.jpg", "mattes.jpg"}) {
      Write(folder.file(name), Seed("photo/" + name));
    }
  };
  RunSessions("programs/photos.txt", {{"MPO", write_pair}, {"photo and map", MakePhotoAndMap}});
  for (const char* table : {"programs/depth_commands.txt", "programs/mattes.txt"}) {
    RunSessions(table, {{"photo and map", MakePhotoAndMap}});
  }
  RunSessions("programs/layouts.txt", {{"views", MakeViews}});
#ifdef STARFOCUS_HAS_EXIF
  RunSessions("programs/subjects.txt", {{"subjects", MakeSubjects}});
#endif
  if (!CanReadXmp()) return;
  RunSessions("programs/depth_photos.txt",
              {{"GDepth photo", write_photo}, {"stored mattes", copy_seeds}});
}

TEST_CASE("photos: the depth command runs if the parent of the program ignores SIGCHLD") {
  TempFolder folder;
  MakePhotoAndMap(folder);
  std::filesystem::remove(folder.file("a-depth.png"));
  CHECK(RunShell(folder, "env --ignore-signal=CHLD '" STARFOCUS_PROGRAM
                         "' refocus a.png -o x.png --near white --depth-timeout 5 "
                         "--depth-command 'cp map.png {output}; : {input}'") == 0);
}

#ifdef STARFOCUS_HAS_HEIF
TEST_CASE("photos: HEIC is read from standard input") {
  TempFolder folder;
  Succeed(folder,
          "refocus - -o a.png <'" STARFOCUS_SOURCE_DIR "/tests/fuzz/corpus/heif/depth.heic'");
  CHECK(fs::exists(folder.file("a.png")));
}
#endif

// Returns what exiftool prints.
std::string Exiftool(const TempFolder& folder, const std::string& arguments) {
  REQUIRE(std::system(
              ("cd '" + folder.path() + "' && exiftool " + arguments + " >printed").c_str()) == 0);
  return Text(folder.file("printed"));
}

bool HasExiftool() { return std::system("command -v exiftool >/dev/null 2>&1") == 0; }

TEST_CASE("photos: captions are copied to every output, and only depth photos declare a map") {
  if (!CanReadXmp()) return;
  TempFolder folder;
  const std::string names =
      "xmlns:dc=\"http://purl.org/dc/elements/1.1/\" xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\"";
  const std::string title =
      "<dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">Cats &amp; dogs</rdf:li></rdf:Alt>"
      "</dc:title>";
  const std::string rating = "<xmp:Rating>4</xmp:Rating>";
  Write(folder.file("in.jpg"),
        Insert(GdepthPhoto(), IptcSegment(std::string("\x1c\x02\x78\0\4cats", 9)) +
                                  XmpSegment(Packet(names, "xmp:Rating=\"4\"", title))));
  Write(folder.file("map.png"), Encode(Plain(96, 64, 255), ".png"));
  PictureOptions options;
  options.metadata.xmp =
      "<rdf:Description rdf:about='' " + names + ">" + rating + title + "</rdf:Description>";
  const bool has_exiftool = HasExiftool();
  for (const std::string in : {"in.jpg", "in.png", "in.webp"}) {
    const bool is_jpeg = in == "in.jpg";
    // Builds without libwebp or libpng write no WebP files or no captions in PNG files.
    if (!is_jpeg && WriteImage(folder.file(in), Ramp(96, 64), options) != "") continue;
    for (const std::string out : {"out.jpg", "out.png", "out.webp", "deep.jpg"}) {
      CAPTURE(in);
      CAPTURE(out);
      const bool is_deep = out == "deep.jpg";
      const std::string depth = is_jpeg ? "" : " --depth map.png --near white",
                        saved = is_deep ? " --depth-photo" : "";
      const Outcome outcome =
          Call(folder, "refocus " + in + depth + " --focus-at 48,40 -o " + out + saved);
      if (Contains(outcome.err, "libwebp") || Contains(outcome.err, "libpng")) continue;
      REQUIRE(outcome.code == 0);
      const std::string file = Text(folder.file(out));
      CHECK(Contains(file, "Cats &amp; dogs"));
      CHECK(Contains(file, rating));
      CHECK(Contains(file, "GDepth") == is_deep);
      const bool has_iptc = is_jpeg && Contains(out, ".jpg");
      CHECK((!has_iptc || Contains(file, std::string(1, '\4') + "cats")));
      if (!is_jpeg || !has_exiftool) continue;
      const std::string text =
          Exiftool(folder, "-s -G -Title -Rating -Caption-Abstract -Warning " + out);
      CHECK(Contains(text, "Cats & dogs"));
      CHECK(Contains(text, "Rating                          : 4"));
      CHECK(!Contains(text, "Warning"));
      if (has_iptc) CHECK(Contains(text, ": cats"));
    }
  }
}

// Writes a folder of one view: a random picture whose disparities decrease from `high` to `low` in
// steps.
void MakeSteps(const TempFolder& folder, const std::string& name, float low, float high) {
  constexpr int kSteps = 8;
  LightField field;
  field.positions = {{0, 0}};
  field.views = {Noise(128, 96)};
  for (uint8_t& value : field.views[0].pixels) value = static_cast<uint8_t>(64 + value / 2);
  field.disparity = {128, 96, {}};
  for (int k = 0; k < 128 * 96; ++k) {
    const int step = k % 128 / (128 / kSteps);
    field.disparity.values.push_back(high - (high - low) * static_cast<float>(step) / (kSteps - 1));
  }
  ThreadRunner runner(1);
  REQUIRE(SaveLightField(folder.file(name), field, &runner) == "");
}

TEST_CASE("photos: a saved depth photo keeps the disparities and the blur of its source") {
  if (!CanReadXmp()) return;
  const struct {
    float low, high;
    const char* widest;
    double factor, moved;  // factor and offset of the disparities in the saved photo
  } kinds[] = {{33, 97, "", 1, 0},
               {-40, -3, "", 1, 0},
               {0, 1.5F, "", 1, 0},
               {7, 7, "", 1, 0},
               {-6, 30, " --widest 2.5", 2.5, 0},
               {300, 340, " --widest 2", 2, -180}};
  for (const auto& kind : kinds) {
    CAPTURE(kind.low);
    TempFolder folder;
    MakeSteps(folder, "lf", kind.low, kind.high);
    const std::string lens = " --focus-at 40,40 --f-stop 4 -o ",
                      refocus = "refocus lf" + std::string(kind.widest) + lens;
    Succeed(folder, refocus + "saved.jpg --quality 100 --depth-photo");
    Capture capture = ValueOf(OpenCapture(folder.file("saved.jpg"), {}));
    const FloatMap& map = capture.light_field.disparity;
    const double step = kind.factor * double(kind.high - kind.low) / 255;
    for (const auto& [x, given] : {std::pair<int, float>{0, kind.high}, {127, kind.low}}) {
      CHECK(std::fabs(double(map.at(x, 9)) - (kind.factor * double(given) + kind.moved)) <=
            0.51 * step + 1e-3);
    }
    CHECK(capture.care == MapCare::kNone);
    CHECK(capture.focus == doctest::Approx(map.at(40, 40)).epsilon(0.01));
    // The refocused saved photo must have the same blur as the refocused source. A blur larger by a
    // quarter would change pixels by several levels.
    Succeed(folder, refocus + "first.png");
    Succeed(folder, "refocus saved.jpg" + lens + "again.png");
    CHECK(PsnrOf(folder, "first.png", "again.png") > 44.6);  // a root mean square of 1.5 levels
  }
  TempFolder folder;
  MakeSteps(folder, "lf", -300, 300);
  CheckRefused(folder, "refocus lf --focus 0 --widest 2 --f-stop 8 -o a.jpg --depth-photo",
               "at f/1");
}

TEST_CASE(
    "photos: GDepth files that exiftool writes are read, and exiftool reads the test's files" *
    doctest::test_suite("exiftool")) {
  if (!CanReadXmp() || !HasExiftool()) {
    std::printf("SKIPPED: exiftool is not there\n");
    return;
  }
  TempFolder folder;
  Write(folder.file("ours.jpg"), GdepthPhoto());
  CHECK(Exiftool(folder, "-s3 -XMP-GDepth:Far ours.jpg") == "4\n");
  Write(folder.file("map.png"), Exiftool(folder, "-b -XMP-GDepth:DepthImage ours.jpg"));
  CHECK(ValueOf(ReadImage(folder.file("map.png"))).width == 48);
  Write(folder.file("theirs.jpg"), Encode(Ramp(96, 64), ".jpg"));
  // exiftool also writes the EXIF: the orientation is 8, and the focal length is 26 mm.
  Exiftool(folder,
           "-q -XMP-GDepth:Format=RangeLinear -XMP-GDepth:Near=1 -XMP-GDepth:Far=3 "
           "-XMP-GDepth:Units=m '-XMP-GDepth:DepthImage<=map.png' -n -Orientation=8 "
           "-FocalLengthIn35mmFormat=26 theirs.jpg");
  Capture capture = ValueOf(OpenCapture(folder.file("theirs.jpg"), {}));
  CHECK(capture.light_field.width() == 64);
  const FloatMap& disparity = capture.light_field.disparity;
  const double per_diopter = PerDiopter(26) * std::hypot(96, 64) / std::hypot(kWidth, kHeight);
  CHECK(double(disparity.at(5, 90)) == doctest::Approx(per_diopter / 1));
  CHECK(double(disparity.at(5, 3)) == doctest::Approx(per_diopter / 3));
}

TEST_CASE("photos: the phone photographs of the data sets are refocused near and far" *
          doctest::test_suite("data_sets")) {
  const std::string photos = STARFOCUS_DATA_DIR "/photos/";
  if (!fs::exists(photos)) {
    std::printf("SKIPPED: data set photos is not there\n");
    return;
  }
  TempFolder folder;
  for (const char* name : {"flowers", "hut", "mango", "shelf", "tunnel"}) {
    Capture pair = ValueOf(OpenCapture(photos + name + "-image.jpg", {}));
    REQUIRE(pair.notes.size() == 1);
    CHECK(Contains(pair.notes[0], "black is taken as near"));
  }
  const std::string shelf = "'" + photos + "shelf-image.jpg'";
  Succeed(folder, "refocus " + shelf + " -o near.png --focus 12");
  Succeed(folder, "refocus " + shelf + " -o far.png --focus 0");
  CHECK(PsnrOf(folder, "near.png", "far.png") < 40);
#ifdef STARFOCUS_HAS_HEIF
  // The expected values come from a separate program that reads the same file.
  Capture capture = ValueOf(OpenCapture(photos + "pug.heic", {}));
  CHECK(capture.light_field.width() == 4032);
  CHECK(!capture.metadata.exif.empty());
  CHECK(capture.metadata.icc.size() == 536);
  Bytes bytes = ValueOf(ReadFile(photos + "pug.heic"));
  const DepthPhoto photo = ValueOf(ReadHeif("pug", {bytes.data(), bytes.size()}, Near::kUnknown));
  bytes = ValueOf(ReadFile(photos + "pug_depth.png"));
  const FloatMap other = ValueOf(DecodeLevels("pug_depth", bytes));
  REQUIRE(photo.map.values.size() == other.values.size());
  double largest = 0;
  for (size_t k = 0; k < other.values.size(); ++k) {
    const double level = (double(photo.map.values[k]) - 1.498047) / (4.382812 - 1.498047);
    largest = std::max(largest, std::fabs(level - double(other.values[k])));
  }
  CHECK(largest < 1.5 / 255);
#endif
}

}  // namespace
}  // namespace starfocus::photo_program_test
