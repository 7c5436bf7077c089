// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/depth_photo_file.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "platform/container.h"
#include "platform/decoders/exr.h"
#include "platform/helper/helper.h"
#include "platform/image_io.h"
#include "platform/readers/apple_depth.h"
#include "platform/readers/confined_photo.h"
#include "platform/readers/decoding_memory.h"
#include "platform/readers/deep_photo.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/dynamic_depth.h"
#include "platform/readers/exif.h"
#include "platform/readers/gain_map.h"
#include "platform/readers/gdepth.h"
#include "platform/readers/heic.h"
#include "platform/readers/kept_metadata.h"
#include "platform/readers/matte_file.h"
#include "platform/readers/orientation.h"
#include "platform/readers/pair.h"
#include "platform/readers/profile.h"
#include "platform/readers/sample_bits.h"
#include "platform/readers/stereo_folders.h"
#include "platform/readers/stereo_pair.h"
#include "platform/readers/xmp.h"
#include "platform/standard_stream.h"

namespace starfocus {
namespace {

constexpr char kSpecialType[] = "http://ns.google.com/photos/1.0/camera/|SpecialTypeID";
constexpr char kExtendedXmp[] = "http://ns.adobe.com/xmp/note/|HasExtendedXMP";

bool HasMapOrMatte(const DepthPhoto& photo) {
  return !photo.map.values.empty() || !photo.matte.values.empty();
}

void IgnoreXmp(const Error& error, DepthPhoto* photo) {
  photo->notes.push_back(error.line());
  if (photo->map_problem.empty()) photo->map_problem = error.line();
}

// Adds an XMP packet to the children of `root`. Ignores an unreadable packet and adds a note.
void AddPacket(const std::string& name, const char* text, size_t size, XmpNode* root,
               DepthPhoto* photo) {
  Result<XmpNode> packet = ParseXmp(name + " is ignored", text, size);
  if (!packet) return IgnoreXmp(packet.error(), photo);
  root->children.push_back(std::move(*packet));
}

// Parses the XMP of a JPEG file: the packets of its segments, then the extended XMP. If `all` is
// false, reads only the extended XMP to which an XMP packet refers.
XmpNode ReadXmp(const JpegParts& parts, bool all, DepthPhoto* photo) {
  XmpNode root;
  if (!CanReadXmp()) return root;
  for (const Span& packet : parts.xmp) {
    AddPacket("XMP", reinterpret_cast<const char*>(packet.data), packet.size, &root, photo);
  }
  std::vector<const XmpNode*> owners;
  std::set<std::string> names;
  FindOwners(root, kExtendedXmp, &owners);
  for (const XmpNode* owner : owners) names.insert(*OwnProperty(*owner, kExtendedXmp));
  for (size_t k = 0; k < parts.extensions.size() && all; ++k)
    names.insert(parts.extensions[k].guid);
  for (const std::string& name : names) {
    const auto text = JoinExtensions("the extended XMP is ignored", parts, name);
    if (text) {
      AddPacket("the extended XMP", text->data(), text->size(), &root, photo);
    } else {
      IgnoreXmp(text.error(), photo);
    }
  }
  return root;
}

// Reads the depth map or the matte of a file by trying each format. The first format whose reader
// succeeds is used. `appended` are the pictures that follow the first picture.
void ReadMap(Span file, const JpegParts& parts, const XmpNode& xmp, Near near,
             std::vector<AppendedPicture>* appended, DepthPhoto* photo) {
  const auto read = [photo](const Error& error) {
    if (error) photo->map = {};
    if (photo->map_problem.empty()) photo->map_problem = error.line();
    return HasMapOrMatte(*photo);
  };
  if (HasGdepth(xmp) && read(ReadGdepth(xmp, near, photo))) return;
  if (HasDynamicDepth(xmp)) {
    const bool is_read = read(ReadDynamicDepth(file, xmp, near, appended, photo));
    ReadDynamicOriginal(file, xmp, appended, photo);
    if (is_read) return;
  }
  read(ReadAppleJpeg(file, parts, *appended, photo));
}

// Returns true if `node` has a property `name` whose text, or whose list of texts, contains `part`.
bool Mentions(const XmpNode& node, const std::string& name, const std::string& part) {
  const auto contains = [&](const std::string& text) {
    return text.find(part) != std::string::npos;
  };
  const auto attribute = node.attributes.find(name);
  if (attribute != node.attributes.end() && contains(attribute->second)) return true;
  // An empty name matches the elements of the list inside the property.
  const bool inside = name.empty() || node.name == name;
  if (inside && contains(node.text)) return true;
  return std::any_of(node.children.begin(), node.children.end(), [&](const XmpNode& child) {
    return Mentions(child, inside ? "" : name, part);
  });
}

Result<DepthPhoto> DecodeJpegPhoto(const std::string& where, Span file, bool with_map, Near near) {
  const Result<JpegParts> parts = ReadJpegParts(where, file);
  if (!parts) return parts.error();
  Result<DepthPhoto> photo = ReadJpegPicture(where, file, *parts);
  if (!photo) return photo;
  const XmpNode xmp = ReadXmp(*parts, false, &*photo);
  photo->metadata.xmp = KeptXmp(xmp);
  if (Mentions(xmp, kSpecialType, "PORTRAIT")) photo->is_blurred = true;
  std::vector<AppendedPicture> appended = ListAppendedPictures(file, parts->end);
  if (with_map) {
    ReadMap(file, *parts, xmp, near, &appended, &*photo);
  } else if (HasDynamicDepth(xmp)) {
    if (HasMask(xmp)) photo->facts.emplace_back("mattes", "ignored: mask of the subject");
    ReadDynamicOriginal(file, xmp, &appended, &*photo);
  }
  if (photo->matte.values.empty()) ReadAppleMattes(appended, &*photo);
  const bool has_gain_map =
      std::any_of(appended.begin(), appended.end(),
                  [](const AppendedPicture& picture) { return picture.is_gain_map; });
  const Error problem = ReadGainMap(appended, &*photo);
  if (has_gain_map) {
    photo->facts.emplace_back("gain map", GainMapFact(photo->gain_map, problem));
  }
  return photo;
}

// The depth in the file of a photo.
enum class FileDepth { kMap, kPair, kMask, kMatte };

// Returns an error if an option would override a property that the map in the photo states, or if
// it does not apply because the photo has no depth picture. `has_matte` is true if the matte has a
// file of its own. For a mask of the subject in the photo, `near` states the shade of the subject.
Error CheckOptions(const std::string& path, const DepthOptions& options, FileDepth depth,
                   bool has_matte) {
  const bool has_near = depth == FileDepth::kMap || depth == FileDepth::kMask;
  const bool turns = options.orientation != DepthOrientation::kUnknown;
  const char* option = options.unit != DepthUnit::kNone              ? "--depth-unit"
                       : options.has_unknown                         ? "--unknown"
                       : turns && !has_matte                         ? "--depth-orientation"
                       : !has_near && options.near != Near::kUnknown ? "--near"
                                                                     : nullptr;
  if (option == nullptr || options.estimate) return {};
  return Expected(path, std::string("a separate depth picture (--depth FILE) for ") + option,
                  depth == FileDepth::kMap    ? "a depth map in the photo"
                  : depth == FileDepth::kPair ? "a stereo pair, whose map is estimated"
                                              : "a matte without depth");
}

// Reads the map from extended XMP that no packet refers to. Editors that rewrite the XMP packet
// leave stray extended XMP in the file. The XMP specification requires readers to ignore stray
// extended XMP, so all other depth maps take precedence.
bool ReadStrayMap(Span file, Near near, DepthPhoto* photo) {
  if (!IsJpeg(file)) return false;
  const Result<JpegParts> parts = ReadJpegParts("", file);
  if (!parts || parts->extensions.empty()) return false;
  DepthPhoto ignored;
  const XmpNode xmp = ReadXmp(*parts, true, &ignored);
  if (!HasGdepth(xmp) || ReadGdepth(xmp, near, photo)) {
    photo->map = {};
    return false;
  }
  photo->notes.push_back("the depth map comes from extended XMP that no XMP packet refers to");
  return true;
}

bool JpegStoresDepth(const std::string& path, Span file) {
  const Result<JpegParts> parts = ReadJpegParts(path, file);
  if (!parts) return false;
  DepthPhoto photo;
  std::vector<AppendedPicture> appended = ListAppendedPictures(file, parts->end);
  ReadMap(file, *parts, ReadXmp(*parts, false, &photo), Near::kUnknown, &appended, &photo);
  if (photo.matte.values.empty()) ReadAppleMattes(appended, &photo);
  if (HasMapOrMatte(photo) || ReadStrayMap(file, Near::kUnknown, &photo)) return true;
  if (!MayBeStereoPair(path, file)) return false;
  if (ReadJpegPicture(path, file, *parts).MoveTo(&photo)) return false;
  return ReadStereoPair(path, file, &photo);
}

bool HeifStoresDepth(const std::string& path, Span file) {
  Result<DepthPhoto> photo = ReadHeif(path, file, Near::kUnknown);
  return photo && (HasMapOrMatte(*photo) || ReadStereoPair(path, file, &*photo));
}

// Searches a photo without a map for a stray map or the right picture of a stereo pair.
Result<DepthPhoto> ReadStrayDepth(const std::string& path, Span file, Near near,
                                  DepthPhoto* photo) {
  return ConfinedPhoto(InputName(path), file, [&]() -> Result<DepthPhoto> {
    if (!ReadStrayMap(file, near, photo)) ReadStereoPair(path, file, photo);
    return std::move(*photo);
  });
}

Error NoMap(const std::string& path, const std::string& problem) {
  std::string found = "a picture without one";
  if (!CanReadXmp()) found += " that is read (this build has no expat)";
  if (!problem.empty()) found += " that can be read (" + problem + ")";
  return Expected(
      path,
      "a depth map in the file, in NAME-depth.png or .jpg beside the file, or by --depth "
      "or --depth-command, or a matte by --matte or --matte-command",
      found);
}

// Reduces the XMP packet of a PNG or WebP file to the properties that describe the photograph.
void KeepCaptions(DepthPhoto* photo) {
  const std::string packet = std::move(photo->metadata.xmp);
  photo->metadata.xmp.clear();
  if (packet.empty() || !CanReadXmp()) return;
  const Result<XmpNode> root = ParseXmp("the XMP", packet.data(), packet.size());
  if (!root) return IgnoreXmp(root.error(), photo);
  photo->metadata.xmp = KeptXmp(*root);
}

// Adds a note that explains why the map in the file is not used, unless the notes contain the
// problem itself.
void NoteProblem(DepthPhoto* photo) {
  const std::string& problem = photo->map_problem;
  if (problem.empty()) return;
  for (const std::vector<std::string>& notes : {photo->notes, photo->matte_notes}) {
    if (std::find(notes.begin(), notes.end(), problem) != notes.end()) return;
  }
  photo->notes.push_back("the depth map in the file is ignored: " + problem);
}

// Computes the depth picture of a photo without depth.
Error EstimateDepth(const std::string& where, const DepthOptions& options, DepthPhoto* photo) {
  ApplyOrientation(photo);
  Result<Samples> samples = options.estimate(photo->picture);
  if (!samples) return samples.error();
  photo->format = "photo with estimated depth";
  photo->facts.emplace_back("depth", "computed by --depth-command");
  DepthOptions upright = options;
  upright.orientation = DepthOrientation::kUpright;
  return TakeDepthPicture(where, upright, std::move(*samples), photo);
}

// Follows the distances of the channel Z of an OpenEXR file, whose factor a unit determines.
constexpr char kAnyFactor[] = ", correct up to a factor";

// Gives the inverse distances of an OpenEXR file the unit of the options, and removes it from them.
void TakeUnit(Span file, DepthOptions* options, DepthPhoto* photo) {
  const Bytes signature(file.data, file.data + std::min<size_t>(file.size, 4));
  if (!IsExr(signature) || options->unit != DepthUnit::kDistance || options->estimate) return;
  for (float& value : photo->map.values) value = static_cast<float>(value / options->metres);
  photo->meaning = MapMeaning::kInverseMetres;
  options->unit = DepthUnit::kNone;
  for (auto& [name, text] : photo->facts) {
    if (name == "map") text.resize(text.rfind(kAnyFactor));
  }
}

// Finds or estimates the depth of a decoded photo. The map and the right picture remain empty if
// the photo has no depth.
Error FindDepth(const std::string& path, Span file, const DepthOptions& options,
                const PhotoFiles& files, DepthPhoto* photo) {
  const bool stream = path == "-";  // standard input has no depth picture next to it
  const std::string where = InputName(path);
  const Near near = options.estimate ? Near::kUnknown : options.near;
  const bool has_matte = !files.matte.empty();
  if (files.depth.empty() && !photo->map.values.empty()) {
    DepthOptions others = options;
    TakeUnit(file, &others, photo);
    return CheckOptions(where, others, FileDepth::kMap, has_matte);
  }
  photo->depth_path = files.depth;
  if (files.depth.empty() && !stream) {
    if (Error error = FindDepthPicture(path, photo).MoveTo(&photo->depth_path)) return error;
  }
  if (!photo->depth_path.empty()) {
    NoteProblem(photo);
    return ReadDepthPicture(photo->depth_path, options, photo);
  }
  if (Error error = ReadStrayDepth(path, file, near, photo).MoveTo(photo)) return error;
  const bool has_map = !photo->map.values.empty();
  const std::string right = stream || has_map ? "" : FindRightPicture(path);
  if (photo->right.pixels.empty() && !right.empty()) {
    if (Error error = ReadPictureFiles(path, right).MoveTo(photo)) return error;
  }
  if (has_map || !photo->right.pixels.empty()) {
    return CheckOptions(where, options, has_map ? FileDepth::kMap : FileDepth::kPair, has_matte);
  }
  if (!options.estimate) return {};
  NoteProblem(photo);
  return EstimateDepth(where, options, photo);
}

// Keeps or removes the mask in the file of a photo, which is needed only without depth and without
// another matte. The repair of a map finds outlines more accurately (docs/formats.md).
void JudgeMask(const PhotoFiles& files, DepthPhoto* photo) {
  if (!photo->is_mask) return;
  const bool has_depth = !photo->map.values.empty() || !photo->right.pixels.empty();
  const bool used = !has_depth && files.matte.empty();
  photo->facts.emplace_back("mattes",
                            used ? "mask of the subject" : "ignored: mask of the subject");
  if (used) return;
  photo->is_mask = false;
  photo->matte = {};
  photo->matte_notes.clear();
}

// Adds the notes about the mattes in the file, which no other matte replaces.
void TellMatte(DepthPhoto* photo) {
  std::move(photo->matte_notes.begin(), photo->matte_notes.end(), std::back_inserter(photo->notes));
  photo->matte_notes.clear();
}

// Reads or computes the matte of a photo after FindDepth. Returns an error if the photo has neither
// depth nor a matte.
Error FindMatte(const std::string& path, const DepthOptions& options, const PhotoFiles& files,
                DepthPhoto* photo) {
  const std::string where = InputName(path);
  JudgeMask(files, photo);
  if (!photo->right.pixels.empty()) {
    if (!files.matte.empty()) {
      return Expected(where, "a photo of one view for --matte", "a stereo pair");
    }
    TellMatte(photo);
    return {};
  }
  Error error;
  if (!files.matte.empty()) {
    error = ReadMatteFile(files.matte, options, photo);
  } else if (photo->matte.values.empty() && options.estimate_matte) {
    error = EstimateMatte(where, options, photo);
  } else {
    TellMatte(photo);
  }
  if (error || !photo->map.values.empty()) return error;
  if (photo->matte.values.empty()) return NoMap(where, photo->map_problem);
  NoteProblem(photo);
  const FileDepth depth = photo->is_mask ? FileDepth::kMask : FileDepth::kMatte;
  return CheckOptions(where, options, depth, !files.matte.empty());
}

// Decodes the colours of an OpenEXR file and, if `with_map` is true, its channel Z, whose distances
// have no unit.
Result<DepthPhoto> DecodeExrPhoto(const std::string& where, const Bytes& bytes, bool with_map) {
  DepthPhoto photo;
  photo.format = "OpenEXR picture with depth";
  Result<DecodedPicture> picture = DecodeExr(where, bytes);
  if (!picture) return picture.error();
  const bool is_transparent = picture->is_transparent;
  TakePicture(std::move(*picture), &photo);
  NoteTransparency(is_transparent, photo.deep ? &photo.lost : &photo.notes);
  ChooseProfile(&photo);
  if (!with_map || !HasExrDistances(bytes)) return photo;
  Result<Samples> distances = DecodeExrSamples(where, false, bytes);
  photo.map_problem = distances.error().line();
  if (!distances) return photo;
  photo.map = std::move(distances->map);
  Invert(&photo.map);
  photo.meaning = MapMeaning::kInverse;
  TellMap(std::string("distances of the channel Z") + kAnyFactor, &photo);
  return photo;
}

}  // namespace

Result<DepthPhoto> DecodeDepthPhoto(const std::string& where, Span file, bool with_map, Near near) {
  if (IsHeif(file)) return ReadHeif(where, file, near);
  if (IsJpeg(file)) return DecodeJpegPhoto(where, file, with_map, near);
  const Bytes bytes(file.data, file.data + file.size);
  if (IsExr(bytes)) return DecodeExrPhoto(where, bytes, with_map);
  Result<DecodedPicture> picture = DecodeImage(where, bytes);
  if (!picture) return picture.error();
  DepthPhoto photo;
  const bool is_transparent = picture->is_transparent;
  const int bits = std::max(picture->bits, SampleBitsOf(bytes));
  TakePicture(std::move(*picture), &photo);
  NoteSampleBits(bits, photo.deep ? &photo.lost : &photo.notes);
  NoteTransparency(is_transparent, photo.deep ? &photo.lost : &photo.notes);
  ReadExif(&photo);
  ChooseProfile(&photo);
  KeepCaptions(&photo);
  return photo;
}

bool StoresDepth(const std::string& path) {
  const Result<Bytes> bytes = ReadFileIf(path, MayBePicture);
  if (!bytes) return false;
  const Span file = {bytes->data(), bytes->size()};
  if (!IsJpeg(file) && !IsHeif(file)) return false;
  if (IsHeif(file)) LoadHeifDecoders();
  const Result<bool> stores = Confined<bool>(path, [&]() -> Result<bool> {
    return IsJpeg(file) ? JpegStoresDepth(path, file) : HeifStoresDepth(path, file);
  });
  return stores && *stores;
}

Result<DepthPhoto> ReadDepthPhotoFile(const std::string& path, const DepthOptions& options,
                                      const PhotoFiles& files) {
  const std::string where = InputName(path);
  const Result<Bytes> bytes = ReadFileIf(path, MayBePicture);
  if (!bytes) return bytes.error();
  if (path == "-" && bytes->empty()) return Expected(where, "a photo", "nothing");
  const Span file = {bytes->data(), bytes->size()};
  const Near near = options.estimate ? Near::kUnknown : options.near;
  if (options.before_decoding) options.before_decoding(DecodingBytes(file));
  Result<DepthPhoto> decoded = ConfinedPhoto(
      where, file, [&] { return DecodeDepthPhoto(where, file, files.depth.empty(), near); });
  if (!decoded) return decoded;
  if (Error error = FindDepth(path, file, options, files, &*decoded)) return error;
  if (Error error = FindMatte(path, options, files, &*decoded)) return error;
  return decoded;
}

}  // namespace starfocus
