// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/pair.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <tuple>
#include <utility>

#include "platform/depth_file.h"
#include "platform/helper/helper.h"
#include "platform/readers/decoding_memory.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/map_orientation.h"
#include "platform/readers/robust_range.h"
#include "platform/readers/unknown_depth.h"
#include "platform/text.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

constexpr char kSeparators[] = "-_.", kDepth[] = "depth";
constexpr const char* kExtensions[] = {".png",  ".pgm", ".ppm",  ".webp", ".pfm", ".jpg",
                                       ".jpeg", ".tif", ".tiff", ".npy",  ".npz", ".exr"};

bool EndsIn(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// Returns the part of a name before "-depth", "_depth" or ".depth", where `ending` is "depth".
// Returns an empty string for other names.
std::string NameBefore(const std::string& stem, const std::string& ending) {
  const std::string lower = Lower(stem);
  if (!EndsIn(lower, ending)) return "";
  const size_t at = lower.size() - ending.size() - 1;
  return std::string(kSeparators).find(lower[at]) == std::string::npos ? "" : stem.substr(0, at);
}

// A depth picture next to the photo. Candidates are ordered by how well their names match the
// photo, the best match first.
struct Candidate {
  bool other_case;
  size_t separator, extension;
  std::string name;

  bool operator<(const Candidate& other) const {
    return std::tie(other_case, separator, extension, name) <
           std::tie(other.other_case, other.separator, other.extension, other.name);
  }
};

// Returns the name of a photo without its extension and without "-image".
std::string PhotoName(const std::string& file) {
  const std::string ending = "-image";
  std::string name = fs::path(file).stem().string();
  if (EndsIn(Lower(name), ending)) name.erase(name.size() - ending.size());
  return name;
}

// Returns the position of the extension of a file in kExtensions, or the size of kExtensions.
size_t ExtensionIndex(const std::string& file) {
  const std::string extension = Lower(fs::path(file).extension().string());
  return static_cast<size_t>(std::find(std::begin(kExtensions), std::end(kExtensions), extension) -
                             std::begin(kExtensions));
}

// Converts the values of DEPTH16 to millimetres. Ignores the confidence in the upper bits.
Error DecodeDepth16(const std::string& where, Samples* samples) {
  constexpr float kMost = 65535;
  constexpr int kDistanceBits = 13;
  for (float& value : samples->map.values) {
    if (std::isnan(value)) continue;  // A transparent pixel.
    if (samples->largest <= UINT8_MAX || value < 0 || value > kMost) {
      return Expected(where, "integers of 16 bits for --depth-unit depth16",
                      samples->largest == 0           ? "floats"
                      : samples->largest <= UINT8_MAX ? "integers of 8 bits"
                                                      : "other integers");
    }
    value = static_cast<float>(static_cast<int>(value) % (1 << kDistanceBits));
  }
  return {};
}

// Adds a note if the values of a map without a unit look like distances: they are in the range of
// rooms and streets, and small values are near or 0 is unknown. Values up to 1 look normalized.
void NoteDistances(const DepthOptions& options, int largest, DepthPhoto* photo) {
  const RobustRange range = RobustRangeOf(photo->map.values);
  const bool metres = largest == 0;
  const float low = metres ? 0.2F : 200, high = metres ? 200 : 20000;
  if (!range.known || range.low < low || range.high > high || range.low == range.high) return;
  if (!metres && largest <= UINT8_MAX) return;
  if (options.near == Near::kWhite || (metres && range.high <= 1)) return;
  MapSurvey* const own = &photo->survey;
  const MapEnds& ends = own->ends;
  own->has_distances = ends.zeros + ends.negatives > 0 && !ends.AreDepths();
  const Near near = own->has_distances ? Near::kBlack : SurveyNear(photo->map).GuessNear();
  if (options.near == Near::kUnknown && near == Near::kWhite) return;
  photo->notes.push_back("the values of the depth picture, " + NumberText(double(range.low)) +
                         " to " + NumberText(double(range.high)) + ", look like distances in " +
                         (metres ? "metres" : "millimetres") +
                         ", but define only an order of depth (--depth-unit " +
                         (metres ? "m" : "mm") + " reads them as distances)");
}

// Sets the meaning of the map's values according to the options.
void Understand(const DepthOptions& options, const Samples& samples, DepthPhoto* photo) {
  if (options.unit == DepthUnit::kDisparity) {
    TellMap("disparities in pixels", photo);
    Forget(HUGE_VALF, &photo->map);
    photo->meaning = MapMeaning::kDisparity;
  } else if (options.unit == DepthUnit::kNone) {
    TellMap("relative depth without distances", photo);
    NoteDistances(options, samples.largest, photo);
    ToOrder(
        samples.larger_is_nearer && options.near == Near::kUnknown ? Near::kWhite : options.near,
        photo);
  } else {
    const bool depth16 = options.unit == DepthUnit::kDepth16;
    const double metres = depth16 ? 0.001 : options.metres;
    TellMap("distances in " + (depth16           ? "millimetres (DEPTH16)"
                               : metres == 1     ? "metres"
                               : metres == 0.001 ? "millimetres"
                                                 : "units of " + NumberText(metres) + " m"),
            photo);
    ToRange(0, metres, &photo->map);
    Invert(&photo->map);
    photo->meaning = MapMeaning::kInverseMetres;
  }
}

}  // namespace

bool IsDepthPictureName(const std::string& name) {
  return !NameBefore(fs::path(name).stem().string(), kDepth).empty();
}

bool HasDepthExtension(const std::string& name) {
  return ExtensionIndex(name) < std::size(kExtensions);
}

void DepthPictures::Add(const std::string& name) {
  const std::string photo = NameBefore(fs::path(name).stem().string(), ending_);
  if (photo.empty() || !HasDepthExtension(name)) return;
  names_[Lower(photo)].push_back(name);
}

std::vector<std::string> DepthPictures::Of(const std::string& name) const {
  const std::string photo = PhotoName(name);
  const auto found = names_.find(Lower(photo));
  if (found == names_.end()) return {};
  std::vector<Candidate> candidates;
  for (const std::string& file : found->second) {
    const std::string stem = fs::path(file).stem().string();
    candidates.push_back({NameBefore(stem, ending_) != photo,
                          std::string(kSeparators).find(stem[photo.size()]), ExtensionIndex(file),
                          file});
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<std::string> names;
  for (const Candidate& candidate : candidates) names.push_back(candidate.name);
  return names;
}

Result<DepthPictures> ListDepthPictures(const std::string& folder) {
  DepthPictures pictures;
  std::error_code error, ignored;
  fs::directory_iterator at(folder, error);
  for (const fs::directory_iterator end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (IsDepthPictureName(name) && at->is_regular_file(ignored)) pictures.Add(name);
  }
  if (error) return Cannot("read folder", folder, error);
  return pictures;
}

Result<std::string> FindDepthPicture(const std::string& path, DepthPhoto* photo) {
  const fs::path file(path);
  const Result<DepthPictures> pictures =
      ListDepthPictures(file.has_parent_path() ? file.parent_path().string() : ".");
  if (!pictures) return pictures.error();
  const std::vector<std::string> found = pictures->Of(file.filename().string());
  if (found.empty()) return std::string();
  if (found.size() > 1) {
    photo->notes.push_back("found " + std::to_string(found.size()) +
                           " depth pictures in the folder of the photo, using " + found[0] +
                           " (--depth FILE chooses another)");
  }
  return (file.parent_path() / found[0]).string();
}

Result<Samples> ReadSamples(const std::string& path, Alpha alpha, const DepthOptions& options) {
  const Result<Bytes> bytes = ReadFile(path);
  if (!bytes) return bytes.error();
  if (options.before_decoding)
    options.before_decoding(DecodingBytes({bytes->data(), bytes->size()}));
  return Confined<Samples>(path, [&] { return DecodeDepthFile(path, alpha, *bytes); });
}

Error ReadDepthPicture(const std::string& path, const DepthOptions& options, DepthPhoto* photo) {
  photo->format = "photo and depth picture";
  photo->facts.emplace_back("depth picture", path);
  Result<Samples> samples = ReadSamples(path, options.alpha, options);
  if (!samples) return samples.error();
  return TakeDepthPicture(path, options, std::move(*samples), photo);
}

Error TakeDepthPicture(const std::string& where, const DepthOptions& options, Samples samples,
                       DepthPhoto* photo) {
  if (options.unit == DepthUnit::kDepth16) {
    if (Error error = DecodeDepth16(where, &samples)) return error;
  }
  photo->survey.kind =
      samples.largest == 0 ? "floats" : "levels up to " + std::to_string(samples.largest);
  MarkUnknown(options, &samples, photo);
  StandWithPhoto(options.orientation, false, photo, &samples.map);
  photo->map = std::move(samples.map);
  Understand(options, samples, photo);
  return {};
}

}  // namespace starfocus
