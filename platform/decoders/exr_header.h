// SPDX-License-Identifier: Apache-2.0
// Reads the attributes in the headers of OpenEXR files ("OpenEXR File Layout"), because OpenEXR
// allocates as much memory for an attribute as its header declares.
#ifndef STARFOCUS_PLATFORM_DECODERS_EXR_HEADER_H_
#define STARFOCUS_PLATFORM_DECODERS_EXR_HEADER_H_

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace starfocus {

// Calls `visit` with the name, the value and the size of the value of each attribute of each part
// of a file that starts with the signature of OpenEXR. Returns false if a header ends beyond the
// file, or if the file has more than 1000 parts or 10000 attributes.
bool VisitExrAttributes(
    const uint8_t* file, size_t size,
    const std::function<void(const std::string& name, const uint8_t* value, size_t size)>& visit);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_EXR_HEADER_H_
