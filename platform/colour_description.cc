// SPDX-License-Identifier: Apache-2.0
#include "platform/colour_description.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <optional>

#include "platform/matrix.h"

namespace starfocus {
namespace {

// Primaries of H.273, table 2.
struct Primaries {
  int code;
  const char* name;
  Chromaticities at;
};
constexpr int kBt709 = 1, kSrgbTransfer = 13, kLinear = 8;
constexpr Primaries kPrimaries[] = {
    {kBt709, "BT.709", {64000, 33000, 30000, 60000, 15000, 6000, 31270, 32900}},
    {4, "BT.470 M", {67000, 33000, 21000, 71000, 14000, 8000, 31000, 31600}},
    {5, "BT.470 B/G", {64000, 33000, 29000, 60000, 15000, 6000, 31270, 32900}},
    {6, "BT.601", {63000, 34000, 31000, 59500, 15500, 7000, 31270, 32900}},
    {7, "SMPTE 240M", {63000, 34000, 31000, 59500, 15500, 7000, 31270, 32900}},
    {8, "film", {68100, 31900, 24300, 69200, 14500, 4900, 31000, 31600}},
    {9, "BT.2020", {70800, 29200, 17000, 79700, 13100, 4600, 31270, 32900}},
    {10, "CIE XYZ", {100000, 0, 0, 100000, 0, 0, 33333, 33333}},
    {11, "DCI-P3", {68000, 32000, 26500, 69000, 15000, 6000, 31400, 35100}},
    {12, "Display P3", {68000, 32000, 26500, 69000, 15000, 6000, 31270, 32900}},
    {22, "EBU 3213-E", {63000, 34000, 29500, 60500, 15500, 7700, 31270, 32900}},
    {ColourDescription::kAdobeRgb,
     "Adobe RGB",
     {64000, 33000, 21000, 71000, 15000, 6000, 31270, 32900}},
};

// Transfers of H.273, table 3. Light is (a code + 1 - a)^exponent if the code is at least `from`,
// and slope * code otherwise. An exponent of 0 means that a curve cannot express the transfer.
struct Transfer {
  int code;
  const char* name;
  double exponent, a, slope, from;
};
constexpr Transfer kTransfers[] = {
    {1, "BT.709", 1 / 0.45, 1 / 1.099, 1 / 4.5, 0.081},
    {4, "gamma 2.2", 2.2, 1, 0, 0},
    {5, "gamma 2.8", 2.8, 1, 0, 0},
    {6, "BT.601", 1 / 0.45, 1 / 1.099, 1 / 4.5, 0.081},
    {7, "SMPTE 240M", 1 / 0.45, 1 / 1.1115, 1 / 4.0, 0.0912},
    {kLinear, "linear light", 1, 1, 0, 0},
    {9, "logarithm 100:1", 0, 0, 0, 0},
    {10, "logarithm 316:1", 0, 0, 0, 0},
    {11, "xvYCC", 1 / 0.45, 1 / 1.099, 1 / 4.5, 0.081},
    {12, "BT.1361", 1 / 0.45, 1 / 1.099, 1 / 4.5, 0.081},
    {kSrgbTransfer, "sRGB", 2.4, 1 / 1.055, 1 / 12.92, 0.04045},
    {14, "BT.2020", 1 / 0.45, 1 / 1.099, 1 / 4.5, 0.081},
    {15, "BT.2020", 1 / 0.45, 1 / 1.099, 1 / 4.5, 0.081},
    {16, "PQ", 0, 0, 0, 0},
    {17, "SMPTE ST 428", 0, 0, 0, 0},
    {18, "HLG", 0, 0, 0, 0},
    {ColourDescription::kAdobeRgb, "Adobe RGB", 563 / 256.0, 1, 0, 0},
};

// Returns the row of a table with the code point `code`, or null.
template <class Row, size_t kSize>
const Row* FindRow(const Row (&rows)[kSize], int code) {
  const Row* end = std::end(rows);
  const Row* found =
      std::find_if(std::begin(rows), end, [code](const Row& row) { return row.code == code; });
  return found == end ? nullptr : found;
}

// Returns the primaries, or null if the code point has no definition.
std::optional<Primaries> PrimariesOf(const ColourDescription& colours) {
  if (colours.primaries == ColourDescription::kGiven) {
    return Primaries{colours.primaries, "given primaries", colours.chromaticities};
  }
  const bool known = colours.primaries != ColourDescription::kUnspecified;
  const Primaries* found = FindRow(kPrimaries, known ? colours.primaries : kBt709);
  return found == nullptr ? std::nullopt : std::optional(*found);
}

std::optional<Transfer> TransferRowOf(const ColourDescription& colours) {
  if (colours.transfer == ColourDescription::kGiven) {
    return Transfer{colours.transfer, "", colours.gamma / 1e5, 1, 0, 0};
  }
  const bool known = colours.transfer != ColourDescription::kUnspecified;
  const Transfer* found = FindRow(kTransfers, known ? colours.transfer : kSrgbTransfer);
  return found == nullptr ? std::nullopt : std::optional(*found);
}

// Matrices of a profile: chromatic adaptation, and RGB to adapted XYZ.
struct Colorimetry {
  Matrix adaptation, to_xyz;
};

// Returns the matrices for white adapted to D50 by the linear Bradford transform (ICC.1:2022, annex
// E), or nullopt if the primaries span no area or a value is out of range. Primaries of wide spaces
// are outside 0 to 1, by less than 0.1.
std::optional<Colorimetry> ColorimetryOf(const Chromaticities& at) {
  constexpr double kUnit = 1e-5, kLargest = 16;
  constexpr int32_t kLeast = -100000, kMost = 200000;
  const auto is_usual = [](int32_t value) { return value >= kLeast && value <= kMost; };
  if (!std::all_of(at.begin(), at.end(), is_usual)) return std::nullopt;
  Matrix primaries;
  for (size_t c = 0; c < 3; ++c) {
    primaries[0][c] = kUnit * at[2 * c];
    primaries[1][c] = kUnit * at[2 * c + 1];
    primaries[2][c] = 1 - primaries[0][c] - primaries[1][c];
  }
  const double x = kUnit * at[6], y = kUnit * at[7];
  if (!(y > 0) || std::fabs(Determinant(primaries)) < 1e-6) return std::nullopt;
  const Vector white = {x / y, 1, (1 - x - y) / y};
  const Matrix native = Product(primaries, Diagonal(Product(Inverse(primaries), white)));
  Colorimetry result;
  result.adaptation = AdaptationToD50(white);
  result.to_xyz = Product(result.adaptation, native);
  for (const Matrix& matrix : {result.adaptation, result.to_xyz}) {
    for (const Vector& row : matrix) {
      for (const double value : row) {
        if (!(std::fabs(value) < kLargest)) return std::nullopt;
      }
    }
  }
  return result;
}

void Append32(uint32_t value, Bytes* bytes) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes->push_back(uint8_t(value >> shift));
}

void AppendText(const std::string& text, Bytes* bytes) {
  bytes->insert(bytes->end(), text.begin(), text.end());
}

// Appends a number as s15Fixed16Number.
void AppendFixed(double value, Bytes* bytes) {
  Append32(static_cast<uint32_t>(static_cast<int32_t>(std::lround(value * 65536))), bytes);
}

// Each function below returns a tagged element (ICC.1:2022, clause 10).
Bytes Element(const char* type) {
  Bytes bytes;
  AppendText(type, &bytes);
  Append32(0, &bytes);
  return bytes;
}

Bytes TextElement(const std::string& ascii) {
  constexpr uint32_t kRecord = 12, kTextAt = 28;
  Bytes bytes = Element("mluc");
  Append32(1, &bytes);
  Append32(kRecord, &bytes);
  AppendText("enUS", &bytes);
  Append32(static_cast<uint32_t>(2 * ascii.size()), &bytes);
  Append32(kTextAt, &bytes);
  for (const char letter : ascii) bytes.insert(bytes.end(), {0, static_cast<uint8_t>(letter)});
  return bytes;
}

Bytes XyzElement(const Vector& xyz) {
  Bytes bytes = Element("XYZ ");
  for (const double value : xyz) AppendFixed(value, &bytes);
  return bytes;
}

Bytes MatrixElement(const Matrix& matrix) {
  Bytes bytes = Element("sf32");
  for (const Vector& row : matrix) {
    for (const double value : row) AppendFixed(value, &bytes);
  }
  return bytes;
}

Bytes CurveElement(const Transfer& transfer) {
  const bool is_power = transfer.a == 1;
  Bytes bytes = Element("para");
  Append32(is_power ? 0 : 3u << 16, &bytes);  // function type, and two reserved bytes
  AppendFixed(transfer.exponent, &bytes);
  if (is_power) return bytes;
  for (const double value : {transfer.a, 1 - transfer.a, transfer.slope, transfer.from}) {
    AppendFixed(value, &bytes);
  }
  return bytes;
}

// Assembles a profile from tagged elements. Equal elements in succession are stored once.
struct Tag {
  const char* name;
  Bytes element;
};
template <size_t kCount>
Bytes Assemble(const Tag (&tags)[kCount]) {
  constexpr size_t kHeader = 128, kEntry = 12;
  Bytes table, data;
  Append32(kCount, &table);
  uint32_t at = 0;
  for (size_t k = 0; k < kCount; ++k) {
    const Bytes& element = tags[k].element;
    if (k == 0 || element != tags[k - 1].element) {
      data.resize((data.size() + 3) / 4 * 4);
      at = static_cast<uint32_t>(kHeader + 4 + kCount * kEntry + data.size());
      data.insert(data.end(), element.begin(), element.end());
    }
    AppendText(tags[k].name, &table);
    Append32(at, &table);
    Append32(static_cast<uint32_t>(element.size()), &table);
  }
  data.resize((data.size() + 3) / 4 * 4);
  Bytes profile;
  Append32(static_cast<uint32_t>(kHeader + table.size() + data.size()), &profile);
  Append32(0, &profile);
  Append32(0x04300000, &profile);  // version 4.3
  AppendText("mntrRGB XYZ ", &profile);
  // 1 January 2026: equal descriptions give equal profiles.
  for (const uint32_t half : {2026u << 16 | 1, 1u << 16, 0u}) Append32(half, &profile);
  AppendText("acsp", &profile);
  profile.resize(68);
  for (const double value : kD50) AppendFixed(value, &profile);
  profile.resize(kHeader);
  profile.insert(profile.end(), table.begin(), table.end());
  profile.insert(profile.end(), data.begin(), data.end());
  return profile;
}

bool IsNear(int32_t value, int32_t target, int32_t tolerance) {
  return std::abs(int64_t{value} - target) <= tolerance;
}

bool IsNearAll(const Chromaticities& values, const Chromaticities& targets, int32_t tolerance) {
  return std::equal(
      values.begin(), values.end(), targets.begin(),
      [tolerance](int32_t value, int32_t target) { return IsNear(value, target, tolerance); });
}

}  // namespace

bool IsSrgb(const ColourDescription& colours) {
  constexpr int32_t kRounding = 10, kSrgbGamma = 220000;
  const std::optional<Primaries> primaries = PrimariesOf(colours);
  if (!primaries || !colours.full_range) return false;
  if (!IsNearAll(primaries->at, kPrimaries[0].at, kRounding)) return false;
  if (colours.transfer != ColourDescription::kGiven) {
    return colours.transfer == kSrgbTransfer || colours.transfer == ColourDescription::kUnspecified;
  }
  // The PNG specification (11.3.2.5) defines this pair of chunks as a substitute for sRGB.
  return colours.primaries == ColourDescription::kGiven &&
         IsNear(colours.gamma, kSrgbGamma, kRounding);
}

bool IsLinear(const ColourDescription& colours) {
  return colours.transfer == kLinear ||
         (colours.transfer == ColourDescription::kGiven && IsNear(colours.gamma, 100000, 100));
}

std::optional<Chromaticities> ChromaticitiesOf(const ColourDescription& colours) {
  const std::optional<Primaries> primaries = PrimariesOf(colours);
  if (!primaries) return std::nullopt;
  return primaries->at;
}

int PrimariesCodeOf(const ColourDescription& colours, int32_t tolerance) {
  const std::optional<Primaries> primaries = PrimariesOf(colours);
  if (!primaries) return ColourDescription::kUnspecified;
  for (const Primaries& row : kPrimaries) {
    const bool has_code = row.code < ColourDescription::kGiven;
    if (has_code && IsNearAll(primaries->at, row.at, tolerance)) return row.code;
  }
  return ColourDescription::kUnspecified;
}

std::string PrimariesNameOf(const ColourDescription& colours) {
  const std::optional<Primaries> primaries = PrimariesOf(colours);
  if (!primaries) return "primaries " + std::to_string(colours.primaries);
  constexpr int32_t kRounding = 100;
  for (const Primaries& row : kPrimaries) {
    if (IsNearAll(primaries->at, row.at, kRounding)) return row.name;
  }
  return primaries->name;
}

std::string TransferNameOf(const ColourDescription& colours) {
  const std::optional<Transfer> transfer = TransferRowOf(colours);
  if (!transfer) return std::to_string(colours.transfer);
  if (transfer->code != ColourDescription::kGiven) return transfer->name;
  char gamma[32];
  std::snprintf(gamma, sizeof(gamma), "gamma %.2f", colours.gamma / 1e5);
  return gamma;
}

std::string NameOf(const ColourDescription& colours) {
  const std::string transfer = TransferNameOf(colours);
  const bool is_gamma = colours.transfer == ColourDescription::kGiven;
  const bool is_known = is_gamma || TransferRowOf(colours);
  return PrimariesNameOf(colours) +
         (is_gamma   ? ", "
          : is_known ? ", transfer of "
                     : ", transfer ") +
         transfer + (colours.full_range ? "" : ", narrow range");
}

Bytes ProfileOf(const ColourDescription& colours) {
  constexpr double kLargestExponent = 10;
  const std::optional<Primaries> primaries = PrimariesOf(colours);
  const std::optional<Transfer> transfer = TransferRowOf(colours);
  if (!primaries || !transfer || !colours.full_range) return {};
  if (!(transfer->exponent > 0.1) || transfer->exponent > kLargestExponent) return {};
  const std::optional<Colorimetry> colorimetry = ColorimetryOf(primaries->at);
  if (!colorimetry) return {};
  const Matrix& to_xyz = colorimetry->to_xyz;
  const auto column = [&](size_t c) -> Vector {
    return {to_xyz[0][c], to_xyz[1][c], to_xyz[2][c]};
  };
  const Bytes curve = CurveElement(*transfer);
  const Tag tags[] = {
      {"desc", TextElement(NameOf(colours))},
      {"cprt", TextElement("CC0")},
      {"wtpt", XyzElement(kD50)},
      {"chad", MatrixElement(colorimetry->adaptation)},
      {"rXYZ", XyzElement(column(0))},
      {"gXYZ", XyzElement(column(1))},
      {"bXYZ", XyzElement(column(2))},
      {"rTRC", curve},
      {"gTRC", curve},
      {"bTRC", curve},
  };
  return Assemble(tags);
}

}  // namespace starfocus
