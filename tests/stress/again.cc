// A family of pictures asked for again: regions, prepared light fields, frames after frames.
#include <algorithm>
#include <cstdlib>

#include "tests/stress/families.h"
#include "tests/stress/setup.h"

namespace starfocus::stress {
namespace {

// Rows of what an engine wrote.
struct Picture {
  Picture(int w, int h) : width(w), pixels(size_t(3) * size_t(w) * size_t(h), test::kPoison) {}
  size_t stride() const { return size_t(3) * size_t(width); }
  int width;
  std::vector<uint8_t> pixels;
};

sf_region RandomRegion(const test::Scene& scene, test::Random* random) {
  sf_region region = {random->Int(0, scene.width - 1), random->Int(0, scene.height - 1), 1, 1};
  if (random->Int(0, 2) == 0) return region;
  region.width = random->Int(1, scene.width - region.x);
  region.height = random->Int(1, scene.height - region.y);
  return region;
}

// Up to two patches of a view or of the disparity map.
void ChangeScene(test::Scene* scene, test::Random* random) {
  for (int patch = random->Int(0, 2); patch > 0; --patch) {
    const int x0 = random->Int(0, scene->width - 1), y0 = random->Int(0, scene->height - 1);
    const int side = random->Int(0, 1) * random->Int(1, 16);
    const int view = random->Int(-2, scene->views() - 1);
    const double low = scene->disparity_min, high = scene->disparity_max;
    const float d =
        std::clamp(float(random->Real(low, high)), scene->disparity_min, scene->disparity_max);
    for (int y = y0; y <= std::min(y0 + side, scene->height - 1); ++y) {
      for (int x = x0; x <= std::min(x0 + side, scene->width - 1); ++x) {
        if (view < 0) {
          scene->Disparity(x, y) = d;
        } else {
          scene->Pixel(view, x, y)[x % 3] ^= random->Byte();
        }
      }
    }
  }
}

// The region of a picture of the whole.
Picture Crop(const Picture& whole, const sf_region& region) {
  Picture crop(region.width, region.height);
  for (int y = 0; y < region.height; ++y) {
    std::copy_n(whole.pixels.data() + size_t(region.y + y) * whole.stride() + 3 * size_t(region.x),
                crop.stride(), crop.pixels.data() + size_t(y) * crop.stride());
  }
  return crop;
}

// The engine of a case and what it refocuses.
struct Case {
  test::Engine engine;
  sf_params params;
  sf_light_field now;
  sf_status status;

  void Whole(const sf_light_field& field, Picture* out) {
    sf_params whole = params;
    whole.region = {};
    Keep(sf_refocus(engine.get(), &whole, &field, out->pixels.data(), out->stride(), nullptr,
                    nullptr, nullptr));
  }
  void Region(Picture* out) {
    Keep(sf_refocus(engine.get(), &params, &now, out->pixels.data(), out->stride(), nullptr,
                    nullptr, nullptr));
  }
  void After(const sf_light_field& before, const Picture& picture, Picture* out) {
    const sf_previous previous = {before, picture.pixels.data(), picture.stride()};
    Keep(sf_refocus_after(engine.get(), &params, &now, &previous, out->pixels.data(), out->stride(),
                          nullptr, nullptr, nullptr));
  }
  void Prepared(const sf_config& config, Picture* out) {
    size_t bytes = 0;
    Keep(sf_prepared_size(&config, &bytes));
    std::vector<uint8_t> memory(bytes + SF_ALIGNMENT, test::kPoison);
    const uintptr_t address = reinterpret_cast<uintptr_t>(memory.data());
    uint8_t* aligned = memory.data() + (SF_ALIGNMENT - address % SF_ALIGNMENT) % SF_ALIGNMENT;
    sf_prepared* prepared = nullptr;
    Keep(sf_prepare(engine.get(), &now, aligned, bytes, nullptr, nullptr, &prepared));
    if (status != SF_OK) return;
    Keep(sf_refocus_prepared(engine.get(), &params, prepared, out->pixels.data(), out->stride(),
                             nullptr, nullptr, nullptr));
  }
  void Keep(sf_status next) { status = status != SF_OK ? status : next; }
};

}  // namespace

// A region, what is prepared and the frame after another are what refocusing afresh gives.
Outcome Again(test::Random* random) {
  Setup setup = RandomSetup({200, 5, 4, 6}, random);
  if (random->Int(0, 3) > 0) setup.config.largest_block = 32;
  setup.config.max_workers = 1;
  setup.config.streaming = 0;
  const test::Scene before = setup.scene;
  ChangeScene(&setup.scene, random);
  Case one = {test::Engine(setup.config), setup.params, setup.scene.Field(), SF_OK};
  one.status = one.engine.status();
  const int width = setup.scene.width, height = setup.scene.height;
  const bool whole = random->Int(0, 1) == 0;
  const sf_region region =
      whole ? sf_region{0, 0, width, height} : RandomRegion(setup.scene, random);
  if (!whole) one.params.region = region;
  Picture afresh(width, height), last(width, height);
  Picture part(region.width, region.height), after = part, prepared = part;
  one.Whole(before.Field(), &last);
  one.Whole(one.now, &afresh);
  one.Region(&part);
  one.After(before.Field(), Crop(last, region), &after);
  one.Prepared(setup.config, &prepared);
  if (one.status != SF_OK) return {0, std::string(sf_status_string(one.status)) + setup.Text()};
  const std::vector<uint8_t> expected = Crop(afresh, region).pixels;
  for (const Picture* got : {&part, &after, &prepared}) {
    if (got->pixels == expected) continue;
    const char* what = got == &part ? "region" : got == &after ? "frame after" : "prepared";
    return {0, std::string(what) + " " + std::to_string(region.x) + "," + std::to_string(region.y) +
                   "," + std::to_string(region.width) + "," + std::to_string(region.height) +
                   " differs: " + setup.Text()};
  }
  return {0, ""};
}

}  // namespace starfocus::stress
