// SPDX-License-Identifier: Apache-2.0
// Refocuses the light field of scene.h through the C++ wrapper, and prints the same checksums as
// refocus.c.
#include <cstdio>
#include <initializer_list>
#include <starfocus/starfocus.hpp>

#include "scene.h"

int main() {
  static Scene scene;
  static uint8_t out[kHeight * kStride];
  const starfocus_light_field field = MakeScene(&scene);
  starfocus::Config config;
  ConfigureFor(&config);
  starfocus::Engine engine;
  starfocus_status status = engine.Init(config);
  for (const double focus : {6.0, -4.0}) {
    starfocus::Params params;
    params.focus = focus;
    if (status == STARFOCUS_OK)
      status = engine.Refocus(params, field, starfocus_image_rgb(out, kStride));
    if (status == STARFOCUS_OK)
      std::printf("%08x\n", static_cast<unsigned>(Checksum(out, sizeof out)));
  }
  if (status != STARFOCUS_OK)
    std::fprintf(stderr, "refocus: %s\n", starfocus_status_string(status));
  return status != STARFOCUS_OK;
}
