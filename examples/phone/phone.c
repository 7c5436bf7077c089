/* SPDX-License-Identifier: Apache-2.0 */
/* usage: phone FRAME DEPTH WIDTH HEIGHT X Y OUT
 * Refocuses a frame at the tapped pixel (X, Y). FRAME and OUT are files of NV12: rows of luma, then
 * rows of chroma. DEPTH is a file of distances in millimetres, of 16 bits in the order of the
 * machine, at 1/4 of the width and height. */
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

#include "tap_to_focus.h"

enum { kMostSide = 8192 }; /* largest width and height, pixels */

/* Returns a whole number of decimal digits, or -1. */
static int Number(const char* text) {
  char* end;
  errno = 0;
  const long number = strtol(text, &end, 10);
  return errno || end == text || *end || number < 0 || number > INT_MAX ? -1 : (int)number;
}

/* Reads exactly `bytes` bytes of a file. Returns null on failure. The caller frees the memory. */
static void* Read(const char* path, size_t bytes) {
  FILE* const file = fopen(path, "rb");
  void* const memory = file ? malloc(bytes) : NULL;
  const int read = memory && fread(memory, 1, bytes, file) == bytes && fgetc(file) == EOF;
  if (!file) {
    fprintf(stderr, "phone: %s: cannot be opened\n", path);
  } else if (!memory) {
    fprintf(stderr, "phone: %s: no memory for %zu bytes\n", path, bytes);
  } else if (!read) {
    fprintf(stderr, "phone: %s: expected a file of %zu bytes\n", path, bytes);
  }
  if (file) fclose(file);
  if (read) return memory;
  free(memory);
  return NULL;
}

/* Writes a file, or removes it if it cannot be written completely. */
static int Write(const char* path, const void* memory, size_t bytes) {
  FILE* const file = fopen(path, "wb");
  int written = file && fwrite(memory, 1, bytes, file) == bytes;
  if (file) written &= fclose(file) == 0;
  if (file && !written) remove(path);
  if (!written) fprintf(stderr, "phone: %s: cannot be written\n", path);
  return written;
}

int main(int count, char** arguments) {
  const int width = count == 8 ? Number(arguments[3]) : 0,
            height = count == 8 ? Number(arguments[4]) : 0;
  if (width < 4 || width > kMostSide || width % 4 || height < 4 || height > kMostSide ||
      height % 4) {
    fprintf(stderr, "usage: phone FRAME DEPTH WIDTH HEIGHT X Y OUT\n");
    return 2;
  }
  const size_t pixels = (size_t)width * (size_t)height, bytes = pixels * 3 / 2;
  uint8_t* const codes = Read(arguments[1], bytes);
  uint16_t* const millimetres = codes ? Read(arguments[2], pixels / 8) : NULL;
  uint8_t* const picture = malloc(bytes);
  int done = 0;
  if (codes && millimetres && picture) {
    const Frame frame = {width, height, codes, codes + pixels, millimetres};
    uint8_t* out[2] = {picture, picture + pixels};
    const starfocus_status status =
        TapToFocus(&frame, Number(arguments[5]), Number(arguments[6]), out);
    if (status) fprintf(stderr, "phone: %s\n", starfocus_status_string(status));
    done = !status && Write(arguments[7], picture, bytes);
  }
  free(picture);
  free(millimetres);
  free(codes);
  return !done;
}
