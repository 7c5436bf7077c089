// SPDX-License-Identifier: Apache-2.0
#include "platform/writers/jpeg_segments.h"

#include <algorithm>
#include <cstddef>

#include "platform/writers/md5.h"

namespace starfocus {
namespace {

constexpr size_t kMostPayload = 65533;  // the length field of a segment includes its own two bytes
constexpr uint8_t kApp0 = 0xe0, kApp1 = 0xe1, kApp2 = 0xe2, kApp13 = 0xed;

// Each header of an APP segment ends with a zero byte, as the formats require.
const std::string kExifHeader("Exif\0\0", 6);
const std::string kProfileHeader("ICC_PROFILE\0", 12);
const std::string kResourcesHeader("Photoshop 3.0\0", 14);
const std::string kXmpHeader("http://ns.adobe.com/xap/1.0/\0", 29);
const std::string kExtensionHeader("http://ns.adobe.com/xmp/extension/\0", 35);

std::string BigEndian32(size_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 255);
  return text;
}

// Appends a JPEG segment with a header and the bytes in [first, last).
template <typename Iterator>
void Append(uint8_t marker, const std::string& header, Iterator first, Iterator last,
            Bytes* segments) {
  const size_t length = header.size() + size_t(last - first) + 2;
  for (const size_t byte : {size_t{0xff}, size_t{marker}, length >> 8, length & 255}) {
    segments->push_back(static_cast<uint8_t>(byte));
  }
  segments->insert(segments->end(), header.begin(), header.end());
  segments->insert(segments->end(), first, last);
}

std::string Packet(const std::string& descriptions) {
  return "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
         "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">" +
         descriptions + "</rdf:RDF></x:xmpmeta>";
}

std::string Description(const std::string& namespaces, const std::string& attributes) {
  return "<rdf:Description rdf:about=\"\"" + namespaces + attributes + "/>";
}

// Encloses an XMP packet in the processing instructions by which programs find the packet anywhere
// in a file.
std::string Wrapped(const std::string& packet) {
  return "<?xpacket begin=\"\xef\xbb\xbf\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>" + packet +
         "<?xpacket end=\"r\"?>";
}

}  // namespace

bool AppendExif(const Bytes& tiff, Bytes* segments) {
  if (tiff.size() > kMostPayload - kExifHeader.size()) return false;
  if (!tiff.empty()) Append(kApp1, kExifHeader, tiff.begin(), tiff.end(), segments);
  return true;
}

bool AppendProfile(const Bytes& icc, Bytes* segments) {
  const size_t most = kMostPayload - kProfileHeader.size() - 2,
               count = (icc.size() + most - 1) / most;
  if (count > 255) return false;
  for (size_t i = 0; i < count; ++i) {
    const std::string header = kProfileHeader + static_cast<char>(i + 1) + static_cast<char>(count);
    const auto first = icc.begin() + static_cast<ptrdiff_t>(i * most);
    const auto last = i + 1 < count ? first + static_cast<ptrdiff_t>(most) : icc.end();
    Append(kApp2, header, first, last, segments);
  }
  return true;
}

// IPTC records are stored as an unnamed Photoshop image resource, padded to an even size.
bool AppendIptc(const Bytes& iptc, Bytes* segments) {
  if (iptc.empty()) return true;
  const std::string header = kResourcesHeader + "8BIM" + std::string("\x04\x04\0\0", 4);
  Bytes resource(iptc);
  if (resource.size() % 2 != 0) resource.push_back(0);
  if (resource.size() > kMostPayload - header.size() - 4) return false;
  Append(kApp13, header + BigEndian32(iptc.size()), resource.begin(), resource.end(), segments);
  return true;
}

void AppendApp2(const std::string& name, const std::string& content, Bytes* segments) {
  Append(kApp2, name + '\0', content.begin(), content.end(), segments);
}

std::string XmpPacket(const std::string& descriptions) {
  return descriptions.empty() ? "" : Wrapped(Packet(descriptions));
}

bool AppendXmp(const std::string& descriptions, Bytes* segments) {
  const std::string packet = XmpPacket(descriptions);
  if (packet.size() > kMostPayload - kXmpHeader.size()) return false;
  if (!packet.empty()) Append(kApp1, kXmpHeader, packet.begin(), packet.end(), segments);
  return true;
}

bool AppendExtendedXmp(const std::string& namespaces, const std::string& attributes,
                       const std::string& extended, const std::string& descriptions,
                       Bytes* segments) {
  const std::string more = Packet(Description(namespaces, extended)), name = Md5(more);
  const std::string first = Wrapped(Packet(
      descriptions + Description(namespaces + " xmlns:xmpNote=\"http://ns.adobe.com/xmp/note/\"",
                                 attributes + " xmpNote:HasExtendedXMP=\"" + name + "\"")));
  if (first.size() > kMostPayload - kXmpHeader.size() || uint64_t{more.size()} > UINT32_MAX) {
    return false;
  }
  Append(kApp1, kXmpHeader, first.begin(), first.end(), segments);
  const size_t most = kMostPayload - kExtensionHeader.size() - name.size() - 8;
  for (size_t at = 0; at < more.size(); at += most) {
    const std::string header = kExtensionHeader + name + BigEndian32(more.size()) + BigEndian32(at);
    const size_t end = std::min(at + most, more.size());
    Append(kApp1, header, more.begin() + static_cast<ptrdiff_t>(at),
           more.begin() + static_cast<ptrdiff_t>(end), segments);
  }
  return true;
}

void InsertSegments(const Bytes& segments, Bytes* jpeg) {
  size_t at = 2;  // position after the start marker of the JPEG file
  if (jpeg->size() > 6 && (*jpeg)[2] == 0xff && (*jpeg)[3] == kApp0) {
    at = std::min(jpeg->size(), 4 + size_t{(*jpeg)[4]} * 256 + (*jpeg)[5]);
  }
  jpeg->insert(jpeg->begin() + static_cast<ptrdiff_t>(at), segments.begin(), segments.end());
}

}  // namespace starfocus
