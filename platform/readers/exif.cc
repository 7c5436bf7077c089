// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/exif.h"

#ifdef STARFOCUS_HAS_EXIF
#include <libexif/exif-data.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#endif

namespace starfocus {
namespace {

#ifdef STARFOCUS_HAS_EXIF

constexpr size_t kMostBytes = 65535;  // size limit of a JPEG segment in bytes

// Returns the first four integers of a tag with 16-bit or 32-bit integers. The result is empty if
// the tag is missing or has another type.
std::vector<double> NumbersOf(ExifData* data, ExifIfd directory, ExifTag tag) {
  std::vector<double> numbers;
  ExifEntry* entry = exif_content_get_entry(data->ifd[directory], tag);
  if (entry == nullptr) return numbers;
  const bool is_short = entry->format == EXIF_FORMAT_SHORT;
  if (!is_short && entry->format != EXIF_FORMAT_LONG) return numbers;
  const ExifByteOrder order = exif_data_get_byte_order(data);
  const size_t step = is_short ? 2 : 4, count = entry->size / step;
  for (size_t k = 0; k < count && k < 4; ++k) {
    const unsigned char* at = entry->data + k * step;
    numbers.push_back(is_short ? exif_get_short(at, order) : exif_get_long(at, order));
  }
  return numbers;
}

// Returns the value of a tag with a 16-bit integer, or 0 if the tag is missing or has another type.
int ShortOf(ExifData* data, ExifIfd directory, ExifTag tag) {
  const ExifEntry* entry = exif_content_get_entry(data->ifd[directory], tag);
  const std::vector<double> numbers = NumbersOf(data, directory, tag);
  if (numbers.empty() || entry->format != EXIF_FORMAT_SHORT) return 0;
  return static_cast<int>(numbers[0]);
}

// Reads the position of the subject. The first two numbers of SubjectArea or SubjectLocation are
// the centre of the subject. The diameter of a circle or the sides of a rectangle may follow (EXIF
// 2.32, 4.6.6.5).
void ReadSubject(ExifData* data, double width, double height, DepthPhoto* photo) {
  std::vector<double> subject = NumbersOf(data, EXIF_IFD_EXIF, EXIF_TAG_SUBJECT_AREA);
  if (subject.size() < 2) subject = NumbersOf(data, EXIF_IFD_EXIF, EXIF_TAG_SUBJECT_LOCATION);
  const std::vector<double> x = NumbersOf(data, EXIF_IFD_EXIF, EXIF_TAG_PIXEL_X_DIMENSION);
  const std::vector<double> y = NumbersOf(data, EXIF_IFD_EXIF, EXIF_TAG_PIXEL_Y_DIMENSION);
  if (subject.size() < 2 || !(width > 0 && height > 0)) return;
  if (x.size() == 1 && y.size() == 1 && x[0] > 0 && y[0] > 0) {
    // If the proportions of the picture differ from the size in EXIF, the picture was cropped, and
    // the position of the subject is unknown.
    constexpr double kSameShape = 0.01;
    if (std::fabs(x[0] * height / (y[0] * width) - 1) > kSameShape) return;
    width = x[0];
    height = y[0];
  }
  if (subject[0] >= width || subject[1] >= height) return;
  photo->has_subject = true;
  photo->subject_x = (subject[0] + 0.5) / width;
  photo->subject_y = (subject[1] + 0.5) / height;
}

// Reads the colour space of DCF 2.0: the interoperability index "R03" names Adobe RGB, for which
// EXIF has no code. Some cameras write the code 2 instead.
void ReadColourSpace(ExifData* data, ColourDescription* colours) {
  constexpr int kAdobe = 2;
  char index[5] = "";
  ExifEntry* entry =
      exif_content_get_entry(data->ifd[EXIF_IFD_INTEROPERABILITY], EXIF_TAG_INTEROPERABILITY_INDEX);
  if (entry != nullptr && entry->data != nullptr) {
    std::memcpy(index, entry->data, std::min<size_t>(entry->size, sizeof(index) - 1));
  }
  if (std::strcmp(index, "R03") != 0 &&
      ShortOf(data, EXIF_IFD_EXIF, EXIF_TAG_COLOR_SPACE) != kAdobe) {
    return;
  }
  *colours = {"EXIF", ColourDescription::kAdobeRgb, ColourDescription::kAdobeRgb};
}

#endif

}  // namespace

#ifdef STARFOCUS_HAS_EXIF

void ReadExif(int width, int height, DepthPhoto* photo) {
  const Bytes& exif = photo->metadata.exif;
  if (exif.empty() || exif.size() > kMostBytes) return;
  Bytes segment = {'E', 'x', 'i', 'f', 0, 0};
  segment.insert(segment.end(), exif.begin(), exif.end());
  ExifData* data = exif_data_new();
  if (data == nullptr) return;
  // Prevent libexif from adding or correcting EXIF entries.
  exif_data_unset_option(data, EXIF_DATA_OPTION_FOLLOW_SPECIFICATION);
  exif_data_load_data(data, segment.data(), static_cast<unsigned>(segment.size()));
  const int orientation = ShortOf(data, EXIF_IFD_0, EXIF_TAG_ORIENTATION);
  const int focal = ShortOf(data, EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM);
  // Apple's values of CustomRendered for portraits, whose background is blurred. Other cameras use
  // only 0 and 1.
  constexpr int kPortraitHdr = 7, kPortrait = 8;
  const int rendered = ShortOf(data, EXIF_IFD_EXIF, EXIF_TAG_CUSTOM_RENDERED);
  ReadSubject(data, width, height, photo);
  ColourDescription* colours = &photo->metadata.colours;
  if (colours->form.empty()) ReadColourSpace(data, colours);
  exif_data_unref(data);
  if (orientation >= 1 && orientation <= 8) photo->orientation = orientation;
  photo->focal_35mm = focal;
  photo->is_blurred = rendered == kPortraitHdr || rendered == kPortrait;
  std::string text = std::to_string(exif.size()) + " bytes";
  if (focal > 0) text += ", lens of " + std::to_string(focal) + " mm on full frame";
  photo->facts.emplace_back("EXIF", text);
}

#else

void ReadExif(int, int, DepthPhoto* photo) {
  if (photo->metadata.exif.empty()) return;
  photo->facts.emplace_back("EXIF", "not read: this program was built without libexif");
}

#endif

void ReadExif(DepthPhoto* photo) { ReadExif(photo->picture.width, photo->picture.height, photo); }

}  // namespace starfocus
