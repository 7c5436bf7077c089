// SPDX-License-Identifier: Apache-2.0
#include "platform/icc_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "platform/container.h"
#include "platform/matrix.h"

namespace starfocus {
namespace {

constexpr char kProfileForm[] = "ICC profile";
constexpr size_t kHeader = 128, kTag = 12;
constexpr size_t kColourSpace = 16, kSignature = 36;  // offsets in bytes in the profile header

bool HasText(const Bytes& icc, size_t at, const char* text) {
  return std::equal(text, text + 4, icc.begin() + static_cast<ptrdiff_t>(at));
}

// Element of a profile: its type, 4 reserved bytes, and its content.
struct IccElement {
  const uint8_t* data = nullptr;
  size_t size = 0;  // bytes; 0: the profile has no such element

  bool is(const char* type, size_t least) const {
    return size >= least && std::equal(type, type + 4, data);
  }
  // Returns the s15Fixed16Number at a byte offset.
  double Fixed(size_t at) const {
    return static_cast<int32_t>(ReadBigEndian32(data + at)) / 65536.0;
  }
  double Half(size_t at) const { return data[at] * 256 + data[at + 1]; }
};

IccElement FindElement(const Bytes& icc, const char* name) {
  const size_t first = kHeader + 4, end = first + ReadBigEndian32(&icc[kHeader]) * kTag;
  for (size_t at = first; at < end; at += kTag) {
    if (!HasText(icc, at, name)) continue;
    return {icc.data() + ReadBigEndian32(&icc[at + 4]), ReadBigEndian32(&icc[at + 8])};
  }
  return {};
}

// Reads an element of the type XYZType.
std::optional<Vector> ReadXyz(const Bytes& icc, const char* name) {
  const IccElement element = FindElement(icc, name);
  if (!element.is("XYZ ", 20)) return std::nullopt;
  return Vector{element.Fixed(8), element.Fixed(12), element.Fixed(16)};
}

// Returns the matrix that adapts colours to D50, as the profile states it or as its white implies.
// Profiles of version 2 state the white of the display, and profiles of version 4 state D50.
std::optional<Matrix> AdaptationOf(const Bytes& icc) {
  const IccElement element = FindElement(icc, "chad");
  if (element.is("sf32", 44)) {
    Matrix matrix;
    for (size_t k = 0; k < 9; ++k) matrix[k / 3][k % 3] = element.Fixed(8 + 4 * k);
    return matrix;
  }
  const std::optional<Vector> white = ReadXyz(icc, "wtpt");
  const auto is_usual = [](double value) { return value > 0.3 && value < 3; };
  if (!white || !std::all_of(white->begin(), white->end(), is_usual)) return std::nullopt;
  return AdaptationToD50(*white);
}

// Returns the light of a code, 0 to 1, by a curve of the type curveType or parametricCurveType
// (ICC.1:2022, 10.6 and 10.18), or NaN if the curve is invalid.
double LightOfCurve(const IccElement& curve, double code) {
  if (curve.is("curv", 12)) {
    const size_t count = ReadBigEndian32(curve.data + 8);
    if (count == 0) return code;
    if (count > (curve.size - 12) / 2) return NAN;
    if (count == 1) return std::pow(code, curve.Half(12) / 256);
    const double at = code * double(count - 1);
    const auto below = std::min(static_cast<size_t>(at), count - 2);
    const double low = curve.Half(12 + 2 * below), high = curve.Half(14 + 2 * below);
    return (low + (high - low) * (at - double(below))) / 65535;
  }
  constexpr size_t kCounts[] = {1, 3, 4, 5, 7};  // parameters of each function
  if (!curve.is("para", 12) || curve.data[8] != 0 || curve.data[9] > 4) return NAN;
  const size_t type = curve.data[9];
  if (curve.size < 12 + 4 * kCounts[type]) return NAN;
  // Y = (a * X + b)^g + e for X >= d, and c * X + f below.
  double g = curve.Fixed(12), a = 1, b = 0, c = 0, d = 0, e = 0, f = 0;
  if (type > 0) a = curve.Fixed(16), b = curve.Fixed(20);
  if (type == 1 || type == 2) d = a == 0 ? 0 : -b / a;
  if (type == 2) e = f = curve.Fixed(24);
  if (type > 2) c = curve.Fixed(24), d = curve.Fixed(28);
  if (type == 4) e = curve.Fixed(32), f = curve.Fixed(36);
  return code >= d ? std::pow(a * code + b, g) + e : c * code + f;
}

// Sets the transfer to that of the green curve. Returns false if the curve is invalid.
bool DescribeCurve(const IccElement& curve, ColourDescription* colours) {
  constexpr int kLinearCode = 8, kSrgbCode = 13;  // of H.273
  double from_srgb = 0, from_linear = 0;
  for (const double code : {0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95}) {
    const double light = LightOfCurve(curve, code);
    if (!(light >= 0)) return false;
    const double srgb = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
    from_srgb = std::max(from_srgb, std::fabs(light - srgb));
    from_linear = std::max(from_linear, std::fabs(light - code));
  }
  const double exponent = std::log(LightOfCurve(curve, 0.5)) / std::log(0.5);
  if (!(exponent > 0.1) || exponent > 10) return false;
  colours->transfer = from_srgb < 0.005     ? kSrgbCode
                      : from_linear < 0.005 ? kLinearCode
                                            : ColourDescription::kGiven;
  colours->gamma = static_cast<int32_t>(std::lround(1e5 * exponent));
  return true;
}

// Returns the code points of an element of the type cicpType (ICC.1:2022, 10.3) of PQ or HLG, which
// curves cannot express.
std::optional<ColourDescription> ReadHdr(const Bytes& icc) {
  constexpr int kPq = 16, kHlg = 18;  // of H.273
  const IccElement element = FindElement(icc, "cicp");
  if (!element.is("cicp", 12)) return std::nullopt;
  const int primaries = element.data[8], transfer = element.data[9];
  if (transfer != kPq && transfer != kHlg) return std::nullopt;
  return ColourDescription{kProfileForm, primaries, transfer, element.data[11] == 1};
}

}  // namespace

std::optional<ColourDescription> DescriptionOf(const Bytes& icc) {
  if (!IsRgbProfile(icc)) return std::nullopt;
  if (std::optional<ColourDescription> hdr = ReadHdr(icc)) return hdr;
  if (FindElement(icc, "A2B0").size > 0) return std::nullopt;
  const std::optional<Matrix> adaptation = AdaptationOf(icc);
  if (!adaptation || std::fabs(Determinant(*adaptation)) < 1e-3) return std::nullopt;
  const Matrix inverse = Inverse(*adaptation);
  ColourDescription colours = {kProfileForm, ColourDescription::kGiven};
  constexpr const char* kNames[] = {"rXYZ", "gXYZ", "bXYZ"};
  for (size_t k = 0; k < 4; ++k) {
    const std::optional<Vector> adapted = k < 3 ? ReadXyz(icc, kNames[k]) : kD50;
    if (!adapted) return std::nullopt;
    const Vector xyz = Product(inverse, *adapted);
    const double sum = xyz[0] + xyz[1] + xyz[2];
    for (size_t c = 0; c < 2; ++c) {
      const double share = xyz[c] / sum;
      if (!(share > -1 && share < 2)) return std::nullopt;
      colours.chromaticities[2 * k + c] = static_cast<int32_t>(std::lround(1e5 * share));
    }
  }
  if (!DescribeCurve(FindElement(icc, "gTRC"), &colours)) return std::nullopt;
  // Profiles have rounded numbers.
  constexpr int32_t kRounding = 100;
  const int code = PrimariesCodeOf(colours, kRounding);
  if (code != ColourDescription::kUnspecified) colours.primaries = code;
  return colours;
}

bool IsRgbProfile(const Bytes& icc) {
  if (icc.size() < kHeader + 4 || ReadBigEndian32(icc.data()) != icc.size()) return false;
  if (!HasText(icc, kSignature, "acsp") || !HasText(icc, kColourSpace, "RGB ")) return false;
  const size_t tags = ReadBigEndian32(&icc[kHeader]), first = kHeader + 4;
  if (tags > (icc.size() - first) / kTag) return false;
  for (size_t at = first; at < first + tags * kTag; at += kTag) {
    const size_t offset = ReadBigEndian32(&icc[at + 4]), size = ReadBigEndian32(&icc[at + 8]);
    if (offset > icc.size() || size > icc.size() - offset) return false;
  }
  return true;
}

}  // namespace starfocus
