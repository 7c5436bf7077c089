// SPDX-License-Identifier: Apache-2.0
// Compiles stb_image and stb_image_write. The stb libraries are compiled in a separate file because
// the JPEG encoder of stb_image_write shifts negative numbers, which would stop builds with
// sanitizers.
#include "platform/stb_memory.h"

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MALLOC(size) starfocus::StbMemory::Allocate(size)
#define STBI_REALLOC(memory, size) starfocus::StbMemory::Reallocate(memory, size)
#define STBI_FREE(memory) starfocus::StbMemory::Free(memory)
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STBIW_MALLOC(size) starfocus::StbMemory::Allocate(size)
#define STBIW_REALLOC(memory, size) starfocus::StbMemory::Reallocate(memory, size)
#define STBIW_FREE(memory) starfocus::StbMemory::Free(memory)
#include <stb/stb_image_write.h>
