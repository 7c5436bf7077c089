// SPDX-License-Identifier: Apache-2.0
// Reads the attributes in the headers of OpenEXR files ("OpenEXR File Layout"). OpenEXR allocates
// as much memory for an attribute as its header declares, and reads the values of most types
// without regard to the declared size, so that a wrong size would shift all further attributes.
#ifndef STARFOCUS_PLATFORM_DECODERS_EXR_HEADER_H_
#define STARFOCUS_PLATFORM_DECODERS_EXR_HEADER_H_

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace starfocus {

// Calls `visit` with the name, the value and the size of the value of each attribute of each part
// of a file that starts with the signature of OpenEXR. Returns false if a header ends beyond the
// file, if a name has more than 255 bytes, if a value does not have the size of its type, or if the
// file has more than 1000 parts or 10000 attributes.
bool VisitExrAttributes(
    const uint8_t* file, size_t size,
    const std::function<void(const std::string& name, const uint8_t* value, size_t size)>& visit);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_EXR_HEADER_H_
